// Physical time, strain, end conditions, and what is due at a step.
//
// A step ends exactly at the next event: the end of the run, an output of results, or a sample of an observer whose
// interval is not shorter than a step (docs/simulation.md). The step before an event may therefore be shorter than the
// time-step limits allow; where the remaining time is longer than one step but shorter than two, it is divided into two
// equal steps. Between steps, dt is always the value that the limits allow, so that the step after an event has its
// full length again. Checkpoints and requests to stop are not events and leave the steps unchanged.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/settings.hpp"

namespace corpuscle {

// Where a step is to end: at a time, or at a strain.
struct Event {
    double wait = std::numeric_limits<double>::infinity();  // s from now
    std::optional<double> t = {}, strain = {};              // at most one is set; none: never
};

struct Time {
    double t = 0;          // s
    double dt = 0;         // s, next step as the time-step limits allow it
    long step = 0;         // steps done since t = 0, restarts included
    double shearRate = 0;  // 1/s; 0: the flow has none, and no interval can be given in strain
    double strained = 0;   // sum of gammadot dt, since a restart may have another shear rate

    std::optional<double> endTime = {};    // s
    std::optional<double> endStrain = {};  // gammadot t
    std::optional<long> lastStep = {};     // of -steps N: step at the start + N

    double strain() const { return strained; }
    bool running() const;  // false too when there is no end condition at all
    // Ends exactly at the event that shorten() has chosen.
    void advance(double by);
    // Length of the next step, given these events: dt itself, or shorter. Events closer to each other than a thousandth
    // of dt count as one, for which the step may exceed dt by at most that much.
    double shorten(const std::vector<Event>& events);
    Event atTime(double when) const;
    Event atStrain(double when) const;
    std::vector<Event> ends() const;
    double left() const;  // s to the nearest end in time or strain
    // 0 at the start of the physical time, 1 at the nearest end.
    double fraction() const;
    // The end condition that holds: "endTime 1 ms", "endStrain 6", "step 100"; empty while running.
    std::string endReason() const;

    std::optional<Event> aim = {};  // where the next step ends; set by shorten()
};

// True on the first step at or past each multiple of an interval, once. A run from t = 0 starts with the multiple 0, a
// restarted run with the first multiple after its start, so that both together do each once.
class Ticker {
  public:
    Ticker() = default;  // never
    // Failure(invalidCase) for an interval in strain when the flow has no shear rate.
    Ticker(const Interval& interval, const Time& start);

    bool due(const Time& time);
    Event next(const Time& time) const;      // none for an interval in steps
    double seconds(const Time& time) const;  // of an interval in time or strain; 0 for one in steps
    bool never() const { return interval_.kind == Interval::Kind::never; }

  private:
    double multiples(const Time& time) const;  // number of intervals since t = 0

    Interval interval_;
    double next_ = std::numeric_limits<double>::infinity();
};

}  // namespace corpuscle
