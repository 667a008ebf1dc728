#include "core/time.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

// A sum of steps misses a round time by rounding; a millionth of a step is well above that and of no consequence.
constexpr double stepFraction = 1e-6;

}  // namespace

bool Time::running() const {
    if (!endTime && !endStrain && !lastStep) return false;
    return endReason().empty();
}

void Time::advance(double by) {
    dt = by;
    t += by;
    ++step;
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
    if (endStrain && now * shearRate >= *endStrain) return "endStrain " + formatQuantity(*endStrain, unit::none);
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
    const double now = time.t + stepFraction * time.dt;
    switch (interval_.kind) {
        case Interval::Kind::steps:
            return static_cast<double>(time.step) / interval_.value;
        case Interval::Kind::time:
            return now / interval_.value;
        case Interval::Kind::strain:
            return now * time.shearRate / interval_.value;
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

}  // namespace corpuscle
