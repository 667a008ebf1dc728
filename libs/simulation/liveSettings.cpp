#include "simulation/liveSettings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/settingsChange.hpp"
#include "simulation/restart.hpp"
#include "simulation/startingPoint.hpp"

namespace corpuscle::simulation {

namespace {

constexpr std::array<const char*, 2> watched = {"system/control.yaml", "system/observers.yaml"};
const std::vector<std::string> atStartOnly = {"application", "startFrom", "libs"};

const Node& settingsOf(const Case& c, const std::string& file) {
    static const Node none;
    const auto entry =
        std::find_if(c.effective.begin(), c.effective.end(), [&](const Node::Entry& one) { return one.key == file; });
    return entry == c.effective.end() ? none : entry->value;
}

// A line for each setting that differs.
std::vector<std::string> changesOf(const Case& before, const Case& now) {
    std::vector<std::string> lines;
    for (const auto& [file, dictionary] : restartDictionaries()) {
        if (std::find(watched.begin(), watched.end(), file) == watched.end()) continue;
        for (const SettingChange& change : settingChanges(dictionary, settingsOf(before, file), settingsOf(now, file),
                                                          {before.spacing(), now.spacing()})) {
            const bool isLater = std::find(atStartOnly.begin(), atStartOnly.end(), change.key) != atStartOnly.end();
            lines.push_back(fmt::format("{}: {}: changed while the case runs, from {} to {}{}", file, change.key,
                                        change.before, change.now, isLater ? "; acts at the next start only" : ""));
        }
    }
    return lines;
}

// The budget of energy and momentum is kept from the start of a run or not at all.
void requireBudget(const Case& edited, const coupling::Scene& scene) {
    if (scene.budget.kept) return;
    Problems problems;
    for (const auto& [name, observer] : edited.observers.models)
        if (observer->wantsBudget(edited.flow.slides()))
            problems.add({"system/observers.yaml", 0, 0}, name,
                         fmt::format("an observer of the type {} needs the budget of energy and momentum, which this "
                                     "run does not keep, since no observer needed it at the start; stop the run and "
                                     "start it again",
                                     observer.name));
    edited.throwIfAny(problems);
}

}  // namespace

LiveSettings::LiveSettings(Application& app) : app_(app), read_(look()), seen_(read_) {}

LiveSettings::Stamps LiveSettings::look() const {
    Stamps stamps;
    if (!app_.communicator().isRoot()) return stamps;
    for (std::size_t k = 0; k < watched.size(); ++k) {
        std::error_code gone;
        const std::filesystem::path file = app_.path(watched[k]);
        const Stamp stamp{std::filesystem::last_write_time(file, gone), std::filesystem::file_size(file, gone)};
        if (!gone) stamps[k] = stamp;
    }
    return stamps;
}

bool LiveSettings::areEdited() {
    const Stamps now = look();
    const bool areSettled = now == seen_;
    seen_ = now;
    if (!app_.communicator().anyTrue(areSettled && now != read_)) return false;
    read_ = now;
    return true;
}

bool LiveSettings::update(Case& input, const coupling::Scene& scene, Time& time, Schedule& schedule) {
    // At t = 0, intervals begin with what has been written already.
    if (time.step == 0 || !schedule.isMomentToLook(time) || !areEdited()) return false;
    try {
        const Case edited = input.withEdits(app_);
        const std::vector<std::string> changes = changesOf(input, edited);
        if (changes.empty()) return false;
        requireBudget(edited, scene);
        requireOutput(app_, edited);
        schedule.change(edited, changes, scene, time);
        // What others refer to stays where it is.
        input.control = edited.control, input.observers = edited.observers, input.effective = edited.effective;
        for (const char* file : watched)
            if (const auto node = edited.files.find(file); node != edited.files.end()) input.files[file] = node->second;
        setEnds(time, input.control);
        return true;
    } catch (const Failure& fault) {
        app_.log().warning(
            "An edit of the case while it runs is not taken over; the run goes on with the settings of "
            "before. Changes of {} and {} wait until both are correct:\n{}",
            watched[0], watched[1], fault.what());
        return false;
    }
}

}  // namespace corpuscle::simulation
