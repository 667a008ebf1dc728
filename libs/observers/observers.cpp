#include "observers/observers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "observers/summary.hpp"

namespace corpuscle::observers {

const Schema<ObserversSettings>& ObserversSettings::schema() {
    static const Schema<ObserversSettings> s =
        Schema<ObserversSettings>("observers", "system/observers.yaml: what is measured while the case runs")
            .models("*", &ObserversSettings::models,
                    "one observer; its name is that of its folder under postProcessing")
            .atRestart(AtRestart::free, {"*"});
    return s;
}

void ObserversSettings::check(const Node& dictionary, const Subject& subject, Problems& problems) const {
    for (const auto& [name, choice] : models) {
        const bool strainless = choice->every.kind == Interval::Kind::strain && subject.shearRate == 0;
        const std::string text =
            strainless ? "'every' is given in strain, but the flow has no shear rate; give it in s or in steps"
                       : choice->whyNot(subject);
        if (!text.empty()) problems.add(dictionary.find(name)->place(), name, choice.name + ": " + text);
    }
}

bool ObserversSettings::wantBudget(bool slidingImages) const {
    return std::any_of(models.begin(), models.end(),
                       [&](const auto& entry) { return entry.second->wantsBudget(slidingImages); });
}

namespace {

// A file name that two tables of one observation would share; empty: none.
std::string sharedFile(const Observation& observation) {
    std::set<std::string> names;
    for (const Table& table : observation.tables())
        if (!names.insert(table.file).second) return table.file;
    return {};
}

}  // namespace

Observers::Observers(const ObserversSettings& settings, const Scene& scene, const Time& start,
                     std::filesystem::path caseDir)
    : caseDir_(std::move(caseDir)) {
    if (start.step > 0) restart_ = start.t;
    Problems problems;
    for (const auto& [name, choice] : settings.models) {
        Running observer{name, choice.name, choice, Ticker(choice->every, start), choice->begin(scene), {}};
        if (const std::string file = sharedFile(*observer.observation); !file.empty())
            problems.add({"system/observers.yaml", 0, 0}, name,
                         choice.name + ": two of its files would be called " + file +
                             ".csv; give the cell of this name another one in system/mesh.yaml");
        running_.push_back(std::move(observer));
    }
    problems.throwIfAny();
}

void Observers::openFiles(const Scene& scene) {
    io::clearTables(scene.system->comm(), caseDir_, "observer", restart_);
    for (Running& observer : running_)
        for (const Table& table : observer.observation->tables()) {
            io::CsvHead head{observer.name, table.file, "observer " + observer.type,
                             Registry<Observer>::instance().find(observer.type)->text, timeColumns()};
            head.columns.insert(head.columns.end(), table.columns.begin(), table.columns.end());
            observer.files.emplace_back(scene.system->comm(), caseDir_, head, restart_);
            if (const std::string& note = observer.files.back().note(); !note.empty()) notes_.push_back(note);
        }
    filesOpen_ = true;
}

namespace {

// Rows are the same on all ranks, and so is the result.
void requireFinite(const std::string& name, const Observation& observation, const Row& row, const Time& time) {
    const Table& table = observation.tables()[row.table];
    for (std::size_t k = 0; k < row.values.size(); ++k) {
        const double value = row.values[k];
        if (std::isfinite(value) || (std::isnan(value) && observation.leavesGaps())) continue;
        throw Failure(ExitCode::numerics,
                      fmt::format("step {}, t = {:.6g} s: the observer '{}' has {} in the column {} of {}.csv: the run "
                                  "has diverged, or a value of the case is beyond what numbers can hold",
                                  time.step, time.t, name, value, table.columns[k].header(), table.file));
    }
}

}  // namespace

void Observers::write(Running& observer, const Time& time, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        std::vector<double> values{time.t, time.strain()};
        values.insert(values.end(), row.values.begin(), row.values.end());
        requireFinite(observer.name, *observer.observation, row, time);
        observer.files[row.table].row(values);
    }
}

void Observers::run(const Scene& scene, const Time& time) {
    if (!filesOpen_ && !caseDir_.empty()) openFiles(scene);
    for (Running& observer : running_) {
        if (observer.observation->watchesSteps()) write(observer, time, observer.observation->afterStep(scene, time));
        if (observer.ticker.due(time)) write(observer, time, observer.observation->observe(scene, time));
    }
}

void Observers::addEvents(const Time& time, std::vector<Event>& events) const {
    for (const Running& observer : running_)
        if (observer.ticker.seconds(time) > (1 - 1e-3) * time.dt) events.push_back(observer.ticker.next(time));
}

std::vector<std::pair<std::string, Summary>> Observers::summaries(const Scene& scene, const Time& time) {
    std::vector<std::pair<std::string, Summary>> all;
    for (Running& observer : running_)
        if (std::optional<Summary> summary = observer.observation->summary(scene, time))
            all.emplace_back(observer.name, std::move(*summary));
    return all;
}

// A sequence of (length of the key, its characters, length of the state, its numbers).
std::vector<double> Observers::state() const {
    std::vector<double> all;
    for (const Running& observer : running_) {
        const std::vector<double> own = observer.observation->state();
        if (own.empty()) continue;
        const std::string key = observer.key();
        all.push_back(static_cast<double>(key.size()));
        all.insert(all.end(), key.begin(), key.end());
        all.push_back(static_cast<double>(own.size()));
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

void Observers::restore(const std::vector<double>& state) {
    std::span<const double> rest(state);
    const auto take = [&rest] {
        const auto count = rest.empty() ? rest.size() : static_cast<std::size_t>(rest[0]);
        if (rest.empty() || count > rest.size() - 1)
            throw Failure(ExitCode::io,
                          "the checkpoint's state of the observers is cut short; restart from another checkpoint");
        const auto part = rest.subspan(1, count);
        rest = rest.subspan(1 + count);
        return part;
    };
    while (!rest.empty()) {
        const auto letters = take(), numbers = take();
        std::string key;
        for (const double letter : letters) key += static_cast<char>(letter);
        for (Running& observer : running_)
            if (observer.key() == key) observer.observation->restore(numbers);
    }
}

Observers::Memory Observers::remember() const {
    Memory memory{{}, state()};
    for (const Running& observer : running_) memory.tickers.push_back(observer.ticker);
    return memory;
}

void Observers::goBack(const Memory& memory, const Scene& scene, const Time& time) {
    for (std::size_t k = 0; k < running_.size(); ++k) {
        Running& observer = running_[k];
        observer.ticker = memory.tickers[k];
        observer.observation = observer.model->begin(scene);
        for (io::CsvSeries& file : observer.files) file.cutAfter(time.t);
    }
    restore(memory.state);
}

}  // namespace corpuscle::observers
