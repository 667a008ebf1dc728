// A constrained area above its target is under tension, and the stiffness that the implicit step uses resists
// displacements normal to the membrane.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "membrane/areaConstraint.hpp"
#include "meshes.hpp"

namespace corpuscle::membrane {
namespace {

using testing::Mesh;

Eigen::MatrixXd stiffnessOf(const AreaConstraint& area, const Mesh& mesh, Definiteness definiteness) {
    Network network(mesh.nodes, mesh.triangles);
    AssembledStiffness stiffness(mesh.nodes.size());
    for (const auto& term : area.makeTerms(network)) term->addStiffness(mesh.nodes, definiteness, stiffness);
    return stiffness.sparse();  // without the rank-one part, which both have
}

double areaOf(const Mesh& mesh) {
    double sum = 0;
    for (const Index3& t : mesh.triangles)
        sum += 0.5 * (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]).norm();
    return sum;
}

// For displacements along the normals of a sphere, the stiffness is the exact second derivative but for the
// contribution of the sphere's curvature, 2/R^2 times the tension per area.
TEST(AreaTension, ResistsDisplacementsAcross) {
    for (const Mesh& mesh : {testing::icosphere(2), testing::irregular(2)}) {
        const double rest = 0.5 * areaOf(mesh);
        const AreaConstraint area{.local = {}, .global = 1.0, .rest = rest};
        const Eigen::MatrixXd exact = stiffnessOf(area, mesh, Definiteness::exact),
                              partwise = stiffnessOf(area, mesh, Definiteness::partwise);
        Eigen::VectorXd u = Eigen::VectorXd::Zero(exact.rows());
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n)  // varies on the scale of the mesh
            u.segment<3>(static_cast<Eigen::Index>(3 * n)) =
                std::cos(7.0 * static_cast<double>(n)) * mesh.nodes[n].normalized();
        const double found = u.dot(partwise * u), expected = u.dot(exact * u);
        EXPECT_GT(found, 0);
        EXPECT_NEAR(found, expected, 0.2 * expected);
        const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(partwise).eigenvalues();
        EXPECT_GT(values.minCoeff(), -1e-12 * values.maxCoeff());
    }
}

TEST(AreaTension, IsNothingUnderCompression) {
    const Mesh mesh = testing::icosphere(1);
    const AreaConstraint area{.local = {}, .global = 1.0, .rest = 2 * areaOf(mesh)};
    EXPECT_EQ(stiffnessOf(area, mesh, Definiteness::partwise).cwiseAbs().maxCoeff(), 0);
}

// Where the area of each triangle is constrained, each triangle has its own tension.
TEST(AreaTension, OfTriangles) {
    const Mesh mesh = testing::irregular(1);
    const AreaConstraint held{.local = 1.0, .global = {}, .rest = 0.5 * areaOf(mesh)},
        atRest{.local = 1.0, .global = {}, .rest = areaOf(mesh)};
    Eigen::VectorXd u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * mesh.nodes.size()));
    u.segment<3>(0) = mesh.nodes[0].normalized();
    const double tense = u.dot(stiffnessOf(held, mesh, Definiteness::partwise) * u),
                 slack = u.dot(stiffnessOf(atRest, mesh, Definiteness::partwise) * u);
    EXPECT_GT(tense, slack + 0.1);
}

}  // namespace
}  // namespace corpuscle::membrane
