// Energy, forces and stiffness of contact: derivatives against central differences, conservation of momentum and
// angular momentum, periodic images, self-contact.
#include "contact/contacts.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "contact/barrierMorse.hpp"
#include "contact/surfaces.hpp"

namespace corpuscle::contact {
namespace {

using Pairs = std::vector<geometry::ImagePair>;
const Vec3 none = Vec3::Zero();

std::shared_ptr<const ContactLaw> barrier(double reach, double thickness) {
    auto law = std::make_shared<Barrier>();
    law->length = reach, law->strength = 1, law->thickness = thickness;
    return law;
}
std::shared_ptr<const ContactLaw> attraction() {
    auto law = std::make_shared<BarrierMorse>();
    law->length = 0.05, law->strength = 1, law->thickness = 0.01, law->depth = 0.4, law->rest = 0.06, law->decay = 0.03;
    law->cutoff = 0.12;
    return law;
}

// Two spheres with displaced nodes, near each other.
Scene twoSpheres(double gap, unsigned long seed = 5) {
    geometry::TriangleMesh one = sphere(1, 2), other = sphere(1, 2);
    Random random(seed);
    for (Vec3& x : one.nodes) x += random.vector(0.005);
    for (Vec3& x : other.nodes) x += random.vector(0.005);
    other.rotate(geometry::rotationFromZ({0.3, 0.7, 1}));
    other.translate(Vec3(1.8, 0.6, 0.5).normalized() * (2 + gap));
    Scene scene;
    scene.add(one), scene.add(other);
    return scene;
}

// A sphere flattened until its two sides are near each other.
Scene flatSphere() {
    geometry::TriangleMesh mesh = sphere(1, 2);
    Random random(9);
    for (Vec3& x : mesh.nodes) x += random.vector(0.02), x.z() *= 0.05;
    Scene scene;
    scene.add(mesh);
    return scene;
}

void checkForces(const Scene& scene, const Pairs& pairs, const std::shared_ptr<const ContactLaw>& law) {
    Contacts contacts(law);
    const std::vector<const Surface*> pointers = scene.pointers();
    contacts.find(pointers, scene.x, pairs, 0.02);
    ASSERT_GT(contacts.count(), 20U);
    std::vector<Vec3> f(scene.x.size(), none);
    contacts.addForces(f);
    double largest = 0;
    for (const Vec3& one : f) largest = std::max(largest, one.norm());
    Contacts probe = contacts;
    std::vector<Vec3> x = scene.x;
    const double h = 1e-7;
    for (std::size_t n = 0; n < x.size(); ++n)
        for (int axis = 0; axis < 3; ++axis) {
            if (f[n].isZero(0)) continue;
            const double before = x[n][axis];
            const auto energyAt = [&](double by) {
                x[n][axis] = before + by;
                probe.evaluate(x);
                return probe.energy();
            };
            const double slope = (8 * (energyAt(h) - energyAt(-h)) - (energyAt(2 * h) - energyAt(-2 * h))) / (12 * h);
            x[n][axis] = before;
            EXPECT_NEAR(f[n][axis], -slope, 1e-6 * largest);
        }
}

TEST(Contacts, forcesAreMinusTheGradientOfTheEnergy) {
    for (const double gap : {0.01, 0.04}) checkForces(twoSpheres(gap), {{0, 1, none}}, barrier(0.1, 0.01));
    checkForces(twoSpheres(0.05), {{0, 1, none}}, attraction());
    checkForces(flatSphere(), {{0, 0, none}}, barrier(0.1, 0));
    Scene apart = twoSpheres(0.02);  // moved, so that the first sphere touches an image of the second
    const Vec3 shift(0.4, 7, -3);
    for (int n = 0; n < static_cast<int>(apart.surfaces[0].nodes()); ++n) apart.x[n] += shift;
    checkForces(apart, {{0, 1, shift}}, barrier(0.1, 0.01));
}

TEST(Contacts, noNetForceAndNoTorque) {
    for (const Scene& scene : {twoSpheres(0.01), flatSphere()}) {
        Contacts contacts(barrier(0.12, 0));
        const std::vector<const Surface*> pointers = scene.pointers();
        Pairs pairs{{0, 0, none}};
        if (pointers.size() == 2) pairs = {{0, 1, none}};
        contacts.find(pointers, scene.x, pairs, 0);
        std::vector<Vec3> f(scene.x.size(), none);
        contacts.addForces(f);
        Vec3 force = none, torque = none;
        Mat3 virial = Mat3::Zero();
        double sum = 0;
        for (std::size_t n = 0; n < f.size(); ++n) {
            force += f[n], torque += scene.x[n].cross(f[n]), sum += f[n].norm();
            virial += scene.x[n] * f[n].transpose();
        }
        ASSERT_GT(sum, 0);
        EXPECT_LT(force.norm(), 1e-12 * sum);
        EXPECT_LT(torque.norm(), 1e-11 * sum);
        EXPECT_LT((virial - contacts.virial()).norm(), 1e-11 * sum);
        EXPECT_LT((contacts.virial() - contacts.virial().transpose()).norm(), 1e-11 * sum);
    }
}

// Surfaces that touch across periodic faces have the same energy, forces and virial as side by side.
TEST(Contacts, imagesAreLikeTheSurfacesThemselves) {
    const Scene near = twoSpheres(0.01);
    Scene far = near;
    const Vec3 shift(-5, 0.3, 8);
    for (std::size_t n = near.surfaces[0].nodes(); n < far.x.size(); ++n) far.x[n] -= shift;
    Contacts one(barrier(0.1, 0.01)), other(barrier(0.1, 0.01));
    const std::vector<const Surface*> pointers = near.pointers(), again = far.pointers();
    one.find(pointers, near.x, Pairs{{0, 1, none}}, 0.01);
    other.find(again, far.x, Pairs{{0, 1, shift}}, 0.01);
    EXPECT_GT(one.energy(), 0);
    EXPECT_NEAR(one.energy(), other.energy(), 1e-10 * one.energy());
    EXPECT_NEAR(one.leastGap(), other.leastGap(), 1e-12);
    EXPECT_LT((one.virial() - other.virial()).norm(), 1e-9 * one.virial().norm());
    std::vector<Vec3> f(near.x.size(), none), g(near.x.size(), none);
    one.addForces(f), other.addForces(g);
    double difference = 0, sum = 0;
    for (std::size_t n = 0; n < f.size(); ++n) difference += (f[n] - g[n]).norm(), sum += f[n].norm();
    EXPECT_LT(difference, 1e-9 * sum);

    // A surface in contact with its own image: the forces on it sum to zero.
    Scene single;
    single.add(sphere(1, 2));
    Contacts own(barrier(0.1, 0));
    const std::vector<const Surface*> alone = single.pointers();
    own.find(alone, single.x, Pairs{{0, 0, Vec3(2.03, 0.1, 0)}}, 0);
    EXPECT_GT(own.energy(), 0);
    std::vector<Vec3> h(single.x.size(), none);
    own.addForces(h);
    Vec3 net = none;
    for (const Vec3& each : h) net += each;
    EXPECT_LT(net.norm(), 1e-12 * own.energy());
    EXPECT_LT(own.virial()(0, 0), 0.1);
    EXPECT_GT(own.virial()(0, 0), 0) << "repulsion along x: a positive pressure";
}

Eigen::MatrixXd stiffnessOf(const Contacts& contacts, std::size_t nodes) {
    Eigen::MatrixXd K(3 * nodes, 3 * nodes);
    std::vector<Vec3> u(nodes, none);
    for (std::size_t k = 0; k < 3 * nodes; ++k) {
        std::vector<Vec3> f(nodes, none);
        u[k / 3][k % 3] = 1;
        contacts.addStiffness(2, u, f);
        u[k / 3][k % 3] = 0;
        for (std::size_t n = 0; n < nodes; ++n) K.block<3, 1>(3 * n, k) = 0.5 * f[n];
    }
    return K;
}

TEST(Contacts, stiffnessIsPositiveSemiDefinite) {
    for (const Scene& scene : {twoSpheres(0.01), flatSphere()}) {
        Contacts contacts(attraction());
        const std::vector<const Surface*> pointers = scene.pointers();
        Pairs pairs{{0, 0, none}};
        if (pointers.size() == 2) pairs = {{0, 1, none}};
        contacts.find(pointers, scene.x, pairs, 0);
        const Eigen::MatrixXd K = stiffnessOf(contacts, scene.x.size());
        EXPECT_GT(K.norm(), 0);
        EXPECT_LT((K - K.transpose()).norm(), 1e-12 * K.norm());
        const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
        EXPECT_GT(eigenvalues.minCoeff(), -1e-12 * eigenvalues.maxCoeff());
    }
}

// A small gap over triangles, far from the ends of edges: the term with psi'' dominates the stiffness.
TEST(Contacts, stiffnessIsTheHessianWhereTheBarrierIsSteep) {
    Scene scene;
    geometry::TriangleMesh tent, plate;
    tent.nodes = {{0.05, 0.02, 0.001}, {0.4, 0, 0.3}, {-0.3, 0.3, 0.3}, {-0.3, -0.4, 0.3}};
    tent.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    plate.nodes = {{1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
    plate.triangles = {{0, 1, 2}};
    scene.add(tent), scene.add(plate);
    Contacts contacts(barrier(0.1, 0));
    const std::vector<const Surface*> pointers = scene.pointers();
    contacts.find(pointers, scene.x, Pairs{{0, 1, none}}, 0.05);
    ASSERT_EQ(contacts.count(), 1U);
    const Eigen::MatrixXd K = stiffnessOf(contacts, scene.x.size());
    Eigen::MatrixXd H(K.rows(), K.cols());
    const double h = 1e-7;
    const auto gradient = [&](int k, double by) {
        std::vector<Vec3> x = scene.x, f(x.size(), none);
        x[k / 3][k % 3] += by;
        contacts.evaluate(x);
        contacts.addForces(f);
        return f;
    };
    for (int k = 0; k < H.cols(); ++k) {
        const std::vector<Vec3> up = gradient(k, h), down = gradient(k, -h);
        for (std::size_t n = 0; n < up.size(); ++n) H.block<3, 1>(3 * n, k) = -(up[n] - down[n]) / (2 * h);
    }
    EXPECT_LT((K - H).norm(), 0.01 * H.norm());
}

TEST(Contacts, aSphereHasNoContactsWithItself) {
    Scene scene;
    scene.add(sphere(1, 3));
    const geometry::TriangleMesh mesh = sphere(1, 3);
    Contacts contacts(barrier(largestReach(mesh.nodes, mesh.triangles), 0));
    const std::vector<const Surface*> pointers = scene.pointers();
    contacts.find(pointers, scene.x, Pairs{{0, 0, none}}, 0.2);
    EXPECT_GT(contacts.candidates().rows.size(), 0U);
    EXPECT_EQ(contacts.count(), 0U);
    EXPECT_EQ(contacts.energy(), 0);
    EXPECT_GT(contacts.leastGap(), 0.8 * 0.138 * 0.866) << "height of the smallest triangles";
}

// A node that approaches a node, an edge or the inside of a triangle of another surface, from outside or inside: the
// energy is at least that of the gap to the nearest point, so it diverges.
TEST(Contacts, energyDivergesTowardsEveryPieceOfASurface) {
    Scene scene;
    const geometry::TriangleMesh ball = sphere(1, 1);
    geometry::TriangleMesh tip;
    tip.nodes = {{0, 0, 0}, {0.1, 0, 1}, {-0.1, 0.1, 1}, {-0.1, -0.1, 1}};
    tip.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    const Surface surface(ball.nodes, ball.triangles), needle(tip.nodes, tip.triangles);
    const std::vector<const Surface*> pointers{&surface, &needle};
    const double reach = 0.2, area = needle.nodeArea()[0];
    const auto law = barrier(reach, 0);
    for (const bool inside : {false, true})  // seen from inside, edges and nodes are valleys
        for (const Vec3& corner : {Vec3(1, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.3, 0.3, 0.4), Vec3(0.01, 0.98, 0.01)}) {
            const Index3& t = ball.triangles[5];
            const Vec3 place =
                corner[0] * ball.nodes[t[0]] + corner[1] * ball.nodes[t[1]] + corner[2] * ball.nodes[t[2]];
            double before = 0;
            for (const double height : {1e-1, 1e-2, 1e-4, 1e-6, 1e-9}) {
                const Vec3 outward = (inside ? -1 : 1) * place.normalized();
                std::vector<Vec3> x = ball.nodes;
                const Mat3 turn = geometry::rotationFromZ(outward);
                for (const Vec3& node : tip.nodes) x.emplace_back(place + height * outward + turn * node);
                Contacts contacts(law);
                contacts.find(pointers, x, Pairs{{0, 1, none}}, 0);
                const double share =
                    nodeShare * surface.meanNodeArea() / (surface.meanNodeArea() + needle.meanNodeArea());
                EXPECT_GE(contacts.energy(), share * area * law->at(height).energy * (1 - 1e-9)) << inside << corner;
                EXPECT_GT(contacts.energy(), before);
                before = contacts.energy();
            }
        }
}

// Two ridges that cross far from all nodes, so that only edges are near each other: the energy diverges as the gap
// closes, and the forces push the ridges apart.
TEST(Contacts, ridgesThatCrossRepelEachOther) {
    geometry::TriangleMesh ridge;
    ridge.nodes = {{-1, 0, 0}, {1, 0, 0}, {0, 1, -1}, {0, -1, -1}};
    ridge.triangles = {{0, 1, 2}, {1, 0, 3}};
    const auto law = barrier(0.1, 0.02);
    double before = 0;
    for (const double angle : {0.03, 0.2, 1.5})
        for (const double gap : {1e-1, 1e-2, 1e-4, 1e-7, 1e-10}) {
            geometry::TriangleMesh other = ridge;
            other.rotate(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix());
            other.rotate(Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix());
            other.translate({0.2, 0.01, 0.02 + gap * (1 - 1e-6)});
            Scene scene;
            scene.add(ridge), scene.add(other);
            Contacts contacts(law);
            const std::vector<const Surface*> pointers = scene.pointers();
            contacts.find(pointers, scene.x, Pairs{{0, 1, none}}, 0.01);
            std::vector<Vec3> f(scene.x.size(), none);
            contacts.addForces(f);
            if (gap < 0.05) {
                EXPECT_GT(contacts.energy(), before) << angle << " " << gap;
                EXPECT_LT(f[0].z() + f[1].z(), 0);
                EXPECT_GT(f[4].z() + f[5].z(), 0);
                EXPECT_NEAR(contacts.leastGap(), gap, 2e-6 * gap);
            }
            before = gap == 1e-10 ? 0 : contacts.energy();
        }
}

TEST(Contacts, listsHoldUntilSurfacesHaveApproachedByTheSpareLength) {
    Scene scene = twoSpheres(0.05);
    Contacts contacts(barrier(0.1, 0));
    const std::vector<const Surface*> pointers = scene.pointers();
    contacts.find(pointers, scene.x, Pairs{{0, 1, none}}, 0.1);
    EXPECT_TRUE(contacts.covers(scene.x));
    std::vector<Vec3> x = scene.x, u(x.size(), none);
    for (std::size_t n = 0; n < x.size(); ++n) {
        const Vec3 towards = n < scene.surfaces[0].nodes() ? x.back() - x[0] : x[0] - x.back();
        u[n] = 0.049 * towards.normalized();
        x[n] += 0.4 * u[n];
    }
    EXPECT_TRUE(contacts.covers(x));
    contacts.evaluate(x);
    Contacts fresh(barrier(0.1, 0));
    fresh.find(pointers, x, Pairs{{0, 1, none}}, 0);
    EXPECT_EQ(contacts.energy(), fresh.energy());
    EXPECT_EQ(contacts.count(), fresh.count());
    x[3] += Vec3(0.08, 0, 0);
    EXPECT_FALSE(contacts.covers(x));
    EXPECT_EQ(contacts.freeTravel(x, u), 0);
}

TEST(Contacts, travelEndsBeforeAnythingMeets) {
    const Scene scene = twoSpheres(0.05);
    Contacts contacts(barrier(0.1, 0.01));
    const std::vector<const Surface*> pointers = scene.pointers();
    contacts.find(pointers, scene.x, Pairs{{0, 1, none}}, 0.5);
    std::vector<Vec3> u(scene.x.size(), none);
    EXPECT_EQ(contacts.freeTravel(scene.x, u), 1);
    for (std::size_t n = 0; n < scene.surfaces[0].nodes(); ++n) u[n] = 0.2 * Vec3(1.8, 0.6, 0.5).normalized();
    const double free = contacts.freeTravel(scene.x, u);
    EXPECT_GT(free, 0.1);
    EXPECT_LT(free, 0.9);
    std::vector<Vec3> x = scene.x;
    for (std::size_t n = 0; n < x.size(); ++n) x[n] += free * u[n];
    const double before = contacts.leastGap();
    contacts.evaluate(x);
    EXPECT_GE(contacts.leastGap(), 0.1 * before * (1 - 1e-9));
    EXPECT_LE(contacts.leastGap(), 0.5 * before);
    for (Vec3& one : u) one = Vec3(10, 0, 0);
    EXPECT_LT(contacts.freeTravel(scene.x, u), 0.03) << "no farther than the lists cover";
}

// A flow carries both surfaces along, much farther than their distance: lists made for that motion are no longer than
// those for surfaces at rest, and remain valid after it.
TEST(Contacts, surfacesThatAreCarriedAlongTogetherKeepShortLists) {
    const Scene scene = twoSpheres(0.05);
    const std::vector<const Surface*> pointers = scene.pointers();
    const std::vector<Vec3> together(scene.x.size(), Vec3(10, 3, -2));
    Contacts still(barrier(0.1, 0)), carried(barrier(0.1, 0));
    still.find(pointers, scene.x, Pairs{{0, 1, none}}, 0.1);
    carried.find(pointers, scene.x, Pairs{{0, 1, none}}, 0.1, together);
    EXPECT_NEAR(carried.pairMargin(0.1, together), 0.2 + 2 * together[0].norm(), 1e-12);
    EXPECT_EQ(carried.candidates().triangles, still.candidates().triangles);
    EXPECT_EQ(carried.freeTravel(scene.x, together), 1);
    std::vector<Vec3> x = scene.x;
    for (std::size_t n = 0; n < x.size(); ++n) x[n] += together[n];
    EXPECT_TRUE(carried.covers(x));
    EXPECT_FALSE(still.covers(x)) << "who else may be where these are now is not known";
    carried.evaluate(x);
    EXPECT_NEAR(carried.energy(), still.energy(), 1e-12 * still.energy());
    for (std::size_t n = 0; n < scene.surfaces[0].nodes(); ++n) x[n] += Vec3(0.11, 0, 0);
    EXPECT_FALSE(carried.covers(x));
}

// A surface that is rotated and stretched as a whole hardly needs longer lists for self-contact.
TEST(Contacts, aMeanDeformationKeepsListsOfOneSurfaceShort) {
    const Scene scene = twoSpheres(0.05);
    const std::vector<const Surface*> one{scene.pointers()[0]};
    const std::vector<Vec3> x(scene.x.begin(), scene.x.begin() + static_cast<std::ptrdiff_t>(one[0]->nodes()));
    Mat3 gradient;
    gradient << 0.05, 0, 0.2, 0, -0.05, 0, -0.1, 0, 0;
    std::vector<Vec3> travel;
    for (const Vec3& place : x) travel.push_back(gradient * place + Vec3(7, 0, 0));
    Contacts still(barrier(0.02, 0)), turning(barrier(0.02, 0));
    still.find(one, x, Pairs{{0, 0, none}}, 0.01);
    turning.find(one, x, Pairs{{0, 0, none}}, 0.01, travel);
    // (0.02 + 0.01)/(1 - |gradient|); from the nodes' travel above 0.4
    EXPECT_LT(turning.candidates().within[0], 0.045);
    EXPECT_EQ(turning.candidates().rows.size(), still.candidates().rows.size());
    EXPECT_EQ(turning.freeTravel(x, travel), 1);
    std::vector<Vec3> there = x;
    for (std::size_t n = 0; n < x.size(); ++n) there[n] += travel[n];
    EXPECT_TRUE(turning.covers(there));
    there[3] += Vec3(0.02, 0, 0);  // this node alone
    EXPECT_FALSE(turning.covers(there));
}

}  // namespace
}  // namespace corpuscle::contact
