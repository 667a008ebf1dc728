#include "study/sweep.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <utility>

#include "core/atomicFile.hpp"
#include "core/caseFolder.hpp"
#include "core/caseLock.hpp"
#include "core/dictionaryEdit.hpp"

namespace corpuscle::study {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

constexpr const char* logName = "log.caseSweep";
constexpr std::size_t shownLines = 15;       // of the log of a program that failed
constexpr std::size_t shownDifferences = 5;  // shown for one case
constexpr auto pauseBetweenLooks = std::chrono::seconds(1);

// The end of a file, at most so many bytes.
std::string tailOf(const fs::path& path, long bytes) {
    std::ifstream file(path, std::ios::binary);
    file.seekg(0, std::ios::end);
    const long size = file ? static_cast<long>(file.tellg()) : 0;
    file.seekg(std::max(0L, size - bytes));
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string lastLines(const fs::path& path, std::size_t count) {
    std::string text = tailOf(path, 8000);
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    std::size_t begin = text.size();
    for (std::size_t k = 0; k < count && begin != std::string::npos && begin > 0; ++k)
        begin = text.rfind('\n', begin - 1);
    return begin == std::string::npos || begin == 0 ? text : text.substr(begin + 1);
}

// "34.1 %" from the last line in which a solver reports its progress.
std::string progressOf(const fs::path& log) {
    static const std::regex percent("step [0-9]+ .* ([0-9.]+ %)");
    const std::string text = tailOf(log, 2000);
    std::string found;
    for (auto at = std::sregex_iterator(text.begin(), text.end(), percent); at != std::sregex_iterator(); ++at)
        found = (*at)[1];
    return found;
}

// Whether a solver stopped early because of its own `stop: wallClock`. It then continues at once, since a study is run
// to its end; a user who makes the stop file wants the solver to stay stopped.
bool endedByWallClock(const fs::path& caseDir) {
    try {
        const auto record = nlohmann::json::parse(readFile(caseDir / "run.json"));
        return record.value("reason", "").find("wall-clock limit") != std::string::npos &&
               record.at("performance").value("steps", 0) > 0;  // otherwise it would be continued for ever
    } catch (const std::exception&) {
        return false;
    }
}

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

class Descriptor {
  public:
    explicit Descriptor(int id = -1) : id_(id) {}
    Descriptor(Descriptor&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Descriptor() {
        if (id_ >= 0) close(id_);
    }
    int id() const { return id_; }

  private:
    int id_;
};

bool isSolver(const std::string& program) { return program == "dmpFlow" || program == "sphFlow"; }

// Dictionaries that define the length of the run, what is written and what is measured: a solver can continue after any
// change of them.
bool isOfTheRun(const std::string& file) { return file == "system/control.yaml" || file == "system/observers.yaml"; }

// The lock on a case; empty where another run of the study has it.
std::optional<Descriptor> lockOf(const fs::path& folder) {
    const fs::path path = folder.parent_path() / ("." + folder.filename().string() + ".lock");
    Descriptor file(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (file.id() < 0)
        throw Failure(ExitCode::io, fmt::format("{}: cannot be written: {}.", path.string(), std::strerror(errno)));
    // On a file system without such locks, only the solver's own lock protects its case.
    if (flock(file.id(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return std::nullopt;
    return file;
}

// The lock of the programs themselves (core/caseLock.hpp), which somebody may have started by hand: empty where a
// program holds it.
std::optional<Descriptor> lockInside(const fs::path& folder) {
    Descriptor file(open((folder / CaseLock::fileName).c_str(), O_RDWR | O_CLOEXEC));
    if (file.id() >= 0 && flock(file.id(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return std::nullopt;
    return file;
}

}  // namespace

const char* nameOf(CaseState state) {
    switch (state) {
        case CaseState::waiting:
            return "waiting";
        case CaseState::running:
            return "running";
        case CaseState::elsewhere:
            return "elsewhere";
        case CaseState::done:
            return "done";
        case CaseState::failed:
            return "failed";
        case CaseState::stopped:
            return "stopped";
    }
    throw std::logic_error("a state of a case without a name");
}

struct Sweep::Run {
    Descriptor lock;
    std::optional<Process> process;
    Clock::time_point start;
};

Sweep::Sweep(SweepOptions options, std::vector<StudyCase> cases, Environment environment)
    : options_(std::move(options)), environment_(std::move(environment)) {
    inTemplate_ = options_.cases.lexically_relative(options_.templateCase).begin()->string();
    if (inTemplate_ == "..") inTemplate_.clear();
    files_ = otherFiles(options_.templateCase, inTemplate_);
    // Several MPI programs run at a time, and each of them would bind its ranks to the first cores. If this process is
    // killed, mpirun ends the ranks, which then have a few seconds to write a checkpoint; if ranks have stopped by
    // themselves, with code 5, mpirun waits as long before it ends.
    environment_.set("OMPI_MCA_hwloc_base_binding_policy", "none");
    environment_.set("OMPI_MCA_rmaps_base_oversubscribe", "1");
    if (geteuid() == 0) {  // as in a container: running as root is intended
        environment_.set("OMPI_ALLOW_RUN_AS_ROOT", "1");
        environment_.set("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
    }
    environment_.set("OMPI_MCA_odls_base_sigkill_timeout", "3");
    if (!options_.readOnly) fs::create_directories(options_.cases);
    std::vector<std::string> different;
    for (StudyCase& one : cases) {
        cases_.push_back({.what = std::move(one)});
        inspect(cases_.back(), different);
    }
    runs_.resize(cases_.size());
    if (!different.empty())
        throw Failure(
            ExitCode::invalidCase,
            fmt::format("these cases differ from what the study makes of its template now:\n  {}\n"
                        "-keep leaves them as they are, -fresh removes them and makes them anew, -update goes on "
                        "with them after changes of system/control.yaml and system/observers.yaml.",
                        joinWords(different, "\n  ")));
}

Sweep::~Sweep() = default;

// Determines the state of the case from its record: the programs that have ended, in the order of the list, as long as
// their output exists.
void Sweep::takeState(CaseStatus& one) const {
    CaseRecord& record = one.record;
    const fs::path path = folder(one.what);
    const std::vector<std::string>& programs = one.what.programs;
    const auto isThere = [&](const std::string& program) {
        if (program == "particleFill") return fs::exists(path / "0" / "fluid.vtp");
        return !(isSolver(program) || program == "membraneRelax") || fs::exists(path / "run.json");
    };
    std::size_t count = 0;
    while (count < record.done.size() && count < programs.size() && record.done[count].program == programs[count] &&
           isThere(programs[count]))
        ++count;
    if (count < record.done.size() && record.done[count].program == "particleFill") count = 0;  // the mesh is gone too
    record.done.resize(count);
    if (one.retries) record.failed.reset();
    one.seconds = record.seconds();
    one.state = CaseState::waiting;
    one.program = programs[std::min(count, programs.size() - 1)];
    if (record.failed)
        one.state = CaseState::failed, one.program = record.failed->program;
    else if (count == programs.size())
        one.state = CaseState::done;
}

void Sweep::inspect(CaseStatus& one, std::vector<std::string>& different) {
    const fs::path path = folder(one.what);
    one.program = one.what.programs.front();
    if (!fs::exists(path)) return;
    std::optional<CaseRecord> record;
    try {
        record = CaseRecord::read(path);
    } catch (const Failure& failure) {
        if (failure.code() != ExitCode::invalidCase) throw;  // the file cannot be read at the moment
        if (options_.readOnly || options_.differing == Differing::keep)
            one.state = CaseState::failed,
            one.record.failed = CaseRecord::Ended{.program = one.program, .code = 4, .logEnd = failure.what()};
        else if (options_.differing == Differing::fresh)
            one.plan = Differing::fresh;
        else
            different.push_back(fmt::format("{}: its sweep.json is damaged; -only {} -fresh makes it anew",
                                            one.what.name, one.what.name));
        return;
    }
    if (!record)
        throw Failure(ExitCode::io,
                      fmt::format("{} exists and was not made by a study: move it away, or choose another "
                                  "folder for 'cases'.",
                                  path.string()));
    one.record = *record;
    const bool isFailed = record->failed.has_value();
    one.retries = options_.retry && !options_.readOnly && isFailed;
    takeState(one);
    const Changes changes = changesOf(one.what, *record);
    const Differing chosen = options_.readOnly ? Differing::keep : options_.differing;
    if (chosen == Differing::fresh && (isFailed || !changes.texts.empty())) {
        one.plan = Differing::fresh;
        one.state = CaseState::waiting;
        one.program = one.what.programs.front();
        return;
    }
    if (changes.texts.empty()) return;
    switch (chosen) {
        case Differing::refuse:
            different.push_back(one.what.name + ": " + joinWords(changes.texts, "; "));
            break;
        case Differing::update:
            if (!changes.areOfTheRun) {
                different.push_back(one.what.name + ": " + joinWords(changes.texts, "; "));
                break;
            }
            one.plan = Differing::update;
            one.state = CaseState::waiting;
            one.program = *std::find_if(one.what.programs.begin(), one.what.programs.end() - 1, isSolver);
            break;
        case Differing::keep:  // its row shows the values with which it was run
            if (record->values.size() == one.what.values.size()) one.what.values = record->values;
            break;
        case Differing::fresh:
            break;
    }
}

std::string Sweep::wantedText(const StudyCase& one, const std::string& file) const {
    const auto changed = dictionariesWith(options_.templateCase, one.settings);
    const auto found = changed.find(file);
    return found == changed.end() ? readFile(options_.templateCase / file) : found->second;
}

// Differences between the dictionaries and files of a case and those that it would have now.
Sweep::Changes Sweep::changesOf(const StudyCase& one, const CaseRecord& record) const {
    const fs::path path = folder(one);
    Changes changes;
    const auto note = [&](const std::string& text, bool isOfRun = false) {
        changes.texts.push_back(text);
        changes.areOfTheRun = changes.areOfTheRun && isOfRun;
    };
    const auto wanted = dictionariesWith(options_.templateCase, one.settings);
    const std::vector<std::string> files = dictionariesOf(options_.templateCase);
    for (const std::string& file : files) {
        const auto found = wanted.find(file);
        Problems ignored;
        const Node now = parseDictionary(found == wanted.end() ? readFile(options_.templateCase / file) : found->second,
                                         file, ignored);
        if (!fs::exists(path / file)) {
            note(file + " is missing");
            continue;
        }
        const Node there = parseDictionary(readFile(path / file), file, ignored);
        for (const EntryDifference& d : differences(there, now))
            note(fmt::format("{}:{} is {} and would be {}", file, d.path,
                             d.first.empty() ? "not there" : shortened(d.first, 60),
                             d.second.empty() ? "not there" : shortened(d.second, 60)),
                 isOfTheRun(file) && d.path != "/application" && d.path != "/startFrom");
    }
    for (const std::string& file : dictionariesOf(path))
        if (std::find(files.begin(), files.end(), file) == files.end())
            note(fmt::format("{} is not in the template", file));
    for (const auto& [file, sum] : files_)
        if (const auto before = record.files.find(file); before == record.files.end() || before->second != sum)
            note(fmt::format("the template's {} has changed", file));
    for (const auto& [file, sum] : record.files)
        if (!files_.contains(file)) note(fmt::format("{} is not in the template any more", file));
    if (const std::size_t count = changes.texts.size(); count > shownDifferences) {
        changes.texts.resize(shownDifferences);
        changes.texts.push_back(fmt::format("and {} more", count - shownDifferences));
    }
    return changes;
}

void Sweep::make(CaseStatus& one) const {
    const fs::path path = folder(one.what), hidden = path.parent_path() / ("." + one.what.name + ".new");
    fs::remove_all(hidden);  // left by a run that was killed here: this run holds the lock
    copyCase(options_.templateCase, hidden, inTemplate_);
    for (const auto& [file, text] : dictionariesWith(options_.templateCase, one.what.settings))
        writeFileAtomically(hidden / file, text);
    one.record = {.study = fs::relative(options_.base / options_.studyFile, path).string(),
                  .values = one.what.values,
                  .files = files_};
    one.record.write(hidden);
    fs::rename(hidden, path);
}

// Writes the record first: a kill in between leaves a case whose solver has not ended and which still differs.
void Sweep::update(CaseStatus& one) const {
    const fs::path path = folder(one.what);
    // The solver and the programs after it run again; all programs if there is no solver.
    std::vector<CaseRecord::Ended>& done = one.record.done;
    const auto solver = std::find_if(done.begin(), done.end(), [](const auto& ended) {
        return isSolver(ended.program) || ended.program == "membraneRelax";
    });
    done.erase(solver == done.end() ? done.begin() : solver, done.end());
    one.record.failed.reset();
    one.record.write(path);
    for (const std::string& file : dictionariesOf(options_.templateCase))
        if (isOfTheRun(file)) writeFileAtomically(path / file, wantedText(one.what, file));
}

std::vector<std::string> Sweep::wordsFor(const std::string& program) const {
    std::vector<std::string> words;
    if (isSolver(program) && options_.ranks > 1) words = {"mpirun", "-np", std::to_string(options_.ranks)};
    const fs::path beside = options_.programFolder / program;
    words.push_back(fs::is_regular_file(beside) ? beside.string() : program);
    return words;
}

void Sweep::fail(CaseStatus& one, const std::string& reason) const {
    one.state = CaseState::failed;
    one.record.failed = CaseRecord::Ended{.program = one.program, .code = 4, .seconds = 0, .logEnd = reason};
    try {
        if (fs::exists(folder(one.what) / CaseRecord::fileName)) one.record.write(folder(one.what));
    } catch (const std::exception&) {  // the failure is reported all the same
        return;
    }
}

// Whether the plan to remove a case still holds: another run of the study may have made it anew in the meantime.
bool Sweep::isToBeFresh(const CaseStatus& one) const {
    try {
        const auto record = CaseRecord::read(folder(one.what));
        return !record || record->failed || !changesOf(one.what, *record).texts.empty();
    } catch (const Failure& failure) {
        if (failure.code() != ExitCode::invalidCase) throw;
        return true;
    }
}

// Starts a case unless another run of the study, or a program that somebody has started, is working on it.
bool Sweep::begin(std::size_t k) {
    CaseStatus& one = cases_[k];
    const fs::path path = folder(one.what);
    try {
        auto lock = lockOf(path);
        auto inside = lock ? lockInside(path) : std::nullopt;
        if (!lock || !inside) {
            one.state = CaseState::elsewhere;
            return false;
        }
        const fs::path old = path.parent_path() / ("." + one.what.name + ".old");
        fs::remove_all(old);  // left by a run that was killed while removing it
        const Differing plan = std::exchange(one.plan, Differing::keep);
        if (plan == Differing::fresh && fs::exists(path) && isToBeFresh(one)) {  // renamed first: never half a case
            fs::rename(path, old);
            fs::remove_all(old);
        }
        if (!fs::exists(path)) {
            make(one);
        } else if (const auto record = CaseRecord::read(path)) {  // another run may have continued it
            one.record = *record;
            const Changes changes = plan == Differing::update ? changesOf(one.what, *record) : Changes{};
            if (!changes.texts.empty() && changes.areOfTheRun) update(one);
            takeState(one);
            one.retries = false;
            if (one.state != CaseState::waiting) return false;
        }
        inside.reset();  // from here on the program takes this lock
        runs_[k] = std::make_unique<Run>();
        runs_[k]->lock = std::move(*lock);
        one.state = CaseState::running;
        startNext(k);
        return true;
    } catch (const std::exception& error) {  // an error of this case only: the others continue
        runs_[k].reset();
        fail(one, error.what());
        return false;
    }
}

void Sweep::startNext(std::size_t k) {
    CaseStatus& one = cases_[k];
    const fs::path path = folder(one.what);
    one.program = one.what.programs[one.record.done.size()];
    one.progress.clear();
    std::vector<std::string> words = wordsFor(one.program);
    words.insert(words.end(), {"-case", path.string()});
    runs_[k]->start = Clock::now();
    runs_[k]->process.emplace(std::move(words), path / logName, environment_, std::vector<int>{runs_[k]->lock.id()});
}

// Handles the end of a program of the case. Errors are those of this case only: the others continue.
void Sweep::settle(std::size_t k, int code) {
    CaseStatus& one = cases_[k];
    const fs::path path = folder(one.what);
    try {
        if (!fs::exists(path / CaseRecord::fileName))
            throw Failure(ExitCode::io, fmt::format("{} was removed while {} ran in it", path.string(), one.program));
        note(k, code);
    } catch (const std::exception& error) {
        runs_[k].reset();
        fail(one, error.what());
    }
}

void Sweep::note(std::size_t k, int code) {
    CaseStatus& one = cases_[k];
    const fs::path path = folder(one.what);
    const double seconds = since(runs_[k]->start) + one.record.stoppedSeconds;
    // A signal from outside, such as at the end of a batch job or at shutdown of the machine, counts as a stop too.
    const bool isSignal = code == 128 + SIGTERM || code == 128 + SIGINT || code == 128 + SIGHUP;
    const bool isStopped = code == static_cast<int>(ExitCode::stopped) || isSignal || (isStopping_ && code != 0);
    one.record.stoppedSeconds = 0;
    if (code == 0) {
        one.record.done.push_back({.program = one.program, .seconds = seconds});
        if (one.record.done.size() >= one.what.programs.size())
            one.state = CaseState::done;
        else if (isStopping_)
            one.state = CaseState::stopped;
    } else if (isStopped) {
        one.record.stoppedSeconds = seconds;
        if (isStopping_ || isSignal || !endedByWallClock(path)) one.state = CaseState::stopped;
    } else {
        one.record.failed = CaseRecord::Ended{
            .program = one.program, .code = code, .seconds = seconds, .logEnd = lastLines(path / logName, shownLines)};
        one.state = CaseState::failed;
    }
    one.record.write(path);
    one.seconds = one.record.seconds();
    if (one.state == CaseState::running)
        startNext(k);
    else
        runs_[k].reset();
}

bool Sweep::advance() {
    bool changed = false;
    const bool looks = Clock::now() - looked_ > pauseBetweenLooks;
    if (looks) looked_ = Clock::now();
    long running = 0;
    for (std::size_t k = 0; k < cases_.size(); ++k) {
        if (!runs_[k]) continue;
        if (const auto code = runs_[k]->process->poll()) {
            settle(k, *code);
            changed = true;
        } else {
            cases_[k].seconds = cases_[k].record.seconds() + since(runs_[k]->start);
            if (looks) cases_[k].progress = progressOf(folder(cases_[k].what) / logName);
        }
        running += runs_[k] ? 1 : 0;
    }
    for (std::size_t k = 0; k < cases_.size() && running < options_.jobs && !isStopping_; ++k) {
        const CaseState state = cases_[k].state;
        if (state != CaseState::waiting && !(state == CaseState::elsewhere && looks)) continue;
        if (begin(k)) ++running;
        changed = changed || cases_[k].state != state;
    }
    return changed;
}

bool Sweep::isEnded() const {
    return std::none_of(cases_.begin(), cases_.end(), [&](const CaseStatus& one) {
        return one.state == CaseState::running ||
               (!isStopping_ && (one.state == CaseState::waiting || one.state == CaseState::elsewhere));
    });
}

void Sweep::stop() {
    isStopping_ = true;
    for (const auto& run : runs_)
        if (run) run->process->stop();
}

}  // namespace corpuscle::study
