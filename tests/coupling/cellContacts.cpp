// Contact of the cells of a scene against contact of all cells computed on one rank; through periodic faces, and with
// walls. Lengths in spacings.
#include "coupling/cellContacts.hpp"

#include <gtest/gtest.h>

#include "coupling/sphereScene.hpp"
#include "support/planeWalls.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

const Index3 size{14, 12, 12};
constexpr double reach = 0.25;  // below 0.4 edge lengths

contact::ContactSettings settings(bool walls = false) {
    contact::ContactSettings s;
    s.law = choice<contact::ContactLaw>("{type: barrier, reach: 0.25 m, strength: 3 N/m}");
    s.walls = walls;
    return s;
}

// Two spheres in contact; the first may touch an image of the second across a face instead of the second itself.
// margin: a rank holds the cells within this distance of its brick.
struct Touching : SphereScene {
    boundary::Walls walls;
    CellContacts contacts;
    NodeLayout layout;

    Touching(const Vec3& one, const Vec3& other, double margin, const boundary::Walls& around = {})
        : SphereScene(size, {one, other}, true, margin),
          walls(around),
          contacts(settings(walls.exist()), walls),
          layout(cells) {
        place();
    }
    void place() { contacts.place(cells, layout, *system, {NodeVectors(layout.nodes(), Vec3::Zero())}); }
    double energy() const { return sph::testing::sumOverRanks(contacts.energy(cells, *system)); }
    NodeVectors forces() const {
        NodeVectors f(layout.nodes(), Vec3::Zero());
        contacts.addForces(f);
        return f;
    }
    // f(number of the cell, node) of all nodes of the held cells.
    template <class F>
    NodeVectors vectors(F&& f) const {
        NodeVectors all;
        for (const Cell& cell : cells)
            for (int n = 0; n < cell.nodeCount(); ++n) all.push_back(f(cell.membrane.cell, n));
        return all;
    }
    NodeVectors places() const {
        return vectors(
            [&](int cell, int n) { return start[static_cast<std::size_t>(cell) - 1][static_cast<std::size_t>(n)]; });
    }
    double dot(const NodeVectors& a, const NodeVectors& b) const {  // counts each node of the scene once
        const int rank = system->decomposition().rank();
        return sph::testing::sumOverRanks(
            layout.sumOverOwned(cells, rank, [&](std::size_t m) { return a[m].dot(b[m]); }));
    }
};

Vec3 somewhere(int cell, int n) {
    const double t = 1.7 * n + 0.3 * cell;
    return {std::sin(t), std::cos(1.3 * t), std::sin(2.1 * t + 1)};
}

// Forces on all nodes, from the contact of both whole surfaces computed on this rank alone. shift: moves the second
// surface next to the first.
std::vector<Vec3> alone(const Touching& scene, const Vec3& shift) {
    const membrane::Network& network = scene.cells.types()[0].membrane->network();
    const contact::Surface surface(network.stressFree(), network.triangles());
    const std::vector<const contact::Surface*> both{&surface, &surface};
    std::vector<Vec3> x = scene.start[0];
    x.insert(x.end(), scene.start[1].begin(), scene.start[1].end());
    contact::Contacts contacts(settings().law.model);
    contacts.find(both, x, std::vector<geometry::ImagePair>{{0, 1, shift}}, 0);
    std::vector<Vec3> f(x.size(), Vec3::Zero());
    contacts.addForces(f);
    return f;
}

void compare(const Vec3& one, const Vec3& other, const Vec3& shift) {
    for (const double margin : {2.0, Cells::everywhere}) {
        const Touching scene(one, other, margin);
        const std::vector<Vec3> expected = alone(scene, shift);
        double largest = 0;
        for (const Vec3& f : expected) largest = std::max(largest, f.norm());
        ASSERT_GT(largest, 1e-3) << "the spheres do not touch";
        const NodeVectors found = scene.forces();
        const std::size_t each = scene.start[0].size();
        std::size_t m = 0;
        for (const Cell& cell : scene.cells)
            for (std::size_t n = 0; n < each; ++n, ++m)
                EXPECT_LT((found[m] - expected[each * (static_cast<std::size_t>(cell.membrane.cell) - 1) + n]).norm(),
                          1e-12 * largest);
    }
}

constexpr double apart = 2 * radius + 0.1;

TEST(CellContacts, areThoseOfWholeSurfacesOnAnyNumberOfRanks) { compare({3, 6, 6}, {3 + apart, 6, 6}, Vec3::Zero()); }
TEST(CellContacts, reachThroughPeriodicFaces) {
    compare({1, 6, 6}, {1 - apart + size[0], 6, 6}, Vec3(-size[0], 0, 0));
    compare({7, 11.5, 11}, {7, 11.5 + apart - size[1], 11}, Vec3(0, size[1], 0));
}

TEST(CellContacts, forcesAreMinusTheGradientOfTheEnergyAndStiffnessIsTheirs) {
    Touching scene({3, 6, 6}, {3 + apart, 6, 6}, 2.0);
    const NodeVectors d = scene.vectors(somewhere);
    const NodeVectors f = scene.forces();
    constexpr double h = 1e-6;
    NodeVectors there = d, back = d;
    for (std::size_t m = 0; m < d.size(); ++m) there[m] *= h, back[m] *= -h;
    const auto energyAt = [&](const NodeVectors& by) {
        const auto moved = [&](double sign) {
            std::size_t m = 0;
            for (Cell& cell : scene.cells)
                for (Vec3& x : cell.membrane.position) x += sign * by[m++];
        };
        moved(1);
        const double energy = scene.energy();
        moved(-1);
        return energy;
    };
    const double power = scene.dot(d, f);
    EXPECT_NEAR((energyAt(there) - energyAt(back)) / (2 * h), -power, 1e-6 * std::abs(power));

    NodeVectors at(d.size(), Vec3::Zero());
    scene.contacts.addForcesAt(NodeVectors(d.size(), Vec3::Zero()), at);
    for (std::size_t m = 0; m < d.size(); ++m) EXPECT_LT((at[m] - f[m]).norm(), 1e-12);
    // The stiffness is symmetric and positive semi-definite.
    const NodeVectors e = scene.vectors([](int cell, int n) { return somewhere(cell + 3, 2 * n); });
    NodeVectors Kd(d.size(), Vec3::Zero()), Ke = Kd;
    scene.contacts.addStiffness(1, d, Kd), scene.contacts.addStiffness(1, e, Ke);
    EXPECT_GT(scene.dot(d, Kd), 0);
    EXPECT_NEAR(scene.dot(e, Kd), scene.dot(d, Ke), 1e-12 * scene.dot(d, Kd));
}

TEST(CellContacts, aWayOnWhichCellsMeetIsNotFree) {
    Touching scene({3, 6, 6}, {3 + apart, 6, 6}, 2.0);
    const auto travel = [&](double by) {
        const NodeVectors way = scene.vectors([&](int cell, int) { return Vec3(cell == 1 ? by : 0, 0, 0); });
        return scene.contacts.freeTravel(scene.cells, scene.layout, *scene.system, scene.places(), {way});
    };
    EXPECT_EQ(travel(0.05), 1);
    const double free = travel(4);  // through the other cell; lists are made for this motion
    EXPECT_GT(free, 0.01);
    EXPECT_LT(free, 0.1);
    EXPECT_NEAR(free, sph::testing::sumOverRanks(free) / scene.system->decomposition().size(), 1e-15);
    EXPECT_EQ(travel(-1), 1);
}

// Two cells at rest that touch across a sliding face: the energy of contact changes by the sliding alone.
TEST(CellContacts, powerOfImagesIsWhatTheirSlideTakesFromTheEnergy) {
    for (const double along : {-0.5, 0.5}) {
        const double up = std::sqrt(1 - along * along);
        Touching scene({6, 6, 11}, {6 + along * apart, 6, 11 + up * apart - size[2]}, 2.0);
        scene.system->slideImages(2, {2, 0, 0});
        scene.place();
        const NodeVectors still(scene.layout.nodes(), Vec3::Zero());
        const double power =
            sph::testing::sumOverRanks(scene.contacts.powerOfImages(scene.system->periodicity(), still));
        EXPECT_GT(power * along, 1e-3) << "contact pushes the image on its way where it is ahead";
        constexpr double seconds = 1e-6;
        scene.system->moveImages(seconds);
        const double after = scene.energy();
        scene.system->moveImages(-2 * seconds);
        const double before = scene.energy();
        EXPECT_NEAR((after - before) / (2 * seconds), -power, 1e-5 * std::abs(power));
    }
}

// The sliding alone carries an image of the second cell past the first one. If the image approaches, the two meet after
// 1.08 s.
TEST(CellContacts, aWayOnWhichAnImageSlidesIntoACellIsNotFree) {
    for (const double speed : {-1.0, 1.0}) {
        Touching scene({3, 6, 11}, {8, 6, 1}, 2.0);
        scene.system->slideImages(2, {speed, 0, 0});
        scene.place();
        const NodeVectors still(scene.layout.nodes(), Vec3::Zero());
        const auto free = [&](double seconds, double ago) {
            return scene.contacts.freeTravel(scene.cells, scene.layout, *scene.system, scene.places(),
                                             {still, seconds, ago});
        };
        const double gap = 5 - std::sqrt(4 * radius * radius - 4);
        EXPECT_EQ(free(0.9 * gap, 0), 1);
        const double met = free(2, 0);
        if (speed > 0) {
            EXPECT_EQ(met, 1);
        } else {
            EXPECT_NEAR(2 * met, gap, 0.15) << "the spheres have edges, and a tenth of the gap is kept";
            EXPECT_LT(2 * met, gap);
        }
        // The same for a motion that began two seconds ago.
        scene.system->moveImages(2);
        EXPECT_NEAR(free(2, 2), met, 1e-12);
        // If the first cell moves along by the same distance, nothing meets.
        const NodeVectors with = scene.vectors([&](int cell, int) { return Vec3(cell == 1 ? 2 * speed : 0, 0, 0); });
        EXPECT_EQ(scene.contacts.freeTravel(scene.cells, scene.layout, *scene.system, scene.places(), {with, 2, 2}), 1);
    }
}

TEST(CellContacts, wallsHoldCellsOff) {
    const boundary::Walls walls = boundary::testing::planes(2, 1, 11, Vec3::Zero(), Vec3::Zero());
    Touching scene({4, 6, 1 + radius + 0.1}, {10, 6, 6}, 2.0, walls);
    const NodeVectors f = scene.forces();
    Vec3 total = Vec3::Zero(), onWalls = Vec3::Zero();
    const int rank = scene.system->decomposition().rank();
    scene.layout.forOwned(scene.cells, rank, [&](std::size_t m) { total += f[m]; });
    for (const auto& on : scene.contacts.forcesOnWalls(scene.cells, rank, NodeVectors(f.size(), Vec3::Zero()))) {
        EXPECT_EQ(on.wall, 0);
        onWalls += on.force;
    }
    for (int k = 0; k < 3; ++k)
        total[k] = sph::testing::sumOverRanks(total[k]), onWalls[k] = sph::testing::sumOverRanks(onWalls[k]);
    EXPECT_GT(total[2], 0.1);
    EXPECT_LT((total + onWalls).norm(), 1e-12 * total[2]);
    // Expected: the sum of the law over all nodes within reach of the wall.
    const membrane::Network& network = scene.cells.types()[0].membrane->network();
    const contact::Surface surface(network.stressFree(), network.triangles());
    double force = 0, energy = 0;
    for (std::size_t n = 0; n < scene.start[0].size(); ++n) {
        const double gap = scene.start[0][n][2] - 1;
        if (gap >= reach) continue;
        force -= surface.nodeArea()[n] * settings().law->at(gap).slope;
        energy += surface.nodeArea()[n] * settings().law->at(gap).energy;
    }
    EXPECT_NEAR(total[2], force, 1e-12 * force);
    EXPECT_NEAR(scene.energy(), energy, 1e-12 * energy);
    const NodeVectors down = scene.vectors([](int cell, int) { return Vec3(0.3, 0, cell == 1 ? -0.2 : 0); });
    const NodeVectors x = scene.places();
    EXPECT_LT(scene.contacts.freeTravel(scene.cells, scene.layout, *scene.system, x, {down}), 0.5);
    const NodeVectors along = scene.vectors([](int, int) { return Vec3(0.3, 0, 0); });
    EXPECT_EQ(scene.contacts.freeTravel(scene.cells, scene.layout, *scene.system, x, {along}), 1);
}

}  // namespace
