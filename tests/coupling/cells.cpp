// Which ranks hold which cell, against all pairs of cells and bricks, while cells travel; and the state of a cell that
// new holders receive.
#include "coupling/cells.hpp"

#include <gtest/gtest.h>

#include <random>

#include "coupling/holderSums.hpp"
#include "coupling/sphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

constexpr double margin = 1.3;

// Seven small spheres of two types in a box that is periodic along all axes.
struct Population {
    Index3 size{24, 14, 12};
    std::unique_ptr<ParticleSystem> system;
    Cells cells;

    Population() {
        const Box box = sph::testing::cube(size);
        system = std::make_unique<ParticleSystem>(MPI_COMM_WORLD, box, ParticleStore::Optional{}, 2.3, skin, 1.0);
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        ParticleStore& s = system->store();
        if (rank == 0)
            for (const sph::testing::Particle& p : sph::testing::lattice(size, 0.1)) {
                const std::size_t i = s.size();
                s.resize(i + 1);
                s.setPosition(i, p.x);
                s.density[i] = 1, s.id[i] = static_cast<std::int64_t>(i);
            }
        system->start();
        membrane::MembraneSettings laws;
        laws.bonds = choice<membrane::BondLaw>("{type: harmonic, k: 2 N/m}");
        laws.rupture = choice<membrane::RuptureLaw>("{type: damage, scale: 0.1, time: 1 s}");
        CellType small = type("small", 1.0, laws), large = type("large", 1.4, laws);
        small.places = {{.centre = {2, 2, 2}}, {.centre = {9, 5, 11.8}}, {.centre = {16, 7, 6}, .axis = {1, 0, 0}}};
        large.places = {{.centre = {5, 10, 6}},
                        {.centre = {12, 2, 5}},
                        {.centre = {20, 11, 2}, .scale = 1.2},
                        {.centre = {23.5, 5, 9}, .axis = {0, 1, 1}, .scale = 0.8}};
        cells = Cells({small, large}, margin);
        cells.placeAtStart(*system);
    }
    static CellType type(const char* name, double radius, const membrane::MembraneSettings& laws) {
        auto mesh = membrane::testing::icosphere(1);
        for (Vec3& x : mesh.nodes) x = radius * x.cwiseProduct(Vec3(1, 1, 0.6));
        return {.name = name,
                .laws = name,
                .nodes = mesh.nodes,
                .triangles = mesh.triangles,
                .settings = laws,
                .radius = radius};
    }
    int rank() const { return system->decomposition().rank(); }
    int ranks() const { return system->decomposition().size(); }

    // Whether a node of the cell, or an image of it, lies within `away` of the brick of rank r.
    bool isNear(const Cell& cell, int r, double away) const {
        const particles::Brick& brick = system->decomposition().brick(r);
        for (const Vec3& x : cell.membrane.position) {
            bool near = false;
            system->periodicity().forImagesWithin(x, brick.low - Vec3::Constant(away),
                                                  brick.high + Vec3::Constant(away), [&](const Vec3&) { near = true; });
            if (near) return true;
        }
        return false;
    }
    // The owner of each cell, its rank counted from 1; the same on every rank.
    std::vector<double> owners() const {
        std::vector<double> all(cells.count(), 0.0);
        for (const Cell& cell : cells)
            if (cell.isOwnedBy(rank())) all[static_cast<std::size_t>(cell.membrane.cell) - 1] += 1 + rank();
        MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        return all;
    }
};

// Stands for the state of a cell: depends only on the cell's number, the node and the step.
Vec3 velocityOf(int cell, std::size_t node, int step) {
    return {0.01 * cell, 1.0 / static_cast<double>(node + 1), 0.1 * step};
}

}  // namespace

TEST(Cells, numbersGoThroughTypesAndPlaces) {
    const Population p;
    EXPECT_EQ(p.cells.count(), 7u);
    EXPECT_EQ(p.cells.typeOf(3), 0u);
    EXPECT_EQ(p.cells.typeOf(4), 1u);
    EXPECT_EQ(p.cells.nameOf(4), "large 4");
    const auto nodes = static_cast<int>(p.cells.types()[0].nodes.size());
    EXPECT_EQ(p.cells.cellOfNode(0), std::pair(1, 0));
    EXPECT_EQ(p.cells.cellOfNode(3 * nodes + 5), std::pair(4, 5));
    EXPECT_EQ(p.cells.cellOfNode(7 * nodes - 1), std::pair(7, nodes - 1));
}

TEST(Cells, standWhereTheirPlacesSay) {
    const Population p;
    const Cell turned = p.cells.make(7);
    const Vec3 axis = Vec3(0, 1, 1).normalized(), centre(23.5, 5, 9);
    double along = 0, across = 0;
    for (const Vec3& x : turned.membrane.position) {
        const Vec3 arm = x - centre;
        along = std::max(along, std::abs(arm.dot(axis)));
        across = std::max(across, (arm - arm.dot(axis) * axis).norm());
    }
    EXPECT_NEAR(along, 0.8 * 1.4 * 0.6, 1e-12);
    EXPECT_NEAR(across, 0.8 * 1.4, 1e-12);
    EXPECT_NEAR(turned.radius, 0.8 * 1.4, 1e-14);
    EXPECT_NEAR(turned.initialVolume / p.cells.make(4).initialVolume, 0.512, 1e-12);
    EXPECT_NEAR(turned.membrane.energy(), 0, 1e-20) << "a smaller cell is at rest at its own size";
}

TEST(Cells, holdersAreThoseNearAndOneOfThemOwns) {
    Population p;
    int notHeld = 0, handedOver = 0;
    for (int step = 0; step < 60; ++step) {
        std::vector<char> before(p.cells.count() + 1, 0);
        for (Cell& cell : p.cells) {
            before[static_cast<std::size_t>(cell.membrane.cell)] = 1;
            const Vec3 way(0.45, 0.2 - 0.05 * cell.membrane.cell, 0.1);  // in 60 steps more than once through the box
            cell.arc = {.centre = velocityOf(cell.membrane.cell, 7, step), .turn = way};
            for (std::size_t n = 0; n < cell.membrane.position.size(); ++n) {
                cell.membrane.position[n] += way;
                cell.membrane.velocity[n] = velocityOf(cell.membrane.cell, n, step);
            }
        }
        p.cells.settle(*p.system);
        for (const double owner : p.owners()) {
            EXPECT_GE(owner, 1);
            EXPECT_LE(owner, p.ranks()) << "one owner each";
        }
        notHeld += static_cast<int>(p.cells.count() - p.cells.heldCount());
        for (std::size_t k = 0; k < p.cells.heldCount(); ++k) {
            const Cell& cell = p.cells[k];
            EXPECT_EQ(p.cells.indexOf(cell.membrane.cell), k);
            EXPECT_TRUE(std::is_sorted(cell.holders.begin(), cell.holders.end()));
            for (int r = 0; r < p.ranks(); ++r) {
                const bool holds = std::binary_search(cell.holders.begin(), cell.holders.end(), r);
                if (p.isNear(cell, r, margin)) {
                    EXPECT_TRUE(holds);
                }
                if (holds) {
                    EXPECT_TRUE(p.isNear(cell, r, margin + 3)) << "bounds reach further than nodes, but not that far";
                }
            }
            handedOver += !before[static_cast<std::size_t>(cell.membrane.cell)];
            for (std::size_t n = 0; n < cell.membrane.velocity.size(); ++n)
                EXPECT_EQ(cell.membrane.velocity[n], velocityOf(cell.membrane.cell, n, step));
            EXPECT_EQ(cell.arc.centre, velocityOf(cell.membrane.cell, 7, step))
                << "it may be handed over within a step";
            EXPECT_EQ(cell.arc.turn, Vec3(0.45, 0.2 - 0.05 * cell.membrane.cell, 0.1));
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &notHeld, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &handedOver, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    if (p.ranks() == 1) {
        EXPECT_EQ(notHeld + handedOver, 0);
    }
    if (p.ranks() == 4) {
        EXPECT_GT(notHeld, 500);
        EXPECT_GT(handedOver, 20);
    }
}

// A torn cell has a network of its own, and arrives torn at new holders; the others of its type stay whole.
TEST(Cells, aTornCellIsTheOnlyOne) {
    Population p;
    const membrane::Network& whole = p.cells.types()[0].membrane->network();
    std::vector<char> alive(whole.allBonds().size(), 1);
    alive[4] = 0;
    std::vector<double> damage(whole.triangles().size());
    for (std::size_t t = 0; t < damage.size(); ++t) damage[t] = 1.0 / static_cast<double>(t + 2);
    if (Cell* cell = p.cells.find(2)) cell->membrane.restore(alive, damage);
    for (int step = 0; step < 30; ++step) {
        for (Cell& cell : p.cells)
            for (Vec3& x : cell.membrane.position) x += Vec3(0.8, 0, 0.1);
        p.cells.settle(*p.system);
        for (const Cell& cell : p.cells) {
            const bool isTorn = cell.membrane.cell == 2;
            EXPECT_EQ(cell.membrane.network().isOpen(), isTorn);
            if (!isTorn) continue;
            EXPECT_EQ(cell.membrane.network().aliveBonds(), alive);
            EXPECT_EQ(cell.membrane.damage(), damage);
        }
        EXPECT_FALSE(whole.isOpen());
    }
}

// Summands of very different size: every holder gets the same bits, those of the sum in the order of the ranks.
TEST(HolderSums, areThoseInTheOrderOfTheRanks) {
    Population p;
    constexpr std::size_t width = 3;
    const auto part = [&](int cell, int row, std::size_t k, int rank) {
        return std::sin(1.7 * cell + 0.3 * row + static_cast<double>(k)) * std::pow(10.0, rank - cell);
    };
    const auto has = [](int cell, int row, int rank) { return (cell + row + rank) % 3 != 0; };
    std::vector<char> mine;
    std::vector<double> values;
    for (const Cell& cell : p.cells)
        for (int row = 0; row < cell.nodeCount(); ++row) {
            mine.push_back(has(cell.membrane.cell, row, p.rank()));
            for (std::size_t k = 0; k < width; ++k)
                values.push_back(mine.back() ? part(cell.membrane.cell, row, k, p.rank()) : 0);
        }
    HolderSums sums;
    sums.plan(
        p.cells, MPI_COMM_WORLD, [](const Cell& cell) { return cell.nodeCount(); }, mine);
    sums.addUp(values, width);
    std::size_t at = 0, shared = 0;
    for (const Cell& cell : p.cells)
        for (int row = 0; row < cell.nodeCount(); ++row)
            for (std::size_t k = 0; k < width; ++k, ++at) {
                double expected = 0;
                for (const int r : cell.holders)
                    if (has(cell.membrane.cell, row, r)) expected += part(cell.membrane.cell, row, k, r);
                EXPECT_EQ(values[at], expected);
                shared += cell.holders.size() > 1;
            }
    EXPECT_EQ(at, values.size());
    EXPECT_EQ(sph::testing::sumOverRanks(static_cast<double>(shared)) > 0, p.ranks() > 1);
}
