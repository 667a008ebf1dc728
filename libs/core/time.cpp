#include "core/time.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

// A sum of steps misses a round time by rounding errors; a millionth of a step is well above these and has no
// noticeable effect.
constexpr double stepFraction = 1e-6;
constexpr double together = 1e-3;  // of a step: events closer to each other share one step

}  // namespace

bool Time::running() const {
    if (!endTime && !endStrain && !lastStep) return false;
    return endReason().empty();
}

void Time::advance(double by) {
    t += by;
    strained += shearRate * by;
    ++step;
    if (aim && aim->t) t = *aim->t;
    if (aim && aim->strain) strained = *aim->strain;
    aim.reset();
}

double Time::shorten(const std::vector<Event>& events) {
    aim.reset();
    double first = std::numeric_limits<double>::infinity();
    for (const Event& event : events)
        if (event.wait > stepFraction * dt) first = std::min(first, event.wait);
    if (!(first < 2 * dt)) return dt;
    // Of events that differ by rounding errors, the first in the list is taken.
    const Event* last = nullptr;
    for (const Event& event : events)
        if (event.wait > stepFraction * dt && event.wait <= first + together * dt &&
            (!last || event.wait > last->wait + stepFraction * dt))
            last = &event;
    if (last->wait > (1 + together) * dt) return std::min(dt, 0.5 * last->wait);
    aim = *last;
    return last->wait;
}

Event Time::atTime(double when) const { return {when - t, when, {}}; }
Event Time::atStrain(double when) const { return {(when - strained) / shearRate, {}, when}; }

std::vector<Event> Time::ends() const {
    std::vector<Event> all;
    if (endTime) all.push_back(atTime(*endTime));
    if (endStrain) all.push_back(atStrain(*endStrain));
    return all;
}

double Time::left() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Event& end : ends()) least = std::min(least, end.wait);
    return std::max(0.0, least);
}

double Time::fraction() const {
    double f = 0;
    if (endTime) f = std::max(f, t / *endTime);
    if (endStrain) f = std::max(f, strain() / *endStrain);
    if (lastStep && *lastStep > 0) f = std::max(f, static_cast<double>(step) / static_cast<double>(*lastStep));
    return std::min(f, 1.0);
}

std::string Time::endReason() const {
    const double now = t + stepFraction * dt;
    if (lastStep && step >= *lastStep) return "step " + std::to_string(*lastStep);
    if (endTime && now >= *endTime) return "endTime " + formatQuantity(*endTime, unit::second);
    if (endStrain && strained + stepFraction * dt * shearRate >= *endStrain)
        return "endStrain " + formatQuantity(*endStrain, unit::none);
    return "";
}

Ticker::Ticker(const Interval& interval, const Time& start) : interval_(interval) {
    if (never()) return;
    if (interval.kind == Interval::Kind::strain && start.shearRate == 0)
        throw Failure(ExitCode::invalidCase,
                      "an interval in strain, but the flow has no shear rate; give it in s or in steps");
    next_ = start.step == 0 ? 0 : std::floor(multiples(start)) + 1;
}

double Ticker::multiples(const Time& time) const {
    const double slack = stepFraction * time.dt;
    switch (interval_.kind) {
        case Interval::Kind::steps:
            return static_cast<double>(time.step) / interval_.value;
        case Interval::Kind::time:
            return (time.t + slack) / interval_.value;
        case Interval::Kind::strain:
            return (time.strained + slack * time.shearRate) / interval_.value;
        case Interval::Kind::never:
            break;
    }
    return 0;
}

bool Ticker::due(const Time& time) {
    if (never()) return false;
    const double passed = std::floor(multiples(time));
    if (passed < next_) return false;
    next_ = passed + 1;
    return true;
}

Event Ticker::next(const Time& time) const {
    const double at = next_ * interval_.value;
    if (interval_.kind == Interval::Kind::time) return time.atTime(at);
    if (interval_.kind == Interval::Kind::strain) return time.atStrain(at);
    return {};
}

double Ticker::seconds(const Time& time) const {
    if (interval_.kind == Interval::Kind::time) return interval_.value;
    return interval_.kind == Interval::Kind::strain ? interval_.value / time.shearRate : 0;
}

}  // namespace corpuscle
