#include "contact/travel.hpp"

#include <algorithm>
#include <limits>

#include "contact/gap.hpp"

namespace corpuscle::contact {
namespace {

constexpr int mostTerms = 200;
constexpr double rounding = 1e-9;  // fraction of each term left out, for rounding errors

struct NodeTriangle {
    static constexpr std::array<std::size_t, 1> front{0};  // nodes of the piece that the normal of the gap points to
    static constexpr std::array<std::size_t, 3> back{1, 2, 3};
    static Gap gap(const FourNodes& x) { return nodeToTriangle(x[0], x[1], x[2], x[3]); }
};

struct EdgeEdge {
    static constexpr std::array<std::size_t, 2> front{2, 3}, back{0, 1};
    static Gap gap(const FourNodes& x) { return edgeToEdge(x[0], x[1], x[2], x[3]); }
};

template <std::size_t n>
double largest(const FourNodes& u, const std::array<std::size_t, n>& nodes) {
    double most = 0;
    for (const std::size_t k : nodes) most = std::max(most, u[k].norm());
    return most;
}

// Fraction of u until a node of one piece and a node of the other are nearer than `least` along the normal n.
template <class Pieces>
double alongNormal(const FourNodes& x, const FourNodes& u, const Vec3& n, double least) {
    double free = std::numeric_limits<double>::infinity();
    for (const std::size_t i : Pieces::front)
        for (const std::size_t j : Pieces::back) {
            const double rate = n.dot(u[j] - u[i]), room = n.dot(x[i] - x[j]) - least;
            if (rate > 0) free = std::min(free, room / rate);
            if (!(room >= 0)) return 0;
        }
    return free;
}

template <class Pieces>
double travel(const FourNodes& x, FourNodes u, const Keep& keep, double most) {
    const Vec3 mean = (u[0] + u[1] + u[2] + u[3]) / 4;
    for (Vec3& one : u) one -= mean;
    const double speed = largest(u, Pieces::front) + largest(u, Pieces::back);
    Gap gap = Pieces::gap(x);
    const double thickness = gap.distance > keep.thickness ? keep.thickness : 0;
    const double kept = keep.share * (gap.distance - thickness), least = thickness + kept;
    if (most * speed <= gap.distance - least) return most;
    double fraction = 0;
    FourNodes now = x;
    for (int n = 0; n < mostTerms && gap.distance - least > 0.05 * kept; ++n) {
        const double term = std::max((gap.distance - least) / speed, alongNormal<Pieces>(now, u, gap.normal, least));
        fraction += (1 - rounding) * term;
        if (fraction >= most) return most;
        for (std::size_t k = 0; k < 4; ++k) now[k] = x[k] + fraction * u[k];
        gap = Pieces::gap(now);
    }
    return fraction;
}

}  // namespace

double nodeTriangleTravel(const FourNodes& x, const FourNodes& u, const Keep& keep, double most) {
    return travel<NodeTriangle>(x, u, keep, most);
}
double edgeEdgeTravel(const FourNodes& x, const FourNodes& u, const Keep& keep, double most) {
    return travel<EdgeEdge>(x, u, keep, most);
}

}  // namespace corpuscle::contact
