// caseSweep: a parameter study. Makes a case from one template for each combination of values, runs several cases at a
// time, continues after having been stopped or killed, and collects summary.csv and report.html.
//
//     study.yaml (study/studySettings.hpp)
//       -> cases        cases/NAME, a copy of the template with its settings written into the dictionaries
//       -> programs     run in each case, output in log.caseSweep; those that have ended are noted in sweep.json
//       -> summary.csv  parameters and results of all cases, rewritten whenever a case ends
//       -> report.html  plots, table, logs of failures
#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "core/application.hpp"
#include "core/atomicFile.hpp"
#include "core/buildInfo.hpp"
#include "core/caseFolder.hpp"
#include "core/dictionaryEdit.hpp"
#include "core/plugins.hpp"
#include "core/runRecord.hpp"
#include "core/schemaJson.hpp"
#include "core/wallClock.hpp"
#include "liveTable.hpp"
#include "resultColumns.hpp"
#include "simulation/dictionaries.hpp"
#include "study/batch.hpp"
#include "study/report.hpp"
#include "study/summary.hpp"

using namespace corpuscle;
namespace fs = std::filesystem;

namespace {

volatile std::sig_atomic_t stopSignals = 0;
void noteSignal(int) { stopSignals = stopSignals + 1; }

Usage usage() {
    return {.options = {{"list", "", "Show the cases and their values; make and run nothing."},
                        {"jobs", "N", "Cases at a time, in place of 'jobs' in the study."},
                        {"ranks", "N", "MPI ranks of each solver, in place of 'ranks' in the study."},
                        {"only", "CASE", "One case alone, by its name or its number in -list."},
                        {"retry", "", "Run again what has failed."},
                        {"keep", "", "Leave cases as they are that differ from the template by now."},
                        {"update", "", "Write changed control.yaml and observers.yaml into such cases and go on."},
                        {"fresh", "", "Remove such cases, and those that failed, and make them anew."},
                        {"collect", "", "Write summary.csv and report.html from what is there; run nothing."},
                        {"slurm", "", "Write a job array for SLURM; run nothing."},
                        {"snakemake", "", "Write rules for Snakemake; run nothing."}},
            .arguments = {{"STUDY", "", "The study's dictionary; study.yaml without it."}},
            .optionalArguments = 1,
            .samples = {"caseSweep study.yaml", "caseSweep -list", "caseSweep -jobs 4 -retry"}};
}

// The content of a study.yaml, with the cases that follow from it.
struct Study {
    fs::path file, base;
    study::StudySettings settings;
    std::vector<study::StudyCase> cases;
    study::SweepOptions options;
    std::string name;  // of the file, without its extension
};

// Reads all dictionaries of all cases as the programs will read them. Each fault is reported once, with the first case
// that has it.
void checkCases(const Study& study) {
    std::map<std::string, std::string> found;  // each fault, with the first case that has it
    std::vector<std::string> order;
    const auto note = [&](const std::string& fault, const std::string& name) {
        if (found.emplace(fault, name).second) order.push_back(fault);
    };
    for (const study::StudyCase& one : study.cases) try {
            Problems problems;
            for (const auto& [file, text] : study::dictionariesWith(study.options.templateCase, one.settings))
                simulation::checkDictionary(file, parseDictionary(text, file, problems), problems);
            problems.throwIfAny();
        } catch (const CaseError& error) {
            for (const Problem& problem : error.problems()) note(problem.text(), one.name);
        } catch (const Failure& failure) {
            note(failure.what(), one.name);
        }
    if (order.empty()) return;
    std::string text;
    for (const std::string& fault : order)
        text += fmt::format("{}case {}: {}", text.empty() ? "" : "\n", found[fault], fault);
    throw Failure(ExitCode::invalidCase, text);
}

// Checks that every program that a case needs can be started.
void checkPrograms(const Study& study) {
    std::vector<std::string> known;
    for (const auto& entry : fs::directory_iterator(study.options.programFolder))
        known.push_back(entry.path().filename().string());
    const auto isFound = [&](const std::string& program) {
        if (fs::is_regular_file(study.options.programFolder / program)) return true;
        const char* path = std::getenv("PATH");
        std::istringstream folders(path ? path : "");
        for (std::string folder; std::getline(folders, folder, ':');)
            if (fs::is_regular_file(fs::path(folder) / program)) return true;
        return false;
    };
    for (const study::StudyCase& one : study.cases)
        for (const std::string& program : one.programs)
            if (!isFound(program))
                throw Failure(ExitCode::invalidCase,
                              fmt::format("{}: programs: '{}' is neither beside caseSweep nor in PATH.{}",
                                          study.file.string(), program, didYouMean(program, known)));
}

study::Differing differingOf(const Application& app) {
    const std::vector<std::pair<const char*, study::Differing>> choices{
        {"keep", study::Differing::keep}, {"update", study::Differing::update}, {"fresh", study::Differing::fresh}};
    study::Differing chosen = study::Differing::refuse;
    for (const auto& [name, differing] : choices)
        if (app.has(name)) {
            if (chosen != study::Differing::refuse)
                throw Failure(ExitCode::usage, "give one of -keep, -update and -fresh at most");
            chosen = differing;
        }
    return chosen;
}

void chooseOnly(Study& study, const std::string& wanted) {
    std::vector<std::string> names;
    for (const study::StudyCase& one : study.cases) names.push_back(one.name);
    const bool isNumber = !wanted.empty() && wanted.find_first_not_of("0123456789") == std::string::npos;
    std::size_t k = 0;
    while (k < names.size() && names[k] != wanted) ++k;
    if (k == names.size() && isNumber && wanted.size() < 9 && std::stoul(wanted) >= 1) k = std::stoul(wanted) - 1;
    if (k >= names.size())
        throw Failure(ExitCode::usage,
                      fmt::format("-only: there is no case '{}' among the {} of this study.{} -list shows "
                                  "them.",
                                  wanted, names.size(), didYouMean(wanted, names)));
    study.cases = {study.cases[k]};
}

Study readStudy(const Application& app) {
    Study study;
    study.file = app.caseDirectory() / (app.arguments().empty() ? "study.yaml" : app.arguments().front());
    if (fs::is_directory(study.file)) study.file /= "study.yaml";
    if (!fs::is_regular_file(study.file))
        throw Failure(ExitCode::invalidCase,
                      fmt::format("{}: there is no such file. A study is a dictionary with 'template' and 'parameters' "
                                  "(docs/study.md); tutorials/rbcShear/study has one.",
                                  study.file.string()));
    study.base = fs::absolute(study.file).lexically_normal().parent_path();
    study.name = study.file.stem().string();
    Problems problems;
    Node node = readDictionary(study.file, study.file.lexically_normal().string(), problems);
    problems.throwIfAny();
    for (const Override& change : app.overrides()) {
        if (fs::path(change.file).filename() != study.file.filename())
            throw Failure(
                ExitCode::usage,
                fmt::format("-set {0}:{1}: here -set changes {2} alone; what all cases are to have in {0} stands "
                            "in its 'set', or -set '{2}:/set=[\"{0}:{1}={3}\"]'",
                            change.file, change.path, study.file.filename().string(), change.value));
        applyOverride(node, change, problems);
    }
    problems.throwIfAny();
    study.settings = read<study::StudySettings>(node, problems);
    problems.throwIfAny();

    study::SweepOptions& o = study.options;
    o.base = study.base;
    o.studyFile = study.file.filename().string();
    o.templateCase = (study.base / study.settings.templateCase).lexically_normal();
    o.cases = (study.base / study.settings.cases).lexically_normal();
    if (o.templateCase.filename().empty()) o.templateCase = o.templateCase.parent_path();
    if (o.cases.filename().empty()) o.cases = o.cases.parent_path();
    requireCase(o.templateCase);
    if (o.cases == o.templateCase)
        throw Failure(ExitCode::invalidCase,
                      fmt::format("{}: 'cases' is the template itself; name another folder.", study.file.string()));
    if (study.settings.programs && study.settings.programs->empty())
        throw Failure(ExitCode::invalidCase,
                      fmt::format("{}: programs: found none; leave the key out for those that the "
                                  "template needs.",
                                  study.file.string()));
    o.programFolder = fs::read_symlink("/proc/self/exe").parent_path();
    o.ranks = app.integer("ranks", 1).value_or(study.settings.ranks);
    const long cores = std::max(1L, static_cast<long>(std::thread::hardware_concurrency()));
    o.jobs = app.integer("jobs", 1).value_or(study.settings.jobs.value_or(std::max(1L, cores / o.ranks)));
    o.differing = differingOf(app);
    o.retry = app.has("retry");
    o.readOnly = app.has("collect");
    if (o.readOnly && app.has("only"))
        throw Failure(ExitCode::usage, "-collect is of the whole study: give it without -only");
    if (o.readOnly && (o.retry || o.differing != study::Differing::refuse))
        throw Failure(ExitCode::usage, "-collect only reads: give it without -retry, -keep, -update and -fresh");

    std::vector<std::string> order;
    for (const auto& [name, value] : node.find("parameters")->entries) order.push_back(name);
    loadPlugins(o.templateCase);
    study.cases = study::casesOf(study.settings, order);
    checkCases(study);
    for (study::StudyCase& one : study.cases)
        one.programs = study.settings.programs.value_or(
            study::programsOf(o.templateCase, study::dictionariesWith(o.templateCase, one.settings)));
    checkPrograms(study);
    if (!o.readOnly) checkResultColumns(node, study.settings, o.templateCase, study.cases, problems);
    problems.throwIfAny();
    if (const auto only = app.value("only")) chooseOnly(study, *only);
    return study;
}

// Plain numbers as such; a quantity keeps its unit, as text.
nlohmann::ordered_json jsonOf(const std::string& value) {
    Problems ignored;
    return toJson(parseValue(value, "", ignored));
}

void list(Application& app, const Study& study) {
    std::vector<std::string> header{"number", "case"};
    for (const auto& [name, value] : study.cases.front().values) header.push_back(name);
    std::vector<std::vector<std::string>> rows;
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < study.cases.size(); ++k) {
        rows.push_back({std::to_string(k + 1), study.cases[k].name});
        json.push_back({{"case", study.cases[k].name}});
        for (const auto& [name, value] : study.cases[k].values) {
            rows.back().push_back(value);
            json.back()["values"][name] = jsonOf(value);
        }
    }
    if (app.json())
        std::cout << json.dump(2) << '\n';
    else
        app.log().table(header, rows);
    app.log().info("{} cases; in each {}", study.cases.size(), joinWords(study.cases.front().programs));
}

void writeBatch(Application& app, const Study& study) {
    study::Batch batch{.name = study.name,
                       .study = study.options.studyFile,
                       .program = "caseSweep",
                       .casesFolder = fs::relative(study.options.cases, study.base).string(),
                       .ranks = study.options.ranks};
    for (const study::StudyCase& one : study.cases) batch.names.push_back(one.name);
    const auto write = [&](const char* option, const char* ending, const std::string& text) {
        if (!app.has(option)) return;
        const fs::path file = study.base / (study.name + ending);
        writeFileAtomically(file, text);
        app.log().info("{}", file.string());
    };
    fs::create_directories(study.options.cases);
    write("slurm", ".slurm", study::slurmScript(batch));
    write("snakemake", ".smk", study::snakefile(batch));
}

// Two studies in one folder would each mistake the other's cases and tables for their own.
void requireOwnFolder(const Study& study) {
    const fs::path summary = study.options.cases / "summary.csv";
    std::error_code ignored;
    if (!fs::is_regular_file(summary, ignored)) return;
    const std::string text = readFile(summary), start = "# " + study.options.studyFile + ": ";
    if (text.starts_with("# ") && !text.starts_with(start))
        throw Failure(ExitCode::invalidCase, fmt::format("{} is of the study {}: name another folder in 'cases'.",
                                                         summary.string(), text.substr(2, text.find(':') - 2)));
}

class Collector {
  public:
    Collector(const Study& study, const study::Environment& environment) : study_(study), environment_(environment) {}

    fs::path summaryFile() const { return study_.options.cases / "summary.csv"; }
    fs::path reportFile() const { return study_.options.cases / "report.html"; }

    study::Summary collect(const std::vector<study::CaseStatus>& cases, bool withReport) {
        study::Summary summary = study::summarise(study_.settings, cases, study_.options.cases, known_);
        const std::string title =
            fmt::format("{}: {} cases of {}", study_.options.studyFile, cases.size(), study_.settings.templateCase);
        writeFileAtomically(summaryFile(), study::csvText(summary, title));
        if (withReport)
            writeFileAtomically(
                reportFile(),
                study::reportPage(
                    summary,
                    {.title = study_.name == "study" ? "Study of " + study_.base.filename().string() : study_.name,
                     .templateCase = study_.settings.templateCase,
                     .settings = study_.settings.set,
                     .version = buildInfo().version,
                     .date = timestamp().substr(0, 10)},
                    study_.options.cases / fmt::format(".report-{}", getpid()), environment_));
        return summary;
    }

  private:
    const Study& study_;
    const study::Environment& environment_;
    study::KnownResults known_;
};

void showResults(Application& app, const study::Summary& summary) {
    std::vector<std::string> header{"case", "state"};
    for (const auto& [name, result] : summary.results) header.push_back(name);
    header.emplace_back("run time");
    std::vector<std::vector<std::string>> rows;
    std::map<std::string, std::string> problems;  // each with the first case that has it
    bool isDoubtful = false;
    for (const study::SummaryRow& row : summary.rows) {
        rows.push_back({row.status->what.name, nameOf(row.status->state)});
        for (const study::CaseResult& result : row.results) {
            if (!result.problem.empty()) problems.emplace(result.problem, row.status->what.name);
            const study::Estimate& e = result.estimate;
            isDoubtful = isDoubtful || (std::isfinite(e.error) && !e.isReliable);
            rows.back().push_back(!std::isfinite(e.value) ? "-"
                                  : std::isfinite(e.error)
                                      ? fmt::format("{:.5g} +- {:.2g}{}", e.value, e.error, e.isReliable ? "" : "*")
                                      : fmt::format("{:.5g}", e.value));
        }
        rows.back().push_back(formatDuration(row.status->seconds));
    }
    app.log().info("");
    app.log().table(header, rows);
    if (isDoubtful) app.log().info("* this standard error is a lower bound: the series is too short for it, or drifts");
    for (const auto& [problem, name] : problems) app.log().warning("case {}: {}", name, problem);
    for (const study::SummaryRow& row : summary.rows)
        if (const auto& failed = row.status->record.failed; failed && row.status->state == study::CaseState::failed)
            app.log().warning("case {}: {} ended with code {}; the end of log.caseSweep there:\n{}",
                              row.status->what.name, failed->program, failed->code, failed->logEnd);
}

void printJson(const study::Summary& summary, const Collector& collector) {
    nlohmann::ordered_json json{{"summary", collector.summaryFile().string()},
                                {"report", collector.reportFile().string()}};
    json["cases"] = nlohmann::ordered_json::array();
    for (const study::SummaryRow& row : summary.rows) {
        nlohmann::ordered_json one{{"case", row.status->what.name}, {"status", nameOf(row.status->state)}};
        for (const auto& [name, value] : row.status->what.values) one["values"][name] = jsonOf(value);
        for (std::size_t k = 0; k < row.results.size(); ++k)
            if (std::isfinite(row.results[k].estimate.value))
                one["results"][summary.results[k].first] = row.results[k].estimate.value;
        json["cases"].push_back(std::move(one));
    }
    std::cout << json.dump(2) << '\n';
}

ExitCode outcomeOf(Application& app, const std::vector<study::CaseStatus>& cases) {
    const auto count = [&](study::CaseState state) {
        return std::count_if(cases.begin(), cases.end(),
                             [&](const study::CaseStatus& one) { return one.state == state; });
    };
    const auto done = count(study::CaseState::done), failed = count(study::CaseState::failed);
    if (done == std::ssize(cases)) return ExitCode::done;
    if (done + failed < std::ssize(cases)) {
        app.log().info("{} of {} cases are not finished; the same command goes on with them.",
                       std::ssize(cases) - done - failed, cases.size());
        return ExitCode::stopped;
    }
    app.log().error("{} of {} cases failed. Once the cause is corrected, -retry runs them again.", failed,
                    cases.size());
    return ExitCode::numerics;
}

ExitCode sweep(Application& app, const Study& study, const study::Environment& environment) {
    requireOwnFolder(study);
    study::Sweep sweep(study.options, study.cases, environment);
    Collector collector(study, environment);
    if (app.has("collect")) {
        const study::Summary summary = collector.collect(sweep.cases(), true);
        if (app.json()) printJson(summary, collector);
        showResults(app, summary);
        app.log().info("{}\n{}", collector.summaryFile().string(), collector.reportFile().string());
        return ExitCode::done;
    }
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGHUP})
        // Ignored signals stay ignored (nohup).
        if (std::signal(signal, noteSignal) == SIG_IGN) std::signal(signal, SIG_IGN);
    LiveTable table(app.log(), app.has("quiet") ? LiveTable::Output::quiet
                               : app.json()     ? LiveTable::Output::json
                                                : LiveTable::Output::text);
    // With -only, summary and report are left to -collect, since they cover the whole study.
    const bool isPart = app.has("only");
    bool changed = true;
    std::sig_atomic_t handled = 0;
    while (true) {
        table.show(sweep.cases(), changed);
        if (sweep.isEnded()) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (stopSignals > handled) {  // a second signal ends solvers at once
            if (handled == 0) app.log().info("stopping: solvers write a checkpoint first");
            handled = stopSignals;
            sweep.stop();
        }
        changed = sweep.advance();
        if (changed && !isPart) collector.collect(sweep.cases(), false);
    }
    table.finish(sweep.cases());
    if (!isPart) {
        const study::Summary summary = collector.collect(sweep.cases(), true);
        if (app.json()) printJson(summary, collector);
        showResults(app, summary);
        app.log().info("{}\n{}", collector.summaryFile().string(), collector.reportFile().string());
    }
    return outcomeOf(app, sweep.cases());
}

// Editors find the schema through the first line of a study, which names it.
void refreshSchema(const Study& study) {
    for (const auto& [file, info] : simulation::dictionaries())
        if (file == "study.yaml") try {
                const std::string text = simulation::schemaOf(info).dump(2) + "\n";
                const fs::path path = study.base / ".schema" / "study.json";
                if (!fs::exists(path) || readFile(path) != text) writeFileAtomically(path, text);
            } catch (const std::exception&) {
                // Not an error: the folder may be read-only.
                return;
            }
}

}  // namespace

int main(int argc, char* argv[]) {
    const study::Environment environment = study::Environment::ofThisProcess();  // taken before MPI adds variables
    Application app("caseSweep", "Runs a parameter study: cases from one template, several at a time.", argc, argv,
                    usage());
    return app.run([&] {
        if (!app.communicator().isRoot()) return ExitCode::done;
        const Study study = readStudy(app);
        if (app.has("list")) {
            list(app, study);
            return ExitCode::done;
        }
        refreshSchema(study);
        if (app.has("slurm") || app.has("snakemake")) {
            writeBatch(app, study);
            return ExitCode::done;
        }
        return sweep(app, study, environment);
    });
}
