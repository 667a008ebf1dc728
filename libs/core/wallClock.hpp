// Wall-clock time on which all ranks agree, requests to stop, and the line that shows progress.
//
// The ranks' clocks and signals differ, so they are compared in one small reduction. It is done about once per second
// of wall clock: each comparison fixes the step of the next one, from the speed seen so far. Between comparisons
// nothing is sent.
#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "core/communicator.hpp"
#include "core/log.hpp"
#include "core/time.hpp"

namespace corpuscle {

class StopControl {
  public:
    struct Settings {
        std::filesystem::path file;       // a run stops when this file appears, and removes it; empty: none
        std::optional<double> wallClock;  // s
    };

    // SIGTERM, SIGINT and SIGUSR1 (SLURM's warning) ask for a stop at the end of a step; a second one ends the program
    // at once.
    StopControl(Settings settings, const Communicator& communicator);
    ~StopControl();
    StopControl(const StopControl&) = delete;
    StopControl& operator=(const StopControl&) = delete;

    // Collective, once in each step. True when the run is to stop now; reason() says why, the same on all ranks.
    bool requested(long step);
    const std::string& reason() const { return reason_; }
    // Whether the ranks compared their clocks at this step: a moment for other things that need not be done every step.
    bool comparedAt(long step) const { return lastCheck_ == step; }
    // Other settings from now on; the wall-clock limit counts from the construction, as before.
    void change(Settings settings) { settings_ = std::move(settings); }
    // s since the construction, as agreed at the last comparison: the same on all ranks.
    double elapsed() const { return elapsed_; }

  private:
    using Clock = std::chrono::steady_clock;

    Settings settings_;
    Communicator communicator_;
    Clock::time_point start_;
    double elapsed_ = 0;
    std::optional<long> lastCheck_;
    long nextCheck_ = 0;
    std::string reason_;
};

// Due after every `interval` seconds of the agreed wall clock (checkpoints).
class WallTicker {
  public:
    WallTicker() = default;  // never
    explicit WallTicker(std::optional<double> interval) : interval_(interval), next_(interval.value_or(0)) {}
    bool due(const StopControl& clock);
    // Another interval, which begins now, unless it is the same.
    void change(std::optional<double> interval, const StopControl& clock);

  private:
    std::optional<double> interval_;
    double next_ = 0;
};

// One line every few seconds: "step 1200  t 3.1 us  strain 0.62  dt 2.6 ns  10.3 %  412 steps/s  left 4 min 10 s".
class Progress {
  public:
    Progress(Log& log, const Time& start, double every = 5);
    void report(const Time& time);

  private:
    using Clock = std::chrono::steady_clock;

    Log& log_;
    double every_;
    Clock::time_point start_, last_;
    long lastStep_;
    double startFraction_;
};

std::string formatDuration(double seconds);  // "2 h 05 min", "4 min 10 s", "3.2 s"

}  // namespace corpuscle
