#include "core/application.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/atomicFile.hpp"
#include "core/buildInfo.hpp"
#include "core/dictionaryText.hpp"
#include "core/plugins.hpp"
#include "core/runRecord.hpp"
#include "core/startMpi.hpp"
#include "core/together.hpp"
#include "core/writeFailure.hpp"

namespace corpuscle {
namespace {

const std::vector<Option>& commonOptions() {
    static const std::vector<Option> options{
        {"case", "DIR", "The case directory (default: the current one)."},
        {"set", "FILE:/path=value",
         "Change one setting, for example -set 'system/mesh.yaml:/cells/0/edge=0.3 um'; repeatable."},
        {"quiet", "", "Only warnings and errors on the terminal."},
        {"json", "", "The result, or the problems, as JSON on standard output."},
        {"help", "", "Show this text."},
        {"version", "", "Show the version and how it was built."}};
    return options;
}

constexpr const char* exitCodes =
    "Exit codes: 0 done, 1 wrong usage, 2 invalid case, 3 numerics failed, 4 reading or writing failed, 5 stopped "
    "early.\n";

bool isNumber(const std::string& text) {
    return text.size() > 1 && (text[1] == '.' || (text[1] >= '0' && text[1] <= '9'));
}

}  // namespace

std::vector<Option> solverOptions() {
    return {
        {"dry-run", "", "Check the case, print its numbers and limits, run nothing."},
        {"steps", "N", "Stop after N steps."},
        {"restart", "TIME",
         "Start from the checkpoint nearest before TIME (\"1.5 ms\"), instead of startFrom; later output is removed."}};
}

Application::Application(std::string name, std::string text, int argc, char** argv, Usage usage)
    : name_(std::move(name)), text_(std::move(text)), usage_(std::move(usage)) {
    prepareOutput();
    ownsMpi_ = startMpi(argc, argv);
    communicator_.emplace();
    MPI_Comm_dup(MPI_COMM_WORLD, &meeting_);
    try {
        parse(argc, argv);
    } catch (const Failure& failure) {
        usageFailure_ = failure;
    }
    log_.emplace(communicator_->isRoot(), has("quiet") || has("json"));
}

Application::~Application() {
    lock_.reset();
    MPI_Comm_free(&meeting_);
    if (ownsMpi_) MPI_Finalize();
}

std::vector<Option> Application::allOptions() const {
    std::vector<Option> all = usage_.options;
    all.insert(all.end(), commonOptions().begin(), commonOptions().end());
    return all;
}

void Application::parse(int argc, char** argv) {
    const std::vector<Option> known = allOptions();
    std::vector<std::string> names;
    names.reserve(known.size());
    for (const Option& o : known) names.push_back(o.name);

    const auto usageError = [&](const std::string& message) {
        throw Failure(ExitCode::usage, fmt::format("{} See {} -help", message, name_));
    };
    commandLine_ = name_;
    for (int i = 1; i < argc; ++i) commandLine_ += std::string(" ") + argv[i];
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.size() < 2 || word[0] != '-' || isNumber(word)) {
            arguments_.push_back(word);
            continue;
        }
        std::string option = word.substr(word[1] == '-' ? 2 : 1);
        if (option == "h") option = "help";
        const auto found = std::find_if(known.begin(), known.end(), [&](const Option& o) { return o.name == option; });
        if (found == known.end()) {
            const std::string nearest = nearestWord(option, names);
            usageError(fmt::format("unknown option '{}'.{} Options: -{}.", word,
                                   nearest.empty() ? "" : fmt::format(" Did you mean '-{}'?", nearest),
                                   joinWords(names, " -")));
        }
        if (found->argument.empty()) {
            given_[option];
            continue;
        }
        if (i + 1 == argc) usageError(fmt::format("option -{} needs its value, {}.", option, found->argument));
        const std::string value = argv[++i];
        if (option == "set")
            overrides_.push_back(parseOverride(value));
        else if (!given_.emplace(option, value).second)
            usageError(fmt::format("option -{} is given twice.", option));
    }
    if (has("help") || has("version")) return;
    const std::size_t most = usage_.arguments.size();
    if (arguments_.size() > most) usageError(fmt::format("unexpected argument '{}'.", arguments_[most]));
    if (arguments_.size() + usage_.optionalArguments < most)
        usageError(fmt::format("the argument {} is missing.", usage_.arguments[arguments_.size()].name));
}

std::string Application::helpText() const {
    if (json()) {  // for man pages and completion (etc/makeManual)
        nlohmann::ordered_json usage{{"name", name_}, {"text", text_}};
        const auto add = [&](const char* kind, const std::vector<Option>& options) {
            usage[kind] = nlohmann::ordered_json::array();
            for (const Option& o : options)
                usage[kind].push_back({{"name", o.name}, {"argument", o.argument}, {"text", o.text}});
        };
        add("arguments", usage_.arguments);
        usage["optionalArguments"] = usage_.optionalArguments;
        add("options", allOptions());
        usage["samples"] = usage_.samples;
        return usage.dump(2) + "\n";
    }
    std::string text = fmt::format("{}: {}\n\nUsage: {}", name_, text_, name_);
    for (std::size_t i = 0; i < usage_.arguments.size(); ++i)
        text += i + usage_.optionalArguments < usage_.arguments.size() ? " " + usage_.arguments[i].name
                                                                       : " [" + usage_.arguments[i].name + "]";
    text += " [options]\n\n";
    std::vector<std::pair<std::string, std::string>> lines;
    for (const Option& a : usage_.arguments) lines.emplace_back(a.name, a.text);
    for (const Option& o : allOptions())
        lines.emplace_back("-" + o.name + (o.argument.empty() ? "" : " " + o.argument), o.text);
    std::size_t width = 0;
    for (const auto& [left, right] : lines) width = std::max(width, left.size());
    for (const auto& [left, right] : lines) text += fmt::format("  {:<{}}  {}\n", left, width, right);
    if (!usage_.samples.empty()) {
        text += "\nSample runs:\n";
        for (const std::string& s : usage_.samples) text += "  " + s + "\n";
    }
    return text + "\n" + exitCodes;
}

std::filesystem::path Application::caseDirectory() const { return value("case").value_or("."); }

std::optional<std::string> Application::value(const std::string& option) const {
    const auto found = given_.find(option);
    if (found == given_.end()) return std::nullopt;
    return found->second;
}

std::optional<long> Application::integer(const std::string& option, long low) const {
    const auto text = value(option);
    if (!text) return std::nullopt;
    long number = 0;
    const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), number);
    if (error != std::errc() || end != text->data() + text->size() || number < low)
        throw Failure(ExitCode::usage,
                      fmt::format("-{} {}: a whole number of at least {} is expected", option, *text, low));
    return number;
}

bool Application::hasDictionary(const std::string& inCase) const {
    return communicator_->broadcast(
               communicator_->isRoot() && std::filesystem::is_regular_file(path(inCase)) ? 1L : 0L) == 1;
}

Node Application::dictionary(const std::string& inCase, Problems& problems) const {
    Node root;
    if (hasDictionary(inCase)) {
        std::string text, reason;
        ExitCode code = ExitCode::done;
        if (communicator_->isRoot()) try {
                const std::size_t bytes = std::filesystem::file_size(path(inCase));
                if (bytes > largestDictionary) throw Failure(ExitCode::invalidCase, tooLarge(bytes));
                text = readFile(path(inCase));
            } catch (const Failure& failure) {
                reason = failure.what();
                code = failure.code();
            }
        reason = communicator_->broadcast(reason);
        if (communicator_->broadcast(static_cast<long>(code)) == static_cast<long>(ExitCode::invalidCase))
            problems.add({inCase, 0, 0}, "", reason);
        else if (!reason.empty())
            throw Failure(ExitCode::io, reason);
        root = parseDictionary(communicator_->broadcast(text), inCase, problems);
    } else {
        root = readDictionary(path(inCase), inCase, problems);
    }
    for (const Override& change : overrides_)
        if (std::filesystem::path(change.file).lexically_normal() == std::filesystem::path(inCase).lexically_normal())
            applyOverride(root, change, problems);
    return root;
}

void Application::checkOverrides() const {
    if (overrides_.empty()) return;
    // Only the root looks at the disk.
    std::string files;
    if (communicator_->isRoot())
        for (const char* folder : {"system", "constant"})
            if (std::filesystem::is_directory(path(folder)))
                for (const auto& entry : std::filesystem::directory_iterator(path(folder)))
                    if (entry.path().extension() == ".yaml")
                        files +=
                            (files.empty() ? "" : " ") + std::string(folder) + "/" + entry.path().filename().string();
    files = communicator_->broadcast(files);
    std::vector<std::string> known;
    for (std::size_t begin = 0; begin < files.size();) {
        const std::size_t end = std::min(files.find(' ', begin), files.size());
        known.push_back(files.substr(begin, end - begin));
        begin = end + 1;
    }
    std::sort(known.begin(), known.end());
    Problems problems;
    for (const Override& change : overrides_)
        if (!hasDictionary(change.file))
            problems.add({"-set", 0, 0}, change.file,
                         fmt::format("the case has no such file.{} It has: {}", didYouMean(change.file, known),
                                     known.empty() ? "none (is -case right?)" : joinWords(known)));
    problems.throwIfAny();
}

void Application::announce() { log_->info("{} {} ({})", name_, buildInfo().version, commandLine_); }

void Application::lockCase() {
    if (!lock_) lock_.emplace(caseDirectory(), name_, *communicator_, *log_);
}

void Application::openLog(LogStart start) {
    const std::string continuation =
        start == LogStart::anew ? "" : fmt::format("==== continued {} by: {}", timestamp(), commandLine_);
    if (std::filesystem::is_directory(caseDirectory())) log_->open(path("log." + name_), continuation);
}

void Application::reportFailure(ExitCode code, const std::exception& error, bool named) {
    const auto* caseError = dynamic_cast<const CaseError*>(&error);
    if (has("json")) {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        if (caseError)
            for (const Problem& p : caseError->problems())
                list.push_back({{"file", p.mark.file},
                                {"line", p.mark.line},
                                {"column", p.mark.column},
                                {"key", p.key},
                                {"message", p.message}});
        else
            list.push_back({{"message", error.what()}});
        nlohmann::ordered_json json{{"problems", list}};
        if (caseError && caseError->more()) json["more"] = caseError->more();
        const std::string text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
        std::fputs((text + "\n").c_str(), stdout);
        std::fflush(stdout);
    }
    std::string text;
    if (caseError) {
        for (const Problem& p : caseError->problems()) text += p.text() + "\n";
        if (caseError->more()) text += fmt::format("and {} more\n", caseError->more());
        text += fmt::format("{}: {} problem{} in the case {}\n", name_, caseError->total(),
                            caseError->total() == 1 ? "" : "s", caseDirectory().string());
    } else {
        text = fmt::format("{}: {}\n", name_, error.what());
    }
    if (named) text = fmt::format("[rank {}] {}", communicator_->rank(), text);
    std::fputs(text.c_str(), stderr);
    log_->note(text);
    if (record_) record_->fail(code, error.what());
}

// All ranks meet here. A rank that failed alone waits a little for the others, which may be about to arrive with the
// same failure, and then ends them, since they are waiting for it inside the body.
int Application::endTogether(ExitCode code, const std::exception* error) {
    const int own = static_cast<int>(code);
    if (error && communicator_->isRoot()) reportFailure(code, *error, false);
    if (communicator_->size() == 1) return own;

    const int none = communicator_->size();
    // The worst code, and the lowest rank that failed.
    int send[2] = {-own, error ? communicator_->rank() : none}, receive[2] = {0, none};
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallreduce(send, receive, 2, MPI_INT, MPI_MIN, meeting_, &request);
    int met = 0;
    const auto start = std::chrono::steady_clock::now();
    constexpr auto patience = std::chrono::seconds(1);
    while (true) {
        MPI_Test(&request, &met, MPI_STATUS_IGNORE);
        if (met) break;
        if (error && std::chrono::steady_clock::now() - start > patience) {
            if (!communicator_->isRoot()) reportFailure(code, *error, true);
            std::fflush(nullptr);
            if (lock_) lock_->abandon();
            MPI_Abort(communicator_->handle(), own);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (error && receive[1] == communicator_->rank() && !communicator_->isRoot()) reportFailure(code, *error, true);
    return -receive[0];
}

// JSON on standard output is a result: failing to write it is an error, unless the reader has closed its pipe.
void Application::requireOutput() const {
    if (!has("json") || !communicator_->isRoot()) return;
    errno = 0;
    if (std::fflush(stdout) != 0 && errno != EPIPE) throw writeFailure("standard output", errno);
}

int Application::run(const std::function<ExitCode()>& body) {
    const int code = outcome(body);
    if (communicator_->anyTrue(mpiStaysOpen())) {
        lock_.reset();
        log_.reset();
        std::fflush(nullptr);
        std::_Exit(code);
    }
    return code;
}

int Application::outcome(const std::function<ExitCode()>& body) {
    try {
        if (usageFailure_) throw Failure(*usageFailure_);
        if (has("help") || has("version")) {
            const BuildInfo& build = buildInfo();
            if (communicator_->isRoot())
                std::fputs(has("help") ? helpText().c_str()
                                       : fmt::format("{} (Corpuscle {}, {}; {} {}, {})\n", name_, build.version,
                                                     build.gitDescribe, build.compiler, build.flags, build.type)
                                             .c_str(),
                           stdout);
            return endTogether(ExitCode::done, nullptr);
        }
        checkOverrides();
        loadPlugins(*this);
        const ExitCode code = body();
        requireOutput();
        return endTogether(code, nullptr);
    } catch (const Failure& failure) {
        return endTogether(failure.code(), &failure);
    } catch (const std::filesystem::filesystem_error& error) {
        const Failure failure = fileFailure(error);
        return endTogether(failure.code(), &failure);
    } catch (const std::bad_alloc&) {
        const Failure failure = memoryFailure();
        return endTogether(failure.code(), &failure);
    } catch (const std::exception& error) {
        return endTogether(ExitCode::numerics, &error);
    }
}

}  // namespace corpuscle
