// Decomposition, migration and halo.
#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "core/error.hpp"
#include "particles/population.hpp"

using namespace corpuscle;
using namespace corpuscle::particles;
using namespace corpuscle::particles::testing;

namespace {

int sum(int value) {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return value;
}

// Bits that depend on the particle and the field only.
std::uint64_t bits(std::int64_t id, std::string_view field) {
    std::uint64_t h = 1469598103934665603ull ^ static_cast<std::uint64_t>(id) * 0x9E3779B97F4A7C15ull;
    for (const char c : field) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ull;
    return h ^ (h >> 31);
}

bool isPlace(std::string_view field) {
    return field == "x" || field == "y" || field == "z" || field == "id" || field == "kind";
}

}  // namespace

TEST(Decomposition, bricksTileTheBoxAndEachPositionHasOneOwner) {
    const Population p(box({11, 7, 5}, true, true, false), 4000, 2);
    ParticleStore store;
    p.deal(store);
    Decomposition d(MPI_COMM_WORLD, p.box);
    for (int pass = 0; pass < 2; ++pass) {  // slices at the start, then bricks of the bisection
        double volume = 0;
        for (int r = 0; r < d.size(); ++r) volume += (d.brick(r).high - d.brick(r).low).prod();
        EXPECT_NEAR(volume, p.box.volume(), 1e-10 * p.box.volume());
        const Population probes(p.box, 2000, 77);
        for (const Vec3& x : probes.position) {
            int holders = 0, owner = -1;
            for (int r = 0; r < d.size(); ++r)
                if ((x.array() >= d.brick(r).low.array()).all() && (x.array() < d.brick(r).high.array()).all())
                    ++holders, owner = r;
            EXPECT_EQ(holders, 1);
            EXPECT_EQ(d.owner(x), owner);
        }
        std::vector<double> root = d.state();
        MPI_Bcast(root.data(), static_cast<int>(root.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
        EXPECT_EQ(root, d.state()) << "every rank knows the same bricks";
        d.balance(store);
    }
    migrate(store, d);
    EXPECT_LT(d.imbalance(store.size()), 1.02);
    // The outermost bricks extend beyond the walls.
    for (const double z : {p.box.low[2] - 3, p.box.high[2], p.box.high[2] + 3}) {
        const int owner = d.owner({p.box.low[0] + 0.1, p.box.low[1] + 0.1, z});
        EXPECT_GE(owner, 0);
    }
    Decomposition again(MPI_COMM_WORLD, p.box);
    again.restore(d.state());
    EXPECT_EQ(again.state(), d.state());
}

TEST(Migration, keepsEveryFieldBitForBitAndLosesNobody) {
    const Population p(box({9, 8, 7}), 1500, 6);
    ParticleStore store({true, true, true, true});
    p.deal(store);
    const auto fill = [](std::string_view name, auto& array, const IntegerArray& id) {
        if (isPlace(name)) return;
        for (std::size_t i = 0; i < array.size(); ++i)
            array[i] = std::bit_cast<typename std::remove_reference_t<decltype(array)>::value_type>(bits(id[i], name));
    };
    store.forEachField([&](std::string_view name, auto& array) { fill(name, array, store.id); });
    Decomposition d(MPI_COMM_WORLD, p.box);
    d.balance(store);
    for (int pass = 0; pass < 3; ++pass) {
        migrate(store, d);
        EXPECT_EQ(sum(static_cast<int>(store.size())), p.count());
        std::vector<int> seen(p.position.size(), 0);
        for (std::size_t i = 0; i < store.size(); ++i) {
            ++seen[static_cast<std::size_t>(store.id[i])];
            EXPECT_EQ(d.owner(store.position(i)), d.rank());
        }
        MPI_Allreduce(MPI_IN_PLACE, seen.data(), static_cast<int>(seen.size()), MPI_INT, MPI_SUM, MPI_COMM_WORLD);
        for (const int times : seen) EXPECT_EQ(times, 1);
        store.forEachField([&](std::string_view name, const auto& array) {
            if (isPlace(name)) return;
            for (std::size_t i = 0; i < array.size(); ++i)
                EXPECT_EQ(std::bit_cast<std::uint64_t>(array[i]), bits(store.id[i], name)) << name;
        });
        // All particles move by a third of the box, so that most change rank.
        for (std::size_t i = 0; i < store.size(); ++i)
            store.setPosition(i, p.box.periodicity().wrap(store.position(i) + Vec3(3, 2.7, 2.3)));
    }
}

TEST(Migration, reorderTakesASelectionInTheOrderAsked) {
    ParticleStore store({false, false, true, false});
    store.resize(5);
    for (std::size_t i = 0; i < 5; ++i)
        store.x[i] = static_cast<double>(i), store.side[i] = static_cast<std::int64_t>(10 * i);
    store.reorder({4, 0, 2});
    EXPECT_EQ(store.size(), 3u);
    EXPECT_EQ(store.x, (RealArray{4, 0, 2}));
    EXPECT_EQ(store.side, (IntegerArray{40, 0, 20}));
}

TEST(Halo, ghostsFollowTheirParticlesWithTheImagesShift) {
    const Population p(box({6, 4, 2.1}, true, true, true), 60, 9);
    ParticleSystem system(MPI_COMM_WORLD, p.box, {}, 2, 0.3, 1);
    p.deal(system.store());
    system.start();
    // Ghosts have the current positions, not those at the rebuild, and all other fields unchanged.
    ParticleStore& s = system.store();
    constexpr int fields = 6;
    const auto moved = [&](int id) -> Vec3 { return p.position[id] + Vec3(0.01 * id, -0.5, 0.125); };
    RealArray records(static_cast<std::size_t>(system.owned() + system.ghosts()) * fields);
    for (int i = 0; i < system.owned(); ++i) {
        const Vec3 x = moved(static_cast<int>(s.id[i]));
        const double id = static_cast<double>(s.id[i]);
        std::copy_n(std::array<double, fields>{x[0], x[1], x[2], id, 1 / (id + 1), std::sin(id)}.begin(), fields,
                    records.begin() + fields * i);
    }
    system.forEachPair(records.data(), fields, 1, [](PairList::Group) {});
    const Brick& brick = system.decomposition().own();
    for (int g = system.owned(); g < system.owned() + system.ghosts(); ++g) {
        const double* r = records.data() + fields * g;
        const int id = static_cast<int>(r[3]);
        EXPECT_EQ(r[4], 1 / (r[3] + 1));
        EXPECT_EQ(r[5], std::sin(r[3]));
        Vec3 shift;
        for (int k = 0; k < 3; ++k) {
            const double lengths = (r[k] - moved(id)[k]) / p.box.size()[k];
            EXPECT_NEAR(lengths, std::round(lengths), 1e-13);
            shift[k] = std::round(lengths) * p.box.size()[k];
        }
        EXPECT_LT(distanceSquared(p.position[id] + shift, brick.low, brick.high), 2.3 * 2.3);
    }
}

// Every image within reach of the brick is a ghost exactly once, at the place and with the slide velocity given by the
// box; for offsets from none to more than half a period, where the next image takes over.
TEST(Halo, ghostsAreAllImagesOfABoxThatSlides) {
    const Population p(box({6, 4, 5}, true, true, true), 150, 9);
    constexpr double reach = 2.3, speed = 1.5;
    constexpr int fields = 4;
    for (const double seconds : {0.0, 1.1, 2.1, 13.3}) {
        ParticleSystem system(MPI_COMM_WORLD, p.box, {}, 2, 0.3, 1);
        system.slideImages(2, {speed, 0, 0});
        system.moveImages(seconds);
        EXPECT_NEAR(std::remainder(system.periodicity().offset()[0] - speed * seconds, 6), 0, 1e-12);
        EXPECT_LE(std::abs(system.periodicity().offset()[0]), 3);
        p.deal(system.store());
        system.start();
        const ParticleStore& s = system.store();
        RealArray records(static_cast<std::size_t>(system.owned() + system.ghosts()) * fields);
        for (std::size_t i = 0; i < s.size(); ++i)
            Vec3::Map(records.data() + fields * i) = s.position(i),
                                                records[fields * i + 3] = static_cast<double>(s.id[i]);
        system.forEachPair(records.data(), fields, 1, [](PairList::Group) {});
        const std::vector<Vec3> slides = system.halo().slides(system.owned());
        const Brick& brick = system.decomposition().own();
        int expected = 0;
        const auto isGhost = [&](int id, const Vec3& place, double slide) {
            for (int g = 0; g < system.ghosts(); ++g) {
                const double* r = records.data() + fields * (system.owned() + g);
                if (r[3] == id && (Vec3::Map(r) - place).norm() < 1e-12)
                    return (slides[static_cast<std::size_t>(g)] - Vec3(slide, 0, 0)).norm() < 1e-12;
            }
            return false;
        };
        for (int id = 0; id < p.count(); ++id)
            for (int a = -6; a <= 6; ++a)
                for (int b = -2; b <= 2; ++b)
                    for (int c = -2; c <= 2; ++c) {
                        const Vec3 place = p.position[id] + Vec3(6 * a + c * speed * seconds, 4 * b, 5 * c);
                        if (distanceSquared(place, brick.low, brick.high) >= reach * reach) continue;
                        if (c == 0 && distanceSquared(place, brick.low, brick.high) == 0 && a == 0 && b == 0 &&
                            system.decomposition().owner(place) == system.decomposition().rank())
                            continue;
                        ++expected;
                        EXPECT_TRUE(isGhost(id, place, c * speed)) << id << " " << a << b << c << " " << seconds;
                    }
        EXPECT_EQ(system.ghosts(), expected);
    }
}

TEST(Rebuild, refusesAPositionThatIsNotFiniteOnAllRanks) {
    const Population p(box({9, 8, 7}), 1500, 6);
    ParticleSystem system(MPI_COMM_WORLD, p.box, {}, 2, 0.3, 1);
    p.deal(system.store());
    system.start();
    for (int axis = 0; axis < 3; ++axis) {  // also along a periodic axis, where the box wraps
        ParticleStore& s = system.store();
        const int last = system.decomposition().size() - 1;
        const Vec3 sound = s.position(0);
        Vec3 broken = sound;
        broken[axis] = std::numeric_limits<double>::quiet_NaN();
        if (system.decomposition().rank() == last) s.setPosition(0, broken);
        try {
            system.rebuild();
            ADD_FAILURE() << "axis " << axis << ": no rank noticed";
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), ExitCode::numerics);
            EXPECT_NE(std::string(failure.what()).find("has no finite position"), std::string::npos) << failure.what();
        }
        if (system.decomposition().rank() == last) s.setPosition(0, sound);
    }
}
