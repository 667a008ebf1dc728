// Settings that take effect while the case runs: system/control.yaml and system/observers.yaml are read again when they
// change. Valid changes act at the end of a step, as at a stop and restart there: ends, results, checkpoints, stop, and
// which observers there are. A file with errors changes nothing: they are reported, and the run continues as before.
// `application`, `startFrom` and `libs` are looked at when a program starts only.
//
// The files are looked at about once per second, on rank 0. One that has just changed is read at the next look, so that
// it is not read while an editor is still writing it.
#pragma once
#include <array>
#include <filesystem>
#include <optional>

#include "simulation/schedule.hpp"

namespace corpuscle::simulation {

class LiveSettings {
  public:
    // To be constructed before the case is read, so that no edit is missed.
    explicit LiveSettings(Application& app);
    // Takes over changes into the case, the ends of the time and the schedule. Returns whether there were any.
    // Collective.
    bool update(Case& input, const coupling::Scene& scene, Time& time, Schedule& schedule);

  private:
    struct Stamp {  // of a file
        std::filesystem::file_time_type time;
        std::uintmax_t size = 0;
        bool operator==(const Stamp&) const = default;
    };
    using Stamps = std::array<std::optional<Stamp>, 2>;  // empty: no such file
    Stamps look() const;
    bool areEdited();

    Application& app_;
    Stamps read_, seen_;  // when the files were read, and at the last look
};

}  // namespace corpuscle::simulation
