#include "coupling/nodeExchange.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "coupling/sphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

// Position and velocity of all nodes must be the same bits on every rank that holds the cell.
void expectSameBitsOnAllHolders(const Cell* cell, std::size_t nodes) {
    std::vector<std::uint64_t> all(6 * nodes, ~0ull), any(6 * nodes, 0);
    for (std::size_t n = 0; cell && n < nodes; ++n)
        for (std::size_t k = 0; k < 6; ++k) {
            const auto& field = k < 3 ? cell->membrane.position : cell->membrane.velocity;
            std::uint64_t bits = 0;
            std::memcpy(&bits, &field[n][static_cast<int>(k % 3)], 8);
            all[6 * n + k] = any[6 * n + k] = bits;
        }
    const int count = static_cast<int>(all.size());
    MPI_Allreduce(MPI_IN_PLACE, all.data(), count, MPI_UINT64_T, MPI_BAND, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, any.data(), count, MPI_UINT64_T, MPI_BOR, MPI_COMM_WORLD);
    EXPECT_EQ(all, any);
}

}  // namespace

TEST(NodeExchange, aCellTravellingThroughThePeriodicBoxStaysInOnePiece) {
    SphereScene scene({24, 7, 7}, {Vec3(3, 3.5, 3.5), Vec3(15, 3, 4)}, false, 1 + skin);
    NodeExchange exchange;
    exchange.plan(*scene.system, scene.cells);
    exchange.gather(*scene.system, scene.cells, 0);
    const Vec3 velocity(0.14, -0.03, 0.02);
    int ranks = 1, handOvers = 0, notHeld = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    for (int step = 1; step <= 200; ++step) {  // 28 spacings along x: once through the box
        ParticleStore& s = scene.system->store();
        const Vec3 travelled = step * velocity;
        scene.moveNodes([&](const Vec3& x) -> Vec3 { return x + travelled; });
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.node[i] >= 0) s.setVelocity(i, {0.1 * static_cast<double>(s.node[i]), 1.0 * step, -2});
        if (scene.system->mustRebuild()) {
            scene.system->rebuild();
            std::vector<bool> before{scene.cells.find(1) != nullptr, scene.cells.find(2) != nullptr};
            exchange.plan(*scene.system, scene.cells);
            for (int c = 0; c < 2; ++c) handOvers += scene.cells.find(c + 1) && !before[static_cast<std::size_t>(c)];
        }
        exchange.gather(*scene.system, scene.cells, 0);

        int owned = static_cast<int>(exchange.owned().size());
        MPI_Allreduce(MPI_IN_PLACE, &owned, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
        EXPECT_EQ(owned, 2 * 162);
        for (const NodeExchange::OwnedNode& n : exchange.owned())
            EXPECT_LT(static_cast<std::size_t>(n.cell), scene.cells.heldCount());
        for (std::size_t c = 0; c < 2; ++c) {
            const Cell* const held = scene.cells.find(static_cast<int>(c) + 1);
            notHeld += !held;
            if (step % 20 == 0) expectSameBitsOnAllHolders(held, scene.start[c].size());
            if (!held) continue;
            const Cell& cell = *held;
            for (std::size_t n = 0; n < scene.start[c].size(); ++n) {
                EXPECT_LT((cell.membrane.position[n] - scene.start[c][n] - travelled).norm(), 1e-11)
                    << "unwrapped, continuous";
                EXPECT_EQ(cell.membrane.velocity[n],
                          Vec3(0.1 * (static_cast<double>(n) + cell.firstNode), 1.0 * step, -2));
            }
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &handOvers, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &notHeld, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    if (ranks == 4) {
        EXPECT_GT(handOvers, 2) << "cells came to ranks that had not held them";
    }
    if (ranks == 4) {
        EXPECT_GT(notHeld, 100);
    }
}

TEST(NodeExchange, newHoldersLearnWhichBondsAreBrokenAndWhatIsDamaged) {
    SphereScene scene({24, 7, 7}, {Vec3(3, 3.5, 3.5)}, false, 1, [](membrane::MembraneSettings& laws) {
        laws.rupture = choice<membrane::RuptureLaw>("{type: damage, scale: 0.1, time: 1 s}");
    });
    NodeExchange exchange;
    exchange.plan(*scene.system, scene.cells);
    exchange.gather(*scene.system, scene.cells, 0);
    const membrane::Network& network = scene.cells.types()[0].membrane->network();
    std::vector<char> alive(network.allBonds().size(), 1);
    alive[7] = alive[100] = 0;
    std::vector<double> damage(network.triangles().size());
    for (std::size_t t = 0; t < damage.size(); ++t) damage[t] = 1.0 / static_cast<double>(t + 3);
    if (Cell* const cell = scene.cells.find(1)) cell->membrane.restore(alive, damage);
    for (int step = 1; step <= 100; ++step) {
        scene.moveNodes([&](const Vec3& x) -> Vec3 { return x + Vec3(0.12 * step, 0, 0); });
        if (scene.system->mustRebuild()) {
            scene.system->rebuild();
            exchange.plan(*scene.system, scene.cells);
        }
        exchange.gather(*scene.system, scene.cells, 0);
        if (const Cell* const cell = scene.cells.find(1)) {
            EXPECT_EQ(cell->membrane.network().aliveBonds(), alive);
            EXPECT_EQ(cell->membrane.damage(), damage);
            EXPECT_TRUE(network.rims().empty()) << "what other cells of the type share";
        }
    }
}
