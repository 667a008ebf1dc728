#include "boundary/networkWalls.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/units.hpp"

namespace corpuscle::boundary {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double slowestMode = 2.4048;  // first zero of the Bessel function J0
constexpr double cubesInRadius = 16;    // of the smallest cubes of volumeWithin
constexpr double covered =
    1e-3;  // of the least radius: depth within another tube at which a point is still on the wall
constexpr double sameJoint = 1e-3;   // of the least radius: distance of ends that join
constexpr double nearJoint = 0.05;   // the same, of ends that are meant to join
constexpr double rounding = 1e-6;    // of the least radius: what counts as on the wall, and as the same joint
constexpr double leastSine2 = 1e-4;  // of the angle of two walls that meet in a curve, squared
constexpr int mostIterations = 50;
constexpr int pointsInRadius = 8;  // of the points from which the curves are found

Vec3 acrossOf(const Vec3& along) {
    const Vec3 other = std::abs(along[2]) < 0.9 * along.norm() ? Vec3::UnitZ() : Vec3::UnitY();
    return along.cross(other).normalized();
}

// Joints of a network: ends of tubes at the same place, up to periods of the box along x.
struct Joints {
    std::vector<Vec3> places;
    double period, tolerance;
    Joints(double boxLength, double within) : period(boxLength), tolerance(within) {}
    std::size_t at(const Vec3& x) {
        for (std::size_t k = 0; k < places.size(); ++k) {
            Vec3 apart = places[k] - x;
            apart[0] -= period * std::round(apart[0] / period);
            if (apart.norm() < tolerance) return k;
        }
        places.push_back(x);
        return places.size() - 1;
    }
};

double leastRadius(const std::vector<Tube>& tubes) {
    double least = std::numeric_limits<double>::infinity();
    for (const Tube& tube : tubes) least = std::min(least, tube.radius());
    return least;
}

// Flow along x, averaged over the box [m^4].
double flowAlong(const std::vector<Tube>& tubes, const std::vector<double>& flows, double boxLength) {
    double sum = 0;
    for (std::size_t t = 0; t < tubes.size(); ++t) sum += flows[t] * (tubes[t].to - tubes[t].from)[0] / boxLength;
    return sum;
}

}  // namespace

const Schema<Tube>& Tube::schema() {
    static const Schema<Tube> s =
        Schema<Tube>("tube", "one straight tube of a network; tubes join where their ends are at the same place")
            .vector("from", &Tube::from, unit::metre, "one end of its axis, from the middle of the box")
            .vector("to", &Tube::to, unit::metre, "the other end")
            .quantity("diameter", &Tube::diameter, unit::metre, "of the tube", {.range = positive});
    return s;
}

TubeNetwork::TubeNetwork(const std::vector<Tube>& tubes, const particles::Box& fluid) : box_(fluid) {
    const double length = fluid.size()[0];
    least_ = leastRadius(tubes);
    for (const Tube& tube : tubes) largest_ = std::max(largest_, tube.radius());
    for (const Tube& tube : tubes)
        for (const int image : {0, -1, 1}) {
            const Vec3 a = fluid.middle() + tube.from + Vec3(image * length, 0, 0),
                       b = fluid.middle() + tube.to + Vec3(image * length, 0, 0);
            const double reach = 2 * largest_;  // as deep as walls are filled
            if (image != 0 &&
                (std::max(a[0], b[0]) < fluid.low[0] - reach || std::min(a[0], b[0]) > fluid.high[0] + reach))
                continue;
            axes_.push_back({a, b - a, tube.radius(), (b - a).squaredNorm()});
        }
    findRidges();
    const double step = 2 * least_ / cubesInRadius;
    area_ = (volumeWithin(step) - volumeWithin(-step)) / (2 * step);
}

// Points of the wall of tube i that are near the wall of tube j are moved onto the curve where both meet; points of the
// curve that are near a third wall, to the corner.
void TubeNetwork::findRidges() {
    const auto addNew = [&](std::vector<Vec3>& points, const Vec3& y, double apart) {
        for (const Vec3& known : points)
            if ((known - y).norm() < apart) return;
        points.push_back(y);
    };
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const Axis& axis = axes_[i];
        const double spacing = axis.radius / pointsInRadius, length = std::sqrt(axis.square);
        const Vec3 e = axis.along / length, p = acrossOf(e), q = e.cross(p);
        std::vector<Vec3> surface;
        const int around = static_cast<int>(2 * pi * pointsInRadius), along = static_cast<int>(length / spacing) + 1;
        for (int a = 0; a < around; ++a) {
            const double angle = 2 * pi * a / around;
            const Vec3 out = std::cos(angle) * p + std::sin(angle) * q;
            for (int s = 0; s <= along; ++s) surface.push_back(axis.from + axis.along * s / along + axis.radius * out);
            for (int s = 1; s <= pointsInRadius; ++s)
                for (const int end : {0, 1}) {
                    const double polar = 0.5 * pi * s / pointsInRadius;
                    surface.push_back(axis.from + end * axis.along +
                                      axis.radius * (std::cos(polar) * out + (2 * end - 1) * std::sin(polar) * e));
                }
        }
        for (std::size_t j = i + 1; j < axes_.size(); ++j) {
            Ridge ridge{i, j, spacing, {}};
            std::vector<Vec3> all;
            for (const Vec3& x : surface)
                if (std::abs(foot(axes_[j], x).gap) < 2 * spacing)
                    if (const auto on = ontoCurve(i, j, x)) addNew(all, on->place, 0.5 * spacing);
            for (const Vec3& y : all) {
                if (isOnWall(y)) ridge.points.push_back(y);
                for (std::size_t k = 0; k < axes_.size(); ++k)
                    if (k != i && k != j && std::abs(foot(axes_[k], y).gap) < 2 * spacing)
                        if (const auto at = corner(i, j, k, y); at && isOnWall(*at))
                            addNew(corners_, *at, rounding * least_);
            }
            if (!ridge.points.empty()) ridges_.push_back(std::move(ridge));
        }
    }
}

TubeNetwork::Foot TubeNetwork::foot(const Axis& axis, const Vec3& x) const {
    const double share = axis.square > 0 ? std::clamp((x - axis.from).dot(axis.along) / axis.square, 0.0, 1.0) : 0;
    const Vec3 centre = axis.from + share * axis.along;
    return {centre, axis.radius - (x - centre).norm()};
}

double TubeNetwork::largestGap(const Vec3& x, std::size_t* which) const {
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < axes_.size(); ++i)
        if (const double gap = foot(axes_[i], x).gap; gap > largest) {
            largest = gap;
            if (which) *which = i;
        }
    return largest;
}

bool TubeNetwork::isOnWall(const Vec3& x) const { return largestGap(x) < covered * least_; }

std::optional<TubeNetwork::OnCurve> TubeNetwork::ontoCurve(std::size_t i, std::size_t j, Vec3 y) const {
    for (int k = 0; k < mostIterations; ++k) {
        const Foot one = foot(axes_[i], y), other = foot(axes_[j], y);
        const Vec3 ni = (y - one.centre).normalized(), nj = (y - other.centre).normalized();
        const double c = ni.dot(nj), sine2 = 1 - c * c;
        if (!(sine2 > leastSine2)) return {};
        if (std::max(std::abs(one.gap), std::abs(other.gap)) < 0.1 * rounding * least_)
            return OnCurve{y, ni.cross(nj).normalized()};
        y += (one.gap - c * other.gap) / sine2 * ni + (other.gap - c * one.gap) / sine2 * nj;
    }
    return {};
}

// Down the distance from x, along the curve: steps along its tangent, each brought back to both walls and shortened
// until the distance falls.
std::optional<Vec3> TubeNetwork::meeting(std::size_t i, std::size_t j, const Vec3& x, const Vec3& start) const {
    const double within = 0.1 * rounding * least_;
    std::optional<OnCurve> at = ontoCurve(i, j, start);
    for (int k = 0; at && k < mostIterations; ++k) {
        double step = (x - at->place).dot(at->tangent);
        std::optional<OnCurve> next;
        for (; std::abs(step) > within; step *= 0.5)
            if (next = ontoCurve(i, j, at->place + step * at->tangent);
                next && (x - next->place).norm() < (x - at->place).norm())
                break;
        if (std::abs(step) <= within) break;
        at = next;
    }
    return at ? std::optional(at->place) : std::nullopt;
}

std::optional<Vec3> TubeNetwork::corner(std::size_t i, std::size_t j, std::size_t k, const Vec3& start) const {
    Vec3 y = start;
    for (int n = 0; n < mostIterations; ++n) {
        Mat3 slopes;
        Vec3 gaps;
        int row = 0;
        for (const std::size_t one : {i, j, k}) {
            const Foot at = foot(axes_[one], y);
            slopes.row(row) = (y - at.centre).normalized().transpose(), gaps[row++] = at.gap;
        }
        if (gaps.cwiseAbs().maxCoeff() < 0.1 * rounding * least_) return y;
        if (!(std::abs(slopes.determinant()) > leastSine2)) return {};
        y += slopes.inverse() * gaps;
    }
    return {};
}

TubeNetwork::Found TubeNetwork::nearest(const Vec3& point) const {
    const Vec3 x(box_.wrap(point[0], 0), point[1], point[2]);
    std::size_t winner = 0;
    const double largest = largestGap(x, &winner);
    const auto outwards = [&](std::size_t i, const Foot& at) {
        const Vec3 out = x - at.centre;
        return out.norm() > 0 ? Vec3(out.normalized()) : acrossOf(axes_[i].along);
    };
    const Foot own = foot(axes_[winner], x);
    const Vec3 out = outwards(winner, own);
    if (largest <= 0 || isOnWall(own.centre + axes_[winner].radius * out)) return {largest, -out};

    // Near a joint.
    Found best{std::numeric_limits<double>::infinity(), -out};
    std::vector<Foot> feet;
    for (const Axis& axis : axes_) feet.push_back(foot(axis, x));
    const auto footOn = [&](std::size_t i) { return Vec3(feet[i].centre + axes_[i].radius * outwards(i, feet[i])); };
    for (std::size_t i = 0; i < axes_.size(); ++i)
        if (const double apart = std::abs(feet[i].gap); apart < best.distance && isOnWall(footOn(i)))
            best = {apart, apart > rounding * least_ ? Vec3((x - footOn(i)) / apart) : Vec3(-outwards(i, feet[i]))};
    const auto take = [&](const Vec3& y) {
        if (const double apart = (x - y).norm(); apart < best.distance)
            best = {apart, apart > rounding * least_ ? Vec3((x - y) / apart) : Vec3(-out)};
    };
    for (const Vec3& corner : corners_) take(corner);
    for (const Ridge& ridge : ridges_) {
        const Vec3* start = nullptr;
        double apart = best.distance + ridge.spacing;
        for (const Vec3& y : ridge.points)
            if (const double way = (x - y).norm(); way < apart) apart = way, start = &y;
        if (!start) continue;
        if (const auto y = meeting(ridge.one, ridge.other, x, *start); y && isOnWall(*y)) take(*y);
    }
    return std::isfinite(best.distance) ? best : Found{largest, -out};
}

double TubeNetwork::volumeOf(const Vec3& low, double size, double distance) const {
    const double gap = largestGap(low + Vec3::Constant(0.5 * size)) + distance, whole = size * size * size;
    if (const double reach = 0.5 * std::numbers::sqrt3 * size; std::abs(gap) > reach) return gap > 0 ? whole : 0;
    if (size <= least_ / cubesInRadius) return whole * std::clamp(0.5 + gap / size, 0.0, 1.0);
    const double half = 0.5 * size;
    double sum = 0;
    for (int k = 0; k < 8; ++k) sum += volumeOf(low + half * Vec3(k & 1, (k >> 1) & 1, k >> 2), half, distance);
    return sum;
}

double TubeNetwork::volumeWithin(double distance) const {
    const Vec3 room = box_.size();
    const double around = std::max(distance, 0.0);
    const double size = room[0] / std::max(1.0, std::floor(room[0] / largest_));
    const auto count = [&](int k) { return std::ceil((room[k] + 2 * around) / size - 1e-9); };
    const Vec3 low(box_.low[0], box_.middle()[1] - 0.5 * count(1) * size, box_.middle()[2] - 0.5 * count(2) * size);
    double sum = 0;
    for (double i = 0; i < std::round(room[0] / size); ++i)
        for (double j = 0; j < count(1); ++j)
            for (double k = 0; k < count(2); ++k) sum += volumeOf(low + size * Vec3(i, j, k), size, distance);
    return sum;
}

std::vector<double> networkFlows(const std::vector<Tube>& tubes, double boxLength) {
    Joints joints(boxLength, sameJoint * leastRadius(tubes));
    std::vector<std::size_t> from, to;
    for (const Tube& tube : tubes) from.push_back(joints.at(tube.from)), to.push_back(joints.at(tube.to));
    const auto n = static_cast<Eigen::Index>(joints.places.size());
    Eigen::MatrixXd balance = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd source = Eigen::VectorXd::Zero(n);
    std::vector<double> conductance;
    for (std::size_t t = 0; t < tubes.size(); ++t) {
        conductance.push_back(pi * std::pow(tubes[t].radius(), 4) / (8 * tubes[t].length()));
        const auto a = static_cast<Eigen::Index>(from[t]), b = static_cast<Eigen::Index>(to[t]);
        const double g = conductance[t], drive = g * (tubes[t].to - tubes[t].from)[0];
        balance(a, a) += g, balance(b, b) += g, balance(a, b) -= g, balance(b, a) -= g;
        source[a] -= drive, source[b] += drive;
    }
    // Singular, since pressures are known up to a constant: the solution of least norm.
    const Eigen::VectorXd pressure = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(balance).solve(source);
    std::vector<double> flows;
    for (std::size_t t = 0; t < tubes.size(); ++t)
        flows.push_back(conductance[t] *
                        (pressure[static_cast<Eigen::Index>(from[t])] - pressure[static_cast<Eigen::Index>(to[t])] +
                         (tubes[t].to - tubes[t].from)[0]));
    return flows;
}

const Schema<NetworkWalls>& NetworkWalls::schema() {
    static const Schema<NetworkWalls> s =
        Schema<NetworkWalls>("network", "straight round tubes that join: bifurcations, loops, networks")
            .list("tubes", &NetworkWalls::tubes,
                  "the tubes; one leads on, or to others, from one end of the box to the other");
    return s;
}

void NetworkWalls::check(const particles::Box& fluid, const Mark& mark, Problems& problems) const {
    const Vec3 half = 0.5 * fluid.size();
    if (tubes.empty())
        problems.add(mark, "walls.tubes", "found no tubes; give at least one, from one end of the box to the other");
    bool isSound = !tubes.empty();
    const auto add = [&](std::size_t tube, const std::string& text) {
        problems.add(mark, fmt::format("walls.tubes[{}]", tube), text);
        isSound = false;
    };
    for (std::size_t t = 0; t < tubes.size(); ++t) {
        const Tube& tube = tubes[t];
        if (!(tube.length() > 0))
            add(t, "its two ends are at the same place; give 'from' and 'to' of a tube with a length");
        for (int k = 0; k < 3; ++k) {
            const double reach = std::max(std::abs(tube.from[k]), std::abs(tube.to[k])) + (k > 0 ? tube.radius() : 0);
            if (reach <= half[k] * (1 + 1e-9)) continue;
            add(t,
                fmt::format("reaches {} from the middle of the box along {}, but the box of system/mesh.yaml ends at "
                            "{}; make the box larger, or move the tube",
                            formatQuantity(reach, unit::metre), "xyz"[k], formatQuantity(half[k], unit::metre)));
        }
    }
    isSound = checkJoints(fluid.size()[0], mark, problems) && isSound;
    if (!isSound) return;
    const std::vector<double> flows = networkFlows(tubes, fluid.size()[0]);
    double straight = 0;  // flow through all tubes, as if each led along x
    for (const Tube& tube : tubes) straight = std::max(straight, pi * std::pow(tube.radius(), 4) / 8);
    if (flowAlong(tubes, flows, fluid.size()[0]) < 1e-9 * straight)
        problems.add(
            mark, "walls.tubes",
            fmt::format("no tubes lead from one end of the box to the other, x = {} and {}, at the same y and z; "
                        "add the tube that is missing, or give two ends that are to join the same place",
                        formatQuantity(-half[0], unit::metre), formatQuantity(half[0], unit::metre)));
}

// Ends that nearly meet: by rounding of their places, or beside the axis of a tube that has no end there.
bool NetworkWalls::checkJoints(double boxLength, const Mark& mark, Problems& problems) const {
    bool isSound = true;
    const double same = sameJoint * leastRadius(tubes), near = nearJoint * leastRadius(tubes);
    const auto apart = [&](Vec3 way) {
        way[0] -= boxLength * std::round(way[0] / boxLength);
        return way;
    };
    for (std::size_t t = 0; t < tubes.size(); ++t)
        for (const bool isFrom : {true, false})
            for (std::size_t u = 0; u < tubes.size(); ++u) {
                const Vec3 end = isFrom ? tubes[t].from : tubes[t].to, along = tubes[u].to - tubes[u].from;
                const double first = apart(end - tubes[u].from).norm(), last = apart(end - tubes[u].to).norm();
                if (t == u || std::min(first, last) <= same || !(tubes[u].length() > 0)) continue;
                bool touches = false;
                for (const int image : {-1, 0, 1}) {
                    const Vec3 way = end + Vec3(image * boxLength, 0, 0) - tubes[u].from;
                    const double share = std::clamp(way.dot(along) / along.squaredNorm(), 0.0, 1.0);
                    touches = touches || (way - share * along).norm() <= near;
                }
                if (!touches) continue;
                const bool atEnd = std::min(first, last) <= near;
                if (atEnd && u < t) continue;  // said of the other end
                isSound = false;
                problems.add(mark, fmt::format("walls.tubes[{}].{}", t, isFrom ? "from" : "to"),
                             atEnd
                                 ? fmt::format("lies {} from an end of walls.tubes[{}] and does not join it; give both "
                                               "the same place",
                                               formatQuantity(std::min(first, last), unit::metre), u)
                                 : fmt::format("lies on the axis of walls.tubes[{}], which has no end there; replace "
                                               "that tube by two that end at this place",
                                               u));
            }
    return isSound;
}

const TubeNetwork& NetworkWalls::network(const particles::Box& fluid) const {
    if (!network_ || box_.low != fluid.low || box_.high != fluid.high)
        network_ = std::make_shared<const TubeNetwork>(tubes, fluid), box_ = fluid;
    return *network_;
}

Walls NetworkWalls::place(const particles::Box& fluid) const {
    network(fluid);
    Walls walls;
    walls.add("network", network_);
    return walls;
}

double NetworkWalls::volume(const particles::Box& fluid) const { return network(fluid).volumeWithin(0); }

double NetworkWalls::volumeBehind(const particles::Box& fluid, const Vec3& depth) const {
    return network(fluid).volumeWithin(depth.maxCoeff()) - volume(fluid);
}

Hydraulics NetworkWalls::hydraulics(const particles::Box& fluid) const {
    const std::vector<double> flows = networkFlows(tubes, fluid.size()[0]);
    double fastest = 0, widest = 0;
    for (std::size_t t = 0; t < tubes.size(); ++t) {
        const double R = tubes[t].radius();
        fastest = std::max(fastest, 2 * std::abs(flows[t]) / (pi * R * R)), widest = std::max(widest, R);
    }
    return {leastRadius(tubes), fastest, std::pow(widest / slowestMode, 2), {}};
}

CORPUSCLE_REGISTER(WallShape, NetworkWalls, "network", "straight round tubes that join: bifurcations, networks");

}  // namespace corpuscle::boundary
