#include "coupling/nodeExchange.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "coupling/sphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

// Position and velocity of all nodes must be the same bits on every rank that holds the cell.
void expectSameBitsOnAllHolders(const Cell& cell) {
    for (const auto* field : {&cell.membrane.position, &cell.membrane.velocity})
        for (const Vec3& value : *field)
            for (int k = 0; k < 3; ++k) {
                std::uint64_t bits = 0;
                std::memcpy(&bits, &value[k], 8);
                std::uint64_t all = cell.held ? bits : ~0ull, any = cell.held ? bits : 0;
                MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_UINT64_T, MPI_BAND, MPI_COMM_WORLD);
                MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_UINT64_T, MPI_BOR, MPI_COMM_WORLD);
                EXPECT_EQ(all, any);
            }
}

}  // namespace

TEST(NodeExchange, aCellTravellingThroughThePeriodicBoxStaysInOnePiece) {
    SphereScene scene({24, 7, 7}, {Vec3(3, 3.5, 3.5), Vec3(15, 3, 4)});
    NodeExchange exchange;
    exchange.plan(*scene.system, scene.cells, 1 + skin);
    exchange.gather(*scene.system, scene.cells, 0);
    const Vec3 velocity(0.14, -0.03, 0.02);
    int ranks = 1, handOvers = 0, notHeld = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    for (int step = 1; step <= 200; ++step) {  // 28 spacings along x: once round the box
        ParticleStore& s = scene.system->store();
        const Vec3 travelled = step * velocity;
        scene.moveNodes([&](const Vec3& x) -> Vec3 { return x + travelled; });
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.node[i] >= 0) s.setVelocity(i, {0.1 * static_cast<double>(s.node[i]), 1.0 * step, -2});
        if (scene.system->mustRebuild()) {
            scene.system->rebuild();
            std::vector<bool> before;
            for (const Cell& cell : scene.cells) before.push_back(cell.held);
            exchange.plan(*scene.system, scene.cells, 1 + skin);
            for (std::size_t c = 0; c < scene.cells.size(); ++c) handOvers += scene.cells[c].held && !before[c];
        }
        exchange.gather(*scene.system, scene.cells, 0);

        int owned = static_cast<int>(exchange.owned().size());
        MPI_Allreduce(MPI_IN_PLACE, &owned, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
        EXPECT_EQ(owned, 2 * 162);
        for (const NodeExchange::OwnedNode& n : exchange.owned())
            EXPECT_TRUE(scene.cells[static_cast<std::size_t>(n.cell)].held);
        for (std::size_t c = 0; c < scene.cells.size(); ++c) {
            const Cell& cell = scene.cells[c];
            notHeld += !cell.held;
            if (step % 20 == 0) expectSameBitsOnAllHolders(cell);
            if (!cell.held) continue;
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
    SphereScene scene({24, 7, 7}, {Vec3(3, 3.5, 3.5)});
    membrane::MembraneSettings laws;
    laws.bonds = choice<membrane::BondLaw>("{type: harmonic, k: 2 N/m}");
    laws.rupture = choice<membrane::RuptureLaw>("{type: damage, scale: 0.1, time: 1 s}");
    membrane::Membrane& made = scene.cells[0].membrane;
    made = membrane::Membrane("sphere", 1, scene.start[0], made.network().triangles(), laws, radius);
    NodeExchange exchange;
    exchange.plan(*scene.system, scene.cells, 1);
    exchange.gather(*scene.system, scene.cells, 0);
    Cell& cell = scene.cells[0];
    std::vector<char> alive(cell.membrane.network().allBonds().size(), 1);
    alive[7] = alive[100] = 0;
    std::vector<double> damage(cell.membrane.network().triangles().size());
    for (std::size_t t = 0; t < damage.size(); ++t) damage[t] = 1.0 / static_cast<double>(t + 3);
    if (cell.held) cell.membrane.restore(alive, damage);
    for (int step = 1; step <= 100; ++step) {
        scene.moveNodes([&](const Vec3& x) -> Vec3 { return x + Vec3(0.12 * step, 0, 0); });
        if (scene.system->mustRebuild()) {
            scene.system->rebuild();
            exchange.plan(*scene.system, scene.cells, 1);
        }
        exchange.gather(*scene.system, scene.cells, 0);
        if (cell.held) {
            EXPECT_EQ(cell.membrane.network().aliveBonds(), alive);
            EXPECT_EQ(cell.membrane.damage(), damage);
        }
    }
}
