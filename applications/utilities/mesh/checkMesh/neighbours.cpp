#include "neighbours.hpp"

#include <algorithm>

namespace corpuscle::utilities {

using particles::Kind;

Shortest shortestDistances(const Members& members, const particles::Box& box, double reach, double spacing,
                           MPI_Comm comm) {
    particles::ParticleSystem system(comm, box, {.side = true}, reach, 0.01 * reach, spacing);
    particles::ParticleStore& s = system.store();
    std::size_t total = members.fluid.size() + members.walls.size() + members.bodies.size(), next = 0;
    for (const auto& nodes : members.cells) total += nodes.size();
    s.resize(total);
    const auto add = [&](const std::vector<Vec3>& points, Kind kind, std::int64_t cell) {
        for (const Vec3& x : points) {
            s.setPosition(next, x);
            s.id[next] = static_cast<std::int64_t>(next);
            s.kind[next] = static_cast<std::int64_t>(kind);
            s.side[next++] = cell;
        }
    };
    add(members.fluid, Kind::fluid, 0);
    add(members.walls, Kind::wall, 0);
    add(members.bodies, Kind::body, 0);
    for (std::size_t c = 0; c < members.cells.size(); ++c)
        add(members.cells[c], Kind::membrane, static_cast<std::int64_t>(c) + 1);
    system.start();

    // record | x y z | -1 wall, -2 body, 0 fluid, n node of cell n
    constexpr std::size_t fields = 4;
    const auto n = static_cast<std::size_t>(system.owned());
    particles::RealArray records((n + static_cast<std::size_t>(system.ghosts())) * fields);
    for (std::size_t i = 0; i < n; ++i) {
        double* r = records.data() + fields * i;
        r[0] = s.x[i], r[1] = s.y[i], r[2] = s.z[i];
        r[3] = s.kindOf(i) == Kind::wall ? -1 : s.kindOf(i) == Kind::body ? -2 : static_cast<double>(s.side[i]);
    }
    Shortest shortest{reach, reach, reach, reach, reach};
    const auto lanes = static_cast<std::size_t>(system.list().lanes());
    const auto meet = [&](std::size_t i, std::size_t j) {
        const double *a = records.data() + fields * i, *b = records.data() + fields * j;
        const auto [low, high] = std::minmax(a[3], b[3]);
        if ((low < 0 && high != 0) || (low > 0 && low == high)) return;
        double& least = low < -1   ? shortest.fluidBody
                        : low < 0  ? shortest.fluidWall
                        : low > 0  ? shortest.cellCell
                        : high > 0 ? shortest.fluidNode
                                   : shortest.fluidFluid;
        least = std::min(least, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    };
    system.forEachPair(records.data(), fields, 1, [&](particles::PairList::Group group) {
        const particles::PairView list = system.list().view();
        for (const int block : system.list().blocks(group)) {
            const std::size_t from = static_cast<std::size_t>(block) * lanes, end = std::min(from + lanes, n);
            for (std::size_t i = from; i < end; ++i) {
                for (std::size_t j = i + 1; j < end; ++j) meet(i, j);
                for (int k = list.begin(block); k < list.end(block); ++k) meet(i, static_cast<std::size_t>(list.j[k]));
            }
        }
    });
    return shortest;
}

}  // namespace corpuscle::utilities
