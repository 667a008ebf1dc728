// The neighbour list against a brute-force search over all particles and their periodic images, on any number of ranks.
#include "particles/pairList.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "particles/isa.hpp"
#include "particles/population.hpp"

using namespace corpuscle;
using namespace corpuscle::particles;
using namespace corpuscle::particles::testing;

namespace {

constexpr double skin = 0.3;
using Image = std::array<int, 4>;  // id and image along x, y, z

class Pairs : public ::testing::TestWithParam<PopulatedBox> {};

Image imageOfRecord(const Population& p, const double* record) {
    const int id = static_cast<int>(record[3]);
    Image image{id, 0, 0, 0};
    for (int k = 0; k < 3; ++k) {
        const double lengths = (record[k] - p.position[id][k]) / p.box.size()[k];
        image[static_cast<std::size_t>(k) + 1] = static_cast<int>(std::lround(lengths));
        EXPECT_NEAR(lengths, std::round(lengths), 1e-12) << "a record lies at an image of its particle";
    }
    return image;
}

void expectComplete(ParticleSystem& system, const Population& p) {
    const RealArray records = taggedRecords(system);
    const PairList& list = system.list();
    const PairView view = list.view();
    const int lanes = list.lanes();
    const double support = system.support();
    const auto isWall = [&](int j) {
        return records[static_cast<std::size_t>(j) * tagFields + 4] == static_cast<double>(Kind::wall);
    };

    // The particles with which each block has pairs, by its own list and by the lists of earlier blocks.
    const std::vector<int> imageOf = system.halo().imageOf();
    std::vector<std::set<Image>> met(static_cast<std::size_t>(list.blockCount()));
    const auto image = [&](int j) {
        return imageOfRecord(p, records.data() + static_cast<std::size_t>(j) * tagFields);
    };
    for (int b = 0; b < list.blockCount(); ++b) {
        for (int i = b * lanes; i < std::min(view.owned, (b + 1) * lanes); ++i) met[b].insert(image(i));
        for (int k = view.begin(b); k < view.end(b); ++k) {
            const int j = view.j[k];
            EXPECT_TRUE(met[b].insert(image(j)).second) << "listed twice";
            const bool mutual = k < view.alone(b);
            const int own = j < view.owned ? j : imageOf[static_cast<std::size_t>(j - view.owned)];
            EXPECT_EQ(mutual, own < 0 || own / lanes != b);
            if (!mutual || own < 0) continue;
            EXPECT_GT(own / lanes, b);
            // Seen from the other particle, this block lies on the opposite side of the periodic faces between the two.
            const Image there = image(j), at = image(own);
            for (int i = b * lanes; i < std::min(view.owned, (b + 1) * lanes); ++i) {
                const Image here = image(i);
                met[static_cast<std::size_t>(own / lanes)].insert(
                    {here[0], here[1] - there[1] + at[1], here[2] - there[2] + at[2], here[3] - there[3] + at[3]});
            }
        }
    }

    std::vector<int> seen(static_cast<std::size_t>(list.blockCount()), 0);
    for (const auto group :
         {PairList::interior, PairList::interiorAtWall, PairList::boundary, PairList::boundaryAtWall})
        for (const int b : list.blocks(group)) {
            ++seen[static_cast<std::size_t>(b)];
            const std::set<Image>& listed = met[b];
            const int last = std::min(view.owned, (b + 1) * lanes);
            bool meetsWall = false, meetsGhost = false, allWall = true;
            for (int i = b * lanes; i < last; ++i) meetsWall |= isWall(i), allWall &= isWall(i);
            for (int k = view.begin(b); k < view.end(b); ++k) {
                const int j = view.j[k];
                meetsWall |= isWall(j), meetsGhost |= j >= view.owned;
                EXPECT_FALSE(allWall && isWall(j));
            }
            EXPECT_EQ(meetsWall, group == PairList::interiorAtWall || group == PairList::boundaryAtWall);
            EXPECT_EQ(meetsGhost, group == PairList::boundary || group == PairList::boundaryAtWall);

            int images[3];
            for (int k = 0; k < 3; ++k)
                images[k] = p.box.periodic[k] ? static_cast<int>(std::ceil(support / p.box.size()[k])) : 0;
            for (int i = b * lanes; i < last; ++i) {
                const Vec3 at(records.data() + static_cast<std::size_t>(i) * tagFields);
                for (int id = 0; id < p.count(); ++id) {
                    if (isWall(i) && p.wall[id]) continue;  // walls do not act on walls
                    for (int x = -images[0]; x <= images[0]; ++x)
                        for (int y = -images[1]; y <= images[1]; ++y)
                            for (int z = -images[2]; z <= images[2]; ++z) {
                                const Vec3 other = p.position[id] + Vec3(x, y, z).cwiseProduct(p.box.size());
                                if ((at - other).norm() < support) {
                                    EXPECT_TRUE(listed.contains({id, x, y, z}));
                                }
                            }
                }
            }
        }
    for (const int times : seen) EXPECT_EQ(times, 1) << "every block is in one group";
}

}  // namespace

TEST_P(Pairs, everyPairWithinTheSupportIsListedOnce) {
    const PopulatedBox& c = GetParam();
    const Population p(c.box, c.count, 3, c.layer);
    for (const Precision precision :
         {Precision::full, Precision::mixed}) {  // the size of a block differs between them on some processors
        ParticleSystem system(MPI_COMM_WORLD, c.box, {}, c.support, skin, 1, precision);
        EXPECT_EQ(system.list().lanes(), blockLanes(precision));
        p.deal(system.store());
        system.start();
        expectComplete(system, p);
    }
}

TEST_P(Pairs, theListHoldsWhileNothingHasMovedMoreThanHalfTheSkin) {
    const PopulatedBox& c = GetParam();
    Population p(c.box, c.count, 4, c.layer);
    ParticleSystem system(MPI_COMM_WORLD, c.box, {}, c.support, skin, 1);
    p.deal(system.store());
    system.start();
    for (int step = 0; step < 6; ++step) {
        for (int id = 0; id < p.count(); ++id) {
            const Vec3 direction(std::sin(id + step), std::cos(2.0 * id), std::sin(3.0 * id + 1));
            // Two such steps are less than half of the skin.
            if (!p.wall[id]) p.position[id] += 0.074 * direction.normalized();
            for (int k = 0; k < 3; ++k)
                if (!c.box.periodic[k]) p.position[id][k] = std::clamp(p.position[id][k], c.box.low[k], c.box.high[k]);
        }
        ParticleStore& s = system.store();
        // Paths are continuous between rebuilds: the image nearest to the present position is used.
        for (std::size_t i = 0; i < s.size(); ++i)
            s.setPosition(i, s.position(i) + c.box.periodicity().shortest(p.position[s.id[i]] - s.position(i)));
        if (system.mustRebuild()) system.rebuild();
        expectComplete(system, p);
    }
    EXPECT_GT(system.rebuilds(), 1);
    EXPECT_LT(system.rebuilds(), 6);
}

INSTANTIATE_TEST_SUITE_P(Boxes, Pairs, ::testing::ValuesIn(populatedBoxes),
                         [](const auto& instance) { return instance.param.name; });

TEST(ParticleSystem, aParticleWithoutFinitePositionAsksForRebuild) {
    const Population p(box({8, 7, 6}), 336, 3);
    ParticleSystem system(MPI_COMM_WORLD, p.box, {}, 2, skin, 1);
    p.deal(system.store());
    system.start();
    EXPECT_FALSE(system.mustRebuild());
    if (system.owned() > 0 && system.decomposition().rank() == system.decomposition().size() - 1)
        system.store().y[0] = NAN;
    EXPECT_TRUE(system.mustRebuild());
}

TEST(ParticleSystem, resumeGivesTheSameListsAndOrder) {
    const Population p(box({8, 7, 9}, true, true, false), 500, 8, 2);
    ParticleSystem first(MPI_COMM_WORLD, p.box, {}, 2, skin, 1);
    p.deal(first.store());
    first.start();
    for (int step = 0; step < 7; ++step) {
        ParticleStore& s = first.store();
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.kindOf(i) == Kind::fluid) s.x[i] += 0.1, s.y[i] += 0.05 * std::sin(static_cast<double>(s.id[i]));
        if (first.mustRebuild()) first.rebuild();
    }
    EXPECT_GT(first.largestDisplacement2(), 0) << "the saved state lies between two builds";

    ParticleSystem second(MPI_COMM_WORLD, p.box, {}, 2, skin, 1);
    second.store() = first.store();
    second.resume(first.decomposition().state(), first.rebuilds());
    EXPECT_EQ(second.rebuilds(), first.rebuilds());
    EXPECT_EQ(second.store().id, first.store().id);
    EXPECT_EQ(second.store().x, first.store().x);
    EXPECT_EQ(second.store().yBuilt, first.store().yBuilt);
    ASSERT_EQ(second.ghosts(), first.ghosts());
    ASSERT_EQ(second.list().entries(), first.list().entries());
    for (std::size_t k = 0; k < first.list().entries(); ++k)
        EXPECT_EQ(second.list().view().j[k], first.list().view().j[k]);
    EXPECT_EQ(taggedRecords(second), taggedRecords(first));
    for (int g = 0; g < PairList::groups; ++g)
        EXPECT_EQ(second.list().blocks(static_cast<PairList::Group>(g)),
                  first.list().blocks(static_cast<PairList::Group>(g)));
}
