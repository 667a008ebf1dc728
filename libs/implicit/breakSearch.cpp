#include "implicit/breakSearch.hpp"

#include <algorithm>
#include <cmath>

#include "core/communicator.hpp"

namespace corpuscle::implicit {

namespace {

constexpr double shareOfStep = 1e-3, strainOfBreaks = 1e-4, shareOfBroken = 0.05;

// The root of an increasing function between `before`, where it is negative, and `after`, where it is not, from above
// and to within `enough`: the Illinois variant of the regula falsi, and bisection where it moves one side only.
template <class Function>
double rootFromAbove(double before, double after, double valueBefore, double valueAfter, double enough,
                     Function&& function) {
    constexpr int most = 60;
    int repeats = 0;  // times in a row that `after` (positive) or `before` (negative) has been replaced
    for (int k = 0; k < most && after - before > enough; ++k) {
        double middle = std::abs(repeats) > 2 ? 0.5 * (before + after)
                                              : before - valueBefore * (after - before) / (valueAfter - valueBefore);
        // At least a part of `enough` from the ends, so that both ends close in on the root.
        middle = std::clamp(middle, before + 0.4 * enough, after - 0.4 * enough);
        const double value = function(middle);
        if (value > 0) {
            after = middle, valueAfter = value;
            if (repeats > 0) valueBefore *= 0.5;
            repeats = std::max(repeats, 0) + 1;
        } else {
            before = middle, valueBefore = value;
            if (repeats < 0) valueAfter *= 0.5;
            repeats = std::min(repeats, 0) - 1;
        }
    }
    return after;
}

}  // namespace

BreakTimes findBreaks(const coupling::Immersed& immersed, MPI_Comm comm, double begun,
                      const coupling::Immersed::Vectors& velocity, double horizon, double resolution) {
    constexpr double precision = 1e-6;  // of the horizon
    const coupling::NodeLayout& layout = immersed.layout();
    BreakTimes found;
    for (std::size_t c = 0; c < layout.cells(); ++c) {
        const coupling::Cell& cell = immersed.cells()[c];
        if (!cell.membrane.canRupture()) continue;
        const coupling::Immersed::Vectors start = cell.departure(begun);
        coupling::Immersed::Vectors x(start.size());
        // Time from which more than `number` elements should have broken, by an excess of `least`.
        const auto timeOf = [&](std::size_t number, double least) {
            const auto excess = [&](double t) {
                for (std::size_t n = 0; n < x.size(); ++n) x[n] = start[n] + t * velocity[layout.first(c) + n];
                return cell.membrane.ruptureExcess(x, t, number) - least;
            };
            const double atEnd = excess(horizon);
            if (!(atEnd > 0)) return never;
            const double atStart = excess(0);
            return atStart > 0 ? 0 : rootFromAbove(0, horizon, atStart, atEnd, precision * horizon, excess);
        };
        const double first = timeOf(0, 0);
        if (first == never) continue;
        found.first = std::min(found.first, first);
        double deadline = first + resolution;
        const auto late = static_cast<std::size_t>(shareOfBroken * cell.membrane.network().brokenBonds());
        if (late > 0) deadline = std::max(deadline, timeOf(late, 0));
        if (const double tolerance = cell.membrane.ruptureTolerance(); tolerance > 0)
            deadline = std::max(deadline, timeOf(0, tolerance));
        if (deadline < horizon) found.deadline = std::min(found.deadline, deadline);
    }
    const Communicator ranks(comm);
    return {ranks.min(found.first), ranks.min(found.deadline)};
}

BreakSearch::BreakSearch(double asked, double rate)
    : resolution_(std::max(shareOfStep * asked, strainOfBreaks / rate)), length_(asked) {}

bool BreakSearch::accepts(const BreakTimes& breaks) {
    const double d = length_;
    const bool isBefore = breaks.first > d, isAfter = breaks.deadline < d;
    if (isBefore ? shortestAfter_ == never : !isAfter) return true;
    if (isBefore)
        longestBefore_ = std::max(longestBefore_, d);
    else
        shortestAfter_ = std::min(shortestAfter_, d);
    const bool isClosed = shortestAfter_ - longestBefore_ <= 0.5 * resolution_;
    if (++tries_ >= mostTries || isClosed) {
        // A step that ends after the break is the only one that breaks anything.
        if (!isBefore || d >= shortestAfter_) return isCoarse_ = true;
        length_ = shortestAfter_;
        return false;
    }
    double next = 0.5 * (longestBefore_ + shortestAfter_);
    if (breaks.first != never) {
        const double last = breaks.deadline == never ? horizon() : breaks.deadline, aim = 0.5 * (breaks.first + last),
                     gap = aim - d;
        next = aim;
        if (lastLength_ > 0 && lastGap_ != gap) next = d - gap * (d - lastLength_) / (gap - lastGap_);
        lastLength_ = d, lastGap_ = gap;
    }
    const double margin = 0.1 * std::min(resolution_, shortestAfter_ - longestBefore_);
    length_ = std::clamp(next, longestBefore_ + margin, shortestAfter_ - margin);
    return false;
}

}  // namespace corpuscle::implicit
