#include "streamline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle {
namespace {

using End = Streamline::End;

constexpr double closeness = 2;  // of the end of a closed line to its seed, in steps

// The displacement of one step; not finite if it leads out of the fluid, short if directions oppose each other.
template <class Direction>
Vec3 rungeKutta(const Direction& direction, const Vec3& x, double step) {
    const Vec3 k1 = direction(x), k2 = direction(x + 0.5 * step * k1), k3 = direction(x + 0.5 * step * k2),
               k4 = direction(x + step * k3);
    return step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

// The part of a step after which the line is displaced from its seed by a period; infinite if it is not.
double partToPeriod(const Vec3& before, const Vec3& after, const Vec3& periods) {
    double part = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const double from = std::abs(before[k]), to = std::abs(after[k]);
        if (periods[k] > 0 && to >= periods[k]) part = std::min(part, (periods[k] - from) / (to - from));
    }
    return part;
}

// Continues the line, which consists of its seed, downstream (sign 1) or upstream (-1).
End follow(const VelocityAt& velocity, const Tracing& tracing, double sign, std::vector<Vec3>& points) {
    const auto direction = [&](const Vec3& x) -> Vec3 {
        const Vec3 u = velocity(x);
        const double speed = u.norm();
        return speed == 0 ? Vec3(Vec3::Zero()) : Vec3(sign / speed * u);
    };
    const Vec3 seed = points.front(), start = direction(seed);
    double step = tracing.step;
    bool away = false;  // from the seed
    for (auto left = static_cast<long>(tracing.longest / step); left > 0; --left) {
        const Vec3 x = points.back();
        Vec3 move = rungeKutta(direction, x, step);
        while (!move.allFinite() && step > tracing.step / 32) move = rungeKutta(direction, x, step /= 2);
        if (!move.allFinite()) return End::outside;
        if (move.norm() < 0.5 * step) return End::still;
        const double part = partToPeriod(x - seed, x + move - seed, tracing.periods);
        if (part <= 1) {
            points.push_back(x + part * move);
            return End::period;
        }
        const double behind = (seed - x).dot(start), ahead = move.dot(start) - behind;
        away = away || (x - seed).norm() > 2 * closeness * tracing.step;
        if (away && behind > 0 && ahead >= 0) {
            const Vec3 back = x + behind / (behind + ahead) * move;
            if ((back - seed).norm() < closeness * tracing.step) {
                points.push_back(back);
                return End::closed;
            }
        }
        points.push_back(x + move);
    }
    return End::length;
}

}  // namespace

double Streamline::length() const {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
    return sum;
}

std::string nameOf(Streamline::End end) {
    switch (end) {
        case End::closed:
            return "closed";
        case End::period:
            return "period";
        case End::outside:
            return "outside";
        case End::still:
            return "still";
        case End::length:
            return "length";
    }
    return "";
}

Streamline trace(const VelocityAt& velocity, const Vec3& seed, const Tracing& tracing) {
    Streamline line;
    line.points = {seed};
    line.downstream = follow(velocity, tracing, 1, line.points);
    if (line.downstream != End::outside && line.downstream != End::still) return line;
    std::vector<Vec3> upstream{seed};
    line.upstream = follow(velocity, tracing, -1, upstream);
    line.seed = upstream.size() - 1;
    line.points.insert(line.points.begin(), upstream.rbegin(), upstream.rend() - 1);
    return line;
}

}  // namespace corpuscle
