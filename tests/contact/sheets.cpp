// Two flat sheets at a gap g have the energy psi(g) per area, whatever their shift, direction and mesh; a node that
// slides over a sheet does not feel its triangles.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "contact/barrier.hpp"
#include "contact/contacts.hpp"
#include "contact/surfaces.hpp"
#include "geometry/flatSheet.hpp"

namespace corpuscle::contact {
namespace {

std::shared_ptr<const Barrier> barrier(double reach) {
    auto law = std::make_shared<Barrier>();
    law->length = reach, law->strength = 1, law->thickness = 0.05;
    return law;
}

// n x n cells of the hexagonal lattice with edges of length 1.
geometry::TriangleMesh lattice(int n, const Vec3& corner) {
    geometry::TriangleMesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) mesh.nodes.emplace_back(corner + Vec3(i + 0.5 * j, 0.5 * std::sqrt(3.0) * j, 0));
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int at = j * (n + 1) + i;
            mesh.triangles.push_back({at, at + 1, at + n + 1});
            mesh.triangles.push_back({at + 1, at + n + 2, at + n + 1});
        }
    return mesh;
}

double energy(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b, double reach) {
    Scene scene;
    scene.add(a), scene.add(b);
    const std::vector<const Surface*> pointers = scene.pointers();
    Contacts contacts(barrier(reach));
    contacts.find(pointers, scene.x, std::vector<geometry::ImagePair>{{0, 1, Vec3::Zero()}}, 0);
    return contacts.energy();
}

// Energy per area without the effect of borders: the second difference over three sizes.
double perArea(const Vec3& shift, double reach, double gap) {
    const geometry::TriangleMesh large = lattice(16, Vec3::Zero());
    const Vec3 corner = Vec3(3, std::sqrt(3.0), 0.05 + gap) + shift;
    const double sum = energy(lattice(9, corner), large, reach) - 2 * energy(lattice(6, corner), large, reach) +
                       energy(lattice(3, corner), large, reach);
    return sum / (18 * 0.5 * std::sqrt(3.0));
}

TEST(FlatSheets, energyPerAreaWhateverTheShift) {
    for (const double reach : {0.1, 0.25})
        for (const double gap : {0.1 * reach, 0.5 * reach}) {
            double least = 10, most = 0;
            for (int i = 0; i < 6; ++i)
                for (int j = 0; j < 6; ++j) {
                    const Vec3 shift(i / 6.0 + j / 12.0, j / 12.0 * std::sqrt(3.0), 0);
                    const double ratio = perArea(shift, reach, gap) / barrier(reach)->at(gap).energy;
                    least = std::min(least, ratio), most = std::max(most, ratio);
                }
            RecordProperty("range", std::to_string(least) + " to " + std::to_string(most));
            std::printf("reach %g edges, gap %g: %.4f to %.4f of psi\n", reach, gap, least, most);
            EXPECT_GT(least, 0.9);
            EXPECT_LT(most, 1.1);
        }
}

// Disordered meshes of equal and of different edge lengths, rotated against each other. The lower sheet is larger, so
// that only the border of the upper one has an effect.
TEST(FlatSheets, energyPerAreaOfUnevenMeshes) {
    const double reach = 0.2, gap = 0.08, psi = barrier(reach)->at(gap).energy;
    for (const double edge : {1.0, 1.7, 4.0})
        for (const double angle : {0.0, 0.4, 1.1}) {
            geometry::TriangleMesh upper = geometry::disc(24, 1), lower = geometry::rectangle(64, 64, edge);
            geometry::disorder(upper, 0.2, 3);
            geometry::disorder(lower, 0.2, 4);
            lower.rotate(Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix());
            upper.translate({0.3, 0.4, 0.05 + gap});
            const double ratio = energy(upper, lower, reach) / (psi * upper.area());
            std::printf("edges 1 and %g, turned by %g: %.4f of psi\n", edge, angle, ratio);
            EXPECT_NEAR(ratio, 1, 0.1);
        }
}

TEST(FlatSheets, aSlidingNodeFeelsNoTriangles) {
    geometry::TriangleMesh sheet = geometry::rectangle(12, 12, 1);
    geometry::disorder(sheet, 0.2, 8);
    geometry::TriangleMesh tip;
    tip.nodes = {{0, 0, 0}, {0.1, 0, 1}, {-0.1, 0.1, 1}, {-0.1, -0.1, 1}};
    tip.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    Random random(3);
    double least = 1e300, most = 0;
    for (int n = 0; n < 3000; ++n) {
        geometry::TriangleMesh moved = tip;
        moved.translate(Vec3(random.between(-3, 3), random.between(-3, 3), 0.05 + 0.1));
        Scene scene;
        scene.add(moved), scene.add(sheet);
        const std::vector<const Surface*> pointers = scene.pointers();
        Contacts contacts(barrier(0.3));
        contacts.find(pointers, scene.x, std::vector<geometry::ImagePair>{{0, 1, Vec3::Zero()}}, 0);
        std::vector<Vec3> f(scene.x.size(), Vec3::Zero());
        contacts.addForces(f);
        if (contacts.count() != 1) continue;  // nodes of the sheet are near the sides of the tip too
        EXPECT_LT(std::hypot(f[0].x(), f[0].y()), 1e-9 * f[0].z()) << "no friction";
        least = std::min(least, contacts.energy()), most = std::max(most, contacts.energy());
    }
    EXPECT_LT(most, least * (1 + 1e-9));
}

// Over a sphere, which is nearly flat, the energy is that of the gap to the nearest triangle, within 2 %.
TEST(FlatSheets, aNodeSlidesOverASphere) {
    Scene scene;
    geometry::TriangleMesh tip;
    tip.nodes = {{0, 0, 0}, {0.01, 0, 0.2}, {-0.01, 0.01, 0.2}, {-0.01, -0.01, 0.2}};
    tip.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    const geometry::TriangleMesh ball = sphere(1, 4);
    scene.add(ball), scene.add(tip);
    const std::vector<const Surface*> pointers = scene.pointers();
    auto law = std::make_shared<Barrier>();
    law->length = 0.02, law->strength = 1;
    const double share = nodeShare * scene.surfaces[0].meanNodeArea() /
                         (scene.surfaces[0].meanNodeArea() + scene.surfaces[1].meanNodeArea());
    Random random(6);
    for (const double side : {1.0, -1.0})
        for (int n = 0; n < 300; ++n) {
            const Index3& t = ball.triangles[static_cast<std::size_t>(random.between(0, 5119))];
            // Away from nodes of the sphere, which are in contact with the tip themselves.
            const double a = random.between(0.1, 0.6), b = random.between(std::max(0.0, 0.4 - a), std::min(0.6, 1 - a));
            const Vec3 place = a * ball.nodes[t[0]] + b * ball.nodes[t[1]] + (1 - a - b) * ball.nodes[t[2]];
            const Vec3 normal =
                side * (ball.nodes[t[1]] - ball.nodes[t[0]]).cross(ball.nodes[t[2]] - ball.nodes[t[0]]).normalized();
            const Mat3 turn = geometry::rotationFromZ(normal);
            for (std::size_t k = 0; k < 4; ++k)
                scene.x[ball.nodes.size() + k] = place + 0.008 * normal + turn * tip.nodes[k];
            Contacts contacts(law);
            contacts.find(pointers, scene.x, std::vector<geometry::ImagePair>{{0, 1, Vec3::Zero()}}, 0);
            double nearest = 1e300;
            for (const Index3& c : ball.triangles)
                nearest = std::min(nearest, nodeToTriangle(scene.x[ball.nodes.size()], ball.nodes[c[0]],
                                                           ball.nodes[c[1]], ball.nodes[c[2]])
                                                .distance);
            const double expected = share * scene.surfaces[1].nodeArea()[0] * law->at(nearest).energy;
            EXPECT_NEAR(contacts.energy(), expected, 0.02 * expected);
        }
}

}  // namespace
}  // namespace corpuscle::contact
