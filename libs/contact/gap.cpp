#include "contact/gap.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/triangleTree.hpp"

namespace corpuscle::contact {
namespace {

Gap gapOf(const Vec3& vector, const std::array<double, 4>& weights) {
    const double distance = vector.norm();
    return {distance, distance > 0 ? Vec3(vector / distance) : Vec3::Zero(), weights};
}

// Keeps the nearer of the two; at equal distance, `least`.
void takeNearer(Gap& least, const Gap& other) {
    if (other.distance < least.distance) least = other;
}

// Gap of a node and a triangle without area: that of the nearest side.
Gap nodeToSides(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
    Gap least = nodeToEdge(x, a, b);
    const Gap second = nodeToEdge(x, b, c), third = nodeToEdge(x, c, a);
    takeNearer(least, {second.distance, second.normal, {1, 0, second.weights[1], second.weights[2]}});
    takeNearer(least, {third.distance, third.normal, {1, third.weights[2], 0, third.weights[1]}});
    return least;
}

// The least gap between an end of either edge and the other edge.
Gap endsToEdges(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Gap atC = nodeToEdge(c, a, b), atD = nodeToEdge(d, a, b);
    Gap least{atC.distance, atC.normal, {atC.weights[1], atC.weights[2], 1, 0}};
    takeNearer(least, {atD.distance, atD.normal, {atD.weights[1], atD.weights[2], 0, 1}});
    const Gap atA = nodeToEdge(a, c, d), atB = nodeToEdge(b, c, d);
    takeNearer(least, {atA.distance, -atA.normal, {-1, 0, -atA.weights[1], -atA.weights[2]}});
    takeNearer(least, {atB.distance, -atB.normal, {0, -1, -atB.weights[1], -atB.weights[2]}});
    return least;
}

// The nearest points of two lines, and the scalar products from which they are computed.
//     u = b - a, v = d - c, r = c - a;   s = (p cc - b q)/D,  t = (p b - aa q)/D,  D = aa cc - b^2 = |u x v|^2
// or, with less rounding where the lines are nearly parallel, s = (r x v).(u x v)/D and t = (r x u).(u x v)/D.
struct TwoLines {
    Vec3 u, v, r, cross;
    double aa, b, cc, p, q, D;
    double s = 0, t = 0;

    TwoLines(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3)
        : u(x1 - x0),
          v(x3 - x2),
          r(x2 - x0),
          cross(u.cross(v)),
          aa(u.squaredNorm()),
          b(u.dot(v)),
          cc(v.squaredNorm()),
          p(u.dot(r)),
          q(v.dot(r)),
          D(cross.squaredNorm()) {}

    double sine2() const { return D / (aa * cc); }
    // Computes s and t; false if the lines are parallel.
    bool findNearest(double leastSine2) {
        if (!(D > leastSine2 * aa * cc)) return false;
        s = r.cross(v).dot(cross) / D;
        t = r.cross(u).dot(cross) / D;
        return true;
    }
    bool isInside() const { return s > 0 && s < 1 && t > 0 && t < 1; }
    std::array<double, 4> weights() const { return {s - 1, -s, 1 - t, t}; }
};

struct Smooth {
    double value, slope;
};

Smooth parallelFactor(double sine2) {
    const double z = sine2 / parallelRange;
    return z < 1 ? Smooth{z * (2 - z), 2 * (1 - z) / parallelRange} : Smooth{1, 0};
}

Smooth endFactor(double s) {
    const double z = std::min(s, 1 - s) / endRange;
    if (z >= 1) return {1, 0};
    const double slope = 6 * z * (1 - z) / endRange;
    return {z * z * (3 - 2 * z), s < 0.5 ? slope : -slope};
}

}  // namespace

Gap nodeToNode(const Vec3& x, const Vec3& a) { return gapOf(x - a, {1, -1, 0, 0}); }

Gap nodeToEdge(const Vec3& x, const Vec3& a, const Vec3& b) {
    const Vec3 u = b - a, r = x - a;
    const double length2 = u.squaredNorm();
    const double t = length2 > 0 ? std::clamp(u.dot(r) / length2, 0.0, 1.0) : 0;
    return gapOf(t < 1 ? Vec3(r - t * u) : Vec3(x - b), {1, t - 1, -t, 0});
}

Gap nodeToTriangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a, v = c - a;
    const double longest2 = std::max({u.squaredNorm(), v.squaredNorm(), (c - b).squaredNorm()});
    if (!(u.cross(v).squaredNorm() > 1e-24 * longest2 * longest2)) return nodeToSides(x, a, b, c);
    const Vec3 w = geometry::nearestWeights(x, a, b, c);
    return gapOf((x - a) - w[1] * u - w[2] * v, {1, -w[0], -w[1], -w[2]});
}

Gap edgeToEdge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    TwoLines lines(a, b, c, d);
    const bool known = lines.findNearest(1e-20);
    if (!known || !lines.isInside()) return endsToEdges(a, b, c, d);
    if (lines.sine2() > 1e-4) {
        const double height = lines.r.dot(lines.cross) / std::sqrt(lines.D);
        const Vec3 normal = lines.cross / (height < 0 ? -std::sqrt(lines.D) : std::sqrt(lines.D));
        return {std::abs(height), normal, lines.weights()};
    }
    // Nearly parallel: s has a rounding error, t is computed to match it, and an end may be as near.
    lines.t = std::clamp((lines.s * lines.b - lines.q) / lines.cc, 0.0, 1.0);
    Gap least = gapOf(lines.r + lines.t * lines.v - lines.s * lines.u, lines.weights());
    takeNearer(least, endsToEdges(a, b, c, d));
    return least;
}

CrossingFactor crossingFactor(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    TwoLines l(a, b, c, d);
    if (!l.findNearest(1e-12) || !l.isInside()) return {};
    const double sine2 = l.sine2();
    const Smooth P = parallelFactor(sine2), S = endFactor(l.s), T = endFactor(l.t);
    const double byS = P.value * S.slope * T.value / l.D, byT = P.value * S.value * T.slope / l.D;
    const double bySine2 = P.slope * S.value * T.value;
    // Derivatives by the scalar products: of s = Ns/D and t = Nt/D, and of D itself.
    const double byD = -byS * l.s - byT * l.t;
    const double byAa = -byT * l.q + byD * l.cc + bySine2 * (1 - sine2) / l.aa;
    const double byB = -byS * l.q + byT * l.p - 2 * byD * l.b - 2 * bySine2 * l.b / (l.aa * l.cc);
    const double byCc = byS * l.p + byD * l.aa + bySine2 * (1 - sine2) / l.cc;
    const double byP = byS * l.cc + byT * l.b, byQ = -byS * l.b - byT * l.aa;
    const Vec3 byU = 2 * byAa * l.u + byB * l.v + byP * l.r;
    const Vec3 byV = 2 * byCc * l.v + byB * l.u + byQ * l.r;
    const Vec3 byR = byP * l.u + byQ * l.v;
    return {P.value * S.value * T.value, {-byU - byR, byU, byR - byV, byV}};
}

}  // namespace corpuscle::contact
