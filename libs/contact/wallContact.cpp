#include "contact/wallContact.hpp"

#include <algorithm>

#include "geometry/crossings.hpp"

namespace corpuscle::contact {
namespace {

constexpr int looksOnTheWay = 8;

geometry::Bounds boundsOf(std::span<const Vec3> x) {
    geometry::Bounds box;
    for (const Vec3& place : x) box.extend(place);
    return box;
}

}  // namespace

std::vector<AtWall> nodesAtWalls(const ContactLaw& law, const boundary::Walls& walls, const Surface& surface,
                                 std::span<const Vec3> x) {
    std::vector<AtWall> found;
    if (!walls.exist()) return found;
    const geometry::Bounds box = boundsOf(x);
    const double around = 0.5 * box.diagonal().norm();
    for (const boundary::Wall& wall : walls) {
        if (wall.distance(box.center()) > around + law.range()) continue;
        for (std::size_t n = 0; n < x.size(); ++n) {
            const double distance = wall.distance(x[n]), area = surface.nodeArea()[n];
            if (distance < law.range() && area > 0)
                found.push_back({n, wall.number, wall.normal(x[n]), distance, area, law.at(distance - law.thickness)});
        }
    }
    return found;
}

double freeOfWalls(const ContactLaw& law, const boundary::Walls& walls, std::span<const Vec3> x,
                   std::span<const Vec3> u, double share) {
    double free = 1;
    if (!walls.exist()) return free;
    const geometry::Bounds box = boundsOf(x);
    double longest = 0;
    for (const Vec3& one : u) longest = std::max(longest, one.norm());
    const double around = 0.5 * box.diagonal().norm() + longest + law.thickness;
    for (const boundary::Wall& wall : walls) {
        if (wall.distance(box.center()) > around) continue;
        for (std::size_t n = 0; n < x.size(); ++n) {
            const double kept = share * (wall.distance(x[n]) - law.thickness);
            double before = 0;
            for (int k = 1; k <= looksOnTheWay && before < free; ++k) {
                const double now = static_cast<double>(k) / looksOnTheWay;
                if (wall.distance(x[n] + now * u[n]) - law.thickness < kept) {
                    free = std::min(free, before);
                    break;
                }
                before = now;
            }
        }
    }
    return free;
}

}  // namespace corpuscle::contact
