#include "study/sweep.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <utility>

#include "core/atomicFile.hpp"
#include "core/caseFolder.hpp"
#include "core/dictionaryEdit.hpp"

namespace corpuscle::study {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

constexpr const char* logName = "log.caseSweep";
constexpr std::size_t shownLines = 15;       // of the log of a program that failed
constexpr std::size_t shownDifferences = 5;  // of a case
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

// "34.1 %" of the last line in which a solver tells how far it is.
std::string progressOf(const fs::path& log) {
    static const std::regex percent("step [0-9]+ .* ([0-9.]+ %)");
    const std::string text = tailOf(log, 2000);
    std::string found;
    for (auto at = std::sregex_iterator(text.begin(), text.end(), percent); at != std::sregex_iterator(); ++at)
        found = (*at)[1];
    return found;
}

// Whether a solver that stopped early did so by its own `stop: wallClock`: it then goes on at once, since a study is
// run to its end; a user who makes the stop file wants something else.
bool endedByWallClock(const fs::path& caseDir) {
    try {
        const auto record = nlohmann::json::parse(readFile(caseDir / "run.json"));
        return record.value("reason", "").find("wall-clock limit") != std::string::npos;
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

// The lock on a case; empty where another run of the study has it.
std::optional<Descriptor> lockOf(const fs::path& folder) {
    const fs::path path = folder.parent_path() / ("." + folder.filename().string() + ".lock");
    Descriptor file(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (file.id() < 0)
        throw Failure(ExitCode::io, fmt::format("{}: cannot be written: {}.", path.string(), std::strerror(errno)));
    // Where a file system has no such locks, the solver's own lock on its case is what remains.
    if (flock(file.id(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return std::nullopt;
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
    : options_(std::move(options)), environment_(std::move(environment)), files_(otherFiles(options_.templateCase)) {
    // Several MPI programs at a time, each of which would bind its ranks to the first cores; and ranks that are asked
    // to stop need the time to write a checkpoint.
    environment_.set("OMPI_MCA_hwloc_base_binding_policy", "none");
    environment_.set("OMPI_MCA_rmaps_base_oversubscribe", "1");
    environment_.set("OMPI_MCA_odls_base_sigkill_timeout", "120");
    fs::create_directories(options_.cases);
    std::vector<std::string> different;
    for (StudyCase& one : cases) {
        cases_.push_back({.what = std::move(one)});
        inspect(cases_.back(), different);
    }
    runs_.resize(cases_.size());
    if (!different.empty())
        throw Failure(ExitCode::invalidCase,
                      fmt::format("these cases differ from what the study makes of its template now:\n  {}\n"
                                  "-keep leaves them as they are, -update changes their dictionaries and runs them "
                                  "again (a solver continues where it may), -fresh removes them and makes them anew.",
                                  joinWords(different, "\n  ")));
}

Sweep::~Sweep() = default;

// Where the case stands, from its record.
void Sweep::inspect(CaseStatus& one, std::vector<std::string>& different) {
    const fs::path path = folder(one.what);
    one.program = options_.programs.front();
    if (!fs::exists(path)) return;
    const auto record = CaseRecord::read(path);
    if (!record)
        throw Failure(ExitCode::io,
                      fmt::format("{} exists and was not made by a study: move it away, or choose another "
                                  "folder for 'cases'.",
                                  path.string()));
    one.record = *record;
    if (const std::vector<std::string> changes = changesOf(one.what, *record); !changes.empty()) {
        switch (options_.differing) {
            case Differing::refuse:
                different.push_back(one.what.name + ": " + joinWords(changes, "; "));
                break;
            case Differing::keep:
                break;
            case Differing::update:
                update(one);
                break;
            case Differing::fresh:
                if (!lockOf(path))
                    throw Failure(ExitCode::io, fmt::format("{} is being run: stop that first.", path.string()));
                fs::remove_all(path);
                one.record = {};
                return;
        }
    }
    if (options_.retry) one.record.failed.reset();
    one.seconds = one.record.seconds();
    const std::size_t count = one.record.done.size();
    if (one.record.failed)
        one.state = CaseState::failed, one.program = one.record.failed->program;
    else if (count >= options_.programs.size())
        one.state = CaseState::done, one.program = options_.programs.back();
    else
        one.program = options_.programs[count];
}

// What differs between the dictionaries and files of a case and those that it would have now.
std::vector<std::string> Sweep::changesOf(const StudyCase& one, const CaseRecord& record) const {
    const fs::path path = folder(one);
    std::vector<std::string> changes;
    const auto wanted = dictionariesWith(options_.templateCase, one.settings);
    for (const std::string& file : dictionariesOf(options_.templateCase)) {
        const auto found = wanted.find(file);
        Problems ignored;
        const Node now = parseDictionary(found == wanted.end() ? readFile(options_.templateCase / file) : found->second,
                                         file, ignored);
        if (!fs::exists(path / file)) {
            changes.push_back(file + " is missing");
            continue;
        }
        const Node there = parseDictionary(readFile(path / file), file, ignored);
        for (const EntryDifference& d : differences(there, now))
            changes.push_back(fmt::format("{}:{} is {} and would be {}", file, d.path,
                                          d.first.empty() ? "not there" : shortened(d.first, 60),
                                          d.second.empty() ? "not there" : shortened(d.second, 60)));
    }
    for (const auto& [file, sum] : files_)
        if (const auto before = record.files.find(file); before == record.files.end() || before->second != sum)
            changes.push_back(fmt::format("the template's {} has changed", file));
    if (const std::size_t count = changes.size(); count > shownDifferences) {
        changes.resize(shownDifferences);
        changes.push_back(fmt::format("and {} more", count - shownDifferences));
    }
    return changes;
}

void Sweep::make(CaseStatus& one) {
    const fs::path path = folder(one.what);
    const fs::path hidden = path.parent_path() / fmt::format(".{}.{}", one.what.name, getpid());
    fs::remove_all(hidden);
    const std::string inTemplate = options_.cases.lexically_relative(options_.templateCase).begin()->string();
    copyCase(options_.templateCase, hidden, inTemplate == ".." ? "" : inTemplate);
    for (const auto& [file, text] : dictionariesWith(options_.templateCase, one.what.settings))
        writeFileAtomically(hidden / file, text);
    one.record = {.study = fs::relative(options_.base / options_.studyFile, path).string(),
                  .values = one.what.values,
                  .files = files_};
    one.record.write(hidden);
    fs::rename(hidden, path);
}

void Sweep::update(CaseStatus& one) {
    const fs::path path = folder(one.what);
    if (!lockOf(path)) throw Failure(ExitCode::io, fmt::format("{} is being run: stop that first.", path.string()));
    const auto wanted = dictionariesWith(options_.templateCase, one.what.settings);
    for (const std::string& file : dictionariesOf(options_.templateCase)) {
        const auto found = wanted.find(file);
        writeFileAtomically(path / file,
                            found == wanted.end() ? readFile(options_.templateCase / file) : found->second);
    }
    for (const auto& [file, sum] : files_) {
        fs::create_directories((path / file).parent_path());
        fs::copy_file(options_.templateCase / file, path / file, fs::copy_options::overwrite_existing);
    }
    one.record.values = one.what.values;
    one.record.files = files_;
    one.record.done.clear();
    one.record.failed.reset();
    one.record.write(path);
}

std::vector<std::string> Sweep::wordsFor(const std::string& program) const {
    std::vector<std::string> words;
    const bool isSolver = program == "dmpFlow" || program == "sphFlow";
    if (isSolver && options_.ranks > 1) words = {"mpirun", "-np", std::to_string(options_.ranks)};
    const fs::path beside = options_.programFolder / program;
    words.push_back(fs::is_regular_file(beside) ? beside.string() : program);
    return words;
}

// Takes a case up unless another run of the study has it.
bool Sweep::begin(std::size_t k) {
    CaseStatus& one = cases_[k];
    const fs::path path = folder(one.what);
    auto lock = lockOf(path);
    if (!lock) {
        one.state = CaseState::elsewhere;
        return false;
    }
    if (!fs::exists(path)) {
        make(one);
    } else if (const auto record = CaseRecord::read(path)) {  // another run may have gone on with it
        const bool retry = options_.retry && one.state == CaseState::waiting;
        one.record = *record;
        if (retry) one.record.failed.reset();
        one.seconds = one.record.seconds();
        if (one.record.failed || one.record.done.size() >= options_.programs.size()) {
            one.state = one.record.failed ? CaseState::failed : CaseState::done;
            one.program = one.record.failed ? one.record.failed->program : options_.programs.back();
            return false;
        }
    }
    runs_[k] = std::make_unique<Run>();
    runs_[k]->lock = std::move(*lock);
    one.state = CaseState::running;
    startNext(k);
    return true;
}

void Sweep::startNext(std::size_t k) {
    CaseStatus& one = cases_[k];
    const fs::path path = folder(one.what);
    one.program = options_.programs[one.record.done.size()];
    one.progress.clear();
    std::vector<std::string> words = wordsFor(one.program);
    words.insert(words.end(), {"-case", path.string()});
    runs_[k]->start = Clock::now();
    runs_[k]->process.emplace(std::move(words), path / logName, environment_, std::vector<int>{runs_[k]->lock.id()});
}

// A program of the case has ended.
void Sweep::settle(std::size_t k, int code) {
    CaseStatus& one = cases_[k];
    const fs::path path = folder(one.what);
    const double seconds = since(runs_[k]->start) + one.record.stoppedSeconds;
    const bool isStopped = code == static_cast<int>(ExitCode::stopped) || (isStopping_ && code != 0);
    one.record.stoppedSeconds = 0;
    if (code == 0) {
        one.record.done.push_back({.program = one.program, .seconds = seconds});
        if (one.record.done.size() >= options_.programs.size())
            one.state = CaseState::done;
        else if (isStopping_)
            one.state = CaseState::stopped;
    } else if (isStopped) {
        one.record.stoppedSeconds = seconds;
        if (isStopping_ || !endedByWallClock(path)) one.state = CaseState::stopped;
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
