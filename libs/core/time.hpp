// Physical time, when to stop, and what is due.
//
// Nothing here ever changes dt: what is written, watched or stopped has no influence on the state. So events fall on
// the first step at or past their time, at most one step late.
#pragma once
#include <limits>
#include <optional>
#include <string>

#include "core/settings.hpp"

namespace corpuscle {

struct Time {
    double t = 0;          // s
    double dt = 0;         // s, of the step to come (of the last one when the run has ended)
    long step = 0;         // steps done since t = 0, restarts included
    double shearRate = 0;  // 1/s; 0: the flow has none, and nothing can be counted in strain

    std::optional<double> endTime = {};    // s
    std::optional<double> endStrain = {};  // gammadot t
    std::optional<long> lastStep = {};     // of -steps N: step at the start + N

    double strain() const { return shearRate * t; }
    bool running() const;  // false too when there is no end condition at all
    void advance(double by);
    // 0 at the start of the physical time, 1 at the nearest end.
    double fraction() const;
    // The end condition that holds: "endTime 1 ms", "endStrain 6", "100 steps"; empty while running.
    std::string endReason() const;
};

// True on the first step at or past each multiple of an interval, once. A run from t = 0 starts with the multiple 0, a
// restarted run with the first multiple after its start, so that both together do each once.
class Ticker {
  public:
    Ticker() = default;  // never
    // Failure(invalidCase) for an interval in strain when the flow has no shear rate.
    Ticker(const Interval& interval, const Time& start);

    bool due(const Time& time);
    bool never() const { return interval_.kind == Interval::Kind::never; }

  private:
    double multiples(const Time& time) const;  // passed since t = 0

    Interval interval_;
    double next_ = std::numeric_limits<double>::infinity();
};

}  // namespace corpuscle
