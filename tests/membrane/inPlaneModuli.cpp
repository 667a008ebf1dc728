// Bond and triangle laws: moduli at small strain against closed forms, on a regular and an irregular mesh.
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include "inPlaneCases.hpp"
#include "membrane/moduli.hpp"

namespace corpuscle::membrane {
namespace {

using namespace testing;

// Second derivatives of the energy over the area: Ks from dilation, Gs as the mean of the two shears.
SurfaceModuli fromEnergies(const std::function<double(const Mat2&)>& energyPerArea) {
    constexpr double e = 1e-4;
    const Mat2 one = Mat2::Identity(), dilation = one, shear1 = Eigen::Vector2d(1, -1).asDiagonal();
    const Mat2 shear2 = (Mat2() << 0, 1, 1, 0).finished();
    const auto second = [&](const Mat2& strain) {
        return (energyPerArea(one + e * strain) + energyPerArea(one - e * strain)) / (e * e);
    };
    return {0.5 * (second(shear1) + second(shear2)) / 4, second(dilation) / 4};
}

TEST(InPlaneLaws, ModuliOnARegularMesh) {
    for (const ModuliCase& c : moduliCases()) {
        const SurfaceModuli m = fromEnergies([&](const Mat2& F) {
            return bulk([&](const Mesh& mesh) { return energyOf(mesh, c.laws, F); }) / hexagonalCell;
        });
        EXPECT_NEAR(m.shear, c.Gs, 5e-3 * c.Gs) << c.name;
        EXPECT_NEAR(m.area, c.Ks, 5e-3 * c.Ks) << c.name;
        EXPECT_NEAR(c.laws.moduli(1).shear, c.Gs, 1e-12 * c.Gs) << c.name;
        EXPECT_NEAR(c.laws.moduli(1).area, c.Ks, 1e-12 * c.Ks) << c.name;
        RecordProperty(std::string(c.name),
                       std::to_string(m.shear / c.Gs - 1) + " " + std::to_string(m.area / c.Ks - 1));
    }
}

// Triangle laws have their moduli on any mesh, and so have scaled bonds as long as nodes move affinely with the strain;
// the moduli of bonds that are not scaled differ.
TEST(InPlaneLaws, ModuliOnAnIrregularMesh) {
    const Mesh mesh = jitteredPatch(12);
    const double area = areaOf(mesh);
    for (const ModuliCase& c : moduliCases()) {
        const SurfaceModuli m = fromEnergies([&](const Mat2& F) { return energyOf(mesh, c.laws, F) / area; });
        RecordProperty(std::string(c.name),
                       std::to_string(m.shear / c.Gs - 1) + " " + std::to_string(m.area / c.Ks - 1));
        if (c.anyMesh) {
            EXPECT_NEAR(m.shear, c.Gs, 5e-3 * c.Gs) << c.name;
            EXPECT_NEAR(m.area, c.Ks, 5e-3 * c.Ks) << c.name;
        } else {
            EXPECT_GT(std::abs(m.shear / c.Gs - 1), 0.02) << c.name;
        }
    }
}

// On closed meshes, where every bond has two triangles; the moduli follow from the stress-free mesh alone.
TEST(InPlaneLaws, MeasuredModuliOfScaledBonds) {
    const Mesh mesh = irregular(3);
    const Network network(mesh.nodes, mesh.triangles);
    for (const ModuliCase& c : moduliCases()) {
        const NetworkModuli m = measureModuli(network, c.laws);
        RecordProperty(std::string(c.name),
                       std::to_string(m.shear / m.closedForm.shear) + " deviation " + std::to_string(m.deviation));
        if (c.anyMesh) {
            EXPECT_NEAR(m.shear, c.Gs, 5e-3 * c.Gs) << c.name;
            EXPECT_NEAR(m.area, c.Ks, 5e-3 * c.Ks) << c.name;
        }
        EXPECT_EQ(m.deviation < 1e-6, static_cast<bool>(c.laws.triangles)) << c.name;
    }
}

// Shear modulus after the inner nodes have relaxed under a small pure shear: with triangle laws nodes do not move; a
// network of bonds on an irregular mesh relaxes and is softer than its affine modulus.
double relaxedShear(const Mesh& mesh, int n, const MembraneSettings& laws) {
    constexpr double e = 1e-4;
    const auto membrane = makeMembrane(mesh, laws);
    membrane->position = mapped(mesh, Eigen::Vector2d(1 + e, 1 - e).asDiagonal());
    membrane->computeForces();
    AssembledStiffness stiffness(mesh.nodes.size());
    membrane->addStiffness(Definiteness::exact, stiffness);
    std::vector<int> place(3 * mesh.nodes.size(), -1);
    int free = 0;
    for (int j = 1; j < n; ++j) {
        for (int i = 1; i < n; ++i) {
            for (int k = 0; k < 2; ++k) {
                place[3 * (j * (n + 1) + i) + k] = free++;
            }
        }
    }
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd load(free);
    const Eigen::SparseMatrix<double> all = stiffness.sparse();
    for (int column = 0; column < all.cols(); ++column) {
        for (Eigen::SparseMatrix<double>::InnerIterator it(all, column); it; ++it) {
            if (place[it.row()] >= 0 && place[column] >= 0) {
                entries.emplace_back(place[it.row()], place[column], it.value());
            }
        }
        if (place[column] >= 0) {
            load[place[column]] = membrane->force[column / 3][column % 3];
        }
    }
    Eigen::SparseMatrix<double> matrix(free, free);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd shift = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(load);
    for (std::size_t k = 0; k < place.size(); ++k) {
        membrane->position[k / 3][k % 3] += place[k] >= 0 ? shift[place[k]] : 0;
    }
    return membrane->energy() / (2 * e * e * areaOf(mesh));
}

TEST(InPlaneLaws, RelaxedModulusOfAnIrregularMesh) {
    constexpr int n = 12;
    const Mesh mesh = jitteredPatch(n);
    for (const ModuliCase& c : moduliCases()) {
        const double relaxed = relaxedShear(mesh, n, c.laws);
        const double affine =
            energyOf(mesh, c.laws, Eigen::Vector2d(1 + 1e-4, 1 - 1e-4).asDiagonal()) / (2e-8 * areaOf(mesh));
        RecordProperty(std::string(c.name),
                       std::to_string(relaxed / c.Gs) + " affine " + std::to_string(affine / c.Gs));
        if (c.laws.triangles) {
            EXPECT_NEAR(relaxed, c.Gs, 5e-3 * c.Gs) << c.name;
        } else {
            EXPECT_LT(relaxed, 0.99 * affine) << c.name;
            EXPECT_GT(relaxed, 0.8 * affine) << c.name;
        }
    }
}

}  // namespace
}  // namespace corpuscle::membrane
