// Particles that several ranks know, compared with what all ranks hold of them, on any number of ranks.
#include "particles/sharedParticles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "particles/population.hpp"

using namespace corpuscle;
using namespace corpuscle::particles;
using namespace corpuscle::particles::testing;

namespace {

class Shared : public ::testing::TestWithParam<PopulatedBox> {
  protected:
    const PopulatedBox& c = GetParam();
    Population p{c.box, c.count, 5, c.layer};
    ParticleSystem system{MPI_COMM_WORLD, c.box, {}, c.support, 0.3, 1};
    SharedParticles shared;
    std::vector<int> id;  // of each entry, as sent by the owner

    void SetUp() override {
        p.deal(system.store());
        system.start();
        shared.plan(system);
        ASSERT_EQ(shared.owned(), system.store().size());
        std::vector<double> numbers(shared.entries(), -1);
        std::copy(system.store().id.begin(), system.store().id.end(), numbers.begin());
        shared.distribute(numbers.data(), 1);
        for (const double number : numbers) id.push_back(static_cast<int>(number));
    }
    int ranks() const { return system.decomposition().size(); }
    int rank() const { return system.decomposition().rank(); }
    // knows[r * count + i]: whether rank r has particle i, as an owned particle or as a ghost.
    std::vector<int> whoKnows() const {
        std::vector<int> own(static_cast<std::size_t>(p.count()), 0),
            all(own.size() * static_cast<std::size_t>(ranks()));
        for (const int i : id) own[static_cast<std::size_t>(i)] = 1;
        MPI_Allgather(own.data(), p.count(), MPI_INT, all.data(), p.count(), MPI_INT, MPI_COMM_WORLD);
        return all;
    }
    static double part(int particle, int rank, int component) {
        return std::sin(1 + 7.3 * particle + 0.37 * rank * (1 + component));
    }
};

}  // namespace

TEST_P(Shared, everyGhostHasTheEntryOfItsParticle) {
    EXPECT_EQ(std::set<int>(id.begin(), id.end()).size(), id.size()) << "each particle once";
    const RealArray records = taggedRecords(system);
    std::set<std::size_t> seen;
    for (int g = 0; g < system.ghosts(); ++g) {
        const std::size_t entry = shared.entry(g);
        ASSERT_LT(entry, shared.entries());
        EXPECT_EQ(id[entry], records[static_cast<std::size_t>(system.owned() + g) * tagFields + 3]);
        if (entry >= shared.owned()) seen.insert(entry);
    }
    EXPECT_EQ(seen.size(), shared.entries() - shared.owned()) << "no entry without a ghost";
    for (std::size_t k = 0; k < shared.ghostOf().size(); ++k)
        EXPECT_EQ(shared.entry(shared.ghostOf()[k]), shared.owned() + k);
}

// Exact to the last bit: the sums are the same on all ranks, since they are taken in the order of ranks.
TEST_P(Shared, sumsAreThoseOfAllWhoKnowAParticle) {
    constexpr int width = 3, count = 2;
    const std::vector<int> knows = whoKnows();
    std::vector<double> values;
    for (const int i : id)
        for (int k = 0; k < width; ++k) values.push_back(part(i, rank(), k));
    shared.beginSum(values.data(), {width, count});
    shared.finishSum(values.data(), {width, count});
    std::vector<std::size_t> several;
    for (std::size_t e = 0; e < id.size(); ++e) {
        int sharers = 0;
        double sum[width] = {};
        for (int r = 0; r < ranks(); ++r) {
            if (!knows[static_cast<std::size_t>(r * p.count() + id[e])]) continue;
            ++sharers;
            for (int k = 0; k < width; ++k) sum[k] += part(id[e], r, k);
        }
        if (sharers > 1) several.push_back(e);
        sum[count] = part(id[e], rank(), count);  // not summed: unchanged
        for (int k = 0; k < width; ++k) EXPECT_EQ(values[width * e + static_cast<std::size_t>(k)], sum[k]);
    }
    EXPECT_EQ(shared.shared(), several);
}

TEST_P(Shared, blocksThatReachSharedParticlesAreKnown) {
    const PairView view = system.list().view();
    const int lanes = system.list().lanes();
    const std::set<std::size_t> known(shared.shared().begin(), shared.shared().end());
    std::vector<int> seen(static_cast<std::size_t>(system.list().blockCount()), 0);
    const auto expect = [&](const std::vector<int>& blocks, bool reaching, bool atWall) {
        for (const int b : blocks) {
            ++seen[static_cast<std::size_t>(b)];
            bool reaches = false;
            for (int i = b * lanes; i < std::min(view.owned, (b + 1) * lanes); ++i)
                reaches |= known.contains(static_cast<std::size_t>(i));
            for (int k = view.begin(b); k < view.end(b); ++k) {
                const int j = view.j[k];
                reaches |= known.contains(j < view.owned ? static_cast<std::size_t>(j) : shared.entry(j - view.owned));
            }
            EXPECT_EQ(reaches, reaching);
            bool listed = false;
            for (const auto group :
                 {PairList::interior, PairList::boundary, PairList::interiorAtWall, PairList::boundaryAtWall})
                if (PairList::isAtWall(group) == atWall)
                    listed |= std::count(system.list().blocks(group).begin(), system.list().blocks(group).end(), b) > 0;
            EXPECT_TRUE(listed);
        }
    };
    expect(shared.reaching().away, true, false), expect(shared.reaching().atWall, true, true);
    expect(shared.rest().away, false, false), expect(shared.rest().atWall, false, true);
    for (const int times : seen) EXPECT_EQ(times, 1);
}

INSTANTIATE_TEST_SUITE_P(Boxes, Shared, ::testing::ValuesIn(populatedBoxes),
                         [](const auto& info) { return info.param.name; });
