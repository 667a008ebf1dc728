#include "implicit/coarseGrid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

using namespace corpuscle;
using implicit::CoarseGrid;

namespace {

constexpr double inertia = 0.7, viscosity = 1.3, lambda = 9;

// The same operator assembled independently: elements with trilinear shape functions, integrated with 2 x 2 x 2 Gauss
// points, in one dense matrix over all nodes; the caller removes nodes at walls.
// toBox: from derivatives along the grid's axes to those along the box's axes.
Eigen::MatrixXd assemble(const std::array<int, 3>& cells, const std::array<int, 3>& nodes, const Vec3& step,
                         const Mat3& toBox = Mat3::Identity()) {
    const auto number = [&](int i, int j, int k) {
        return ((i % nodes[0]) * nodes[1] + j % nodes[1]) * nodes[2] + k % nodes[2];
    };
    const int size = 3 * nodes[0] * nodes[1] * nodes[2];
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
    const double volume = step.prod(), gauss = 0.5 / std::sqrt(3.0);
    for (int i = 0; i < cells[0]; ++i)
        for (int j = 0; j < cells[1]; ++j)
            for (int k = 0; k < cells[2]; ++k)
                for (int point = 0; point < 8; ++point) {
                    double shape[8];
                    Vec3 slope[8];
                    int at[8];
                    for (int corner = 0; corner < 8; ++corner) {
                        Vec3 value, change;
                        for (int a = 0; a < 3; ++a) {
                            const double x = 0.5 + (point >> a & 1 ? gauss : -gauss);
                            const bool second = corner >> a & 1;
                            value[a] = second ? x : 1 - x;
                            change[a] = (second ? 1 : -1) / step[a];
                        }
                        shape[corner] = value.prod();
                        slope[corner] = toBox * Vec3(change[0] * value[1] * value[2], value[0] * change[1] * value[2],
                                                     value[0] * value[1] * change[2]);
                        at[corner] = number(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2 & 1));
                    }
                    for (int m = 0; m < 8; ++m)
                        for (int n = 0; n < 8; ++n) {
                            const Mat3 block = (inertia * shape[m] * shape[n] + viscosity * slope[m].dot(slope[n])) *
                                                   Mat3::Identity() +
                                               lambda * slope[m] * slope[n].transpose();
                            A.block<3, 3>(3 * at[m], 3 * at[n]) += volume / 8 * block;
                        }
                }
    return A;
}

void solvesTheFiniteElements(int wall) {
    particles::Box box{{-1, 2, 0.5}, {5, 10, 4.5}, {true, true, true}};  // 6 x 8 x 4
    if (wall >= 0) box.periodic[static_cast<std::size_t>(wall)] = false;
    CoarseGrid grid(box, 1.3);  // 5 x 6 x 3 intervals
    const std::array<int, 3> cells{5, 6, 3};
    const Vec3 step = box.size().cwiseQuotient(Vec3(5, 6, 3));
    std::array<int, 3> nodes = cells;
    if (wall >= 0) ++nodes[static_cast<std::size_t>(wall)];  // nodes at both walls
    Eigen::MatrixXd A = assemble(cells, nodes, step);

    // One particle at each free node, so that P is the unit matrix there.
    std::vector<int> freeNodes;
    std::vector<Vec3> places;
    for (int i = 0; i < nodes[0]; ++i)
        for (int j = 0; j < nodes[1]; ++j)
            for (int k = 0; k < nodes[2]; ++k) {
                const std::array<int, 3> at{i, j, k};
                const auto w = static_cast<std::size_t>(wall);
                if (wall >= 0 && (at[w] == 0 || at[w] == nodes[w] - 1)) continue;
                freeNodes.push_back((i * nodes[1] + j) * nodes[2] + k);
                places.push_back(box.low + step.cwiseProduct(Vec3(i, j, k)));
            }
    const auto n = freeNodes.size();
    grid.setCoefficients(inertia, viscosity, lambda);
    grid.begin(n);
    for (std::size_t i = 0; i < n; ++i) grid.place(i, places[i]);
    std::vector<double> r(4 * n, 0.0), z(4 * n, 0.0);
    for (std::size_t k = 0; k < r.size(); ++k)
        if (k % 4 != 3) r[k] = std::sin(1 + 3.7 * static_cast<double>(k * k));
    grid.add(MPI_COMM_SELF, r.data(), z.data());
    Eigen::VectorXd solution = Eigen::VectorXd::Zero(A.rows());
    for (std::size_t i = 0; i < n; ++i)
        for (int a = 0; a < 3; ++a) solution[3 * freeNodes[i] + a] = z[4 * i + static_cast<std::size_t>(a)];
    const Eigen::VectorXd image = A * solution;
    for (std::size_t i = 0; i < n; ++i)
        for (int a = 0; a < 3; ++a)
            ASSERT_NEAR(image[3 * freeNodes[i] + a], r[4 * i + static_cast<std::size_t>(a)], 1e-5)
                << "node " << i << " component " << a << " walls across " << wall;  // weights are float
}

TEST(CoarseGrid, solvesTheFiniteElementsWithoutWalls) { solvesTheFiniteElements(-1); }

TEST(CoarseGrid, solvesTheFiniteElementsBetweenWalls) {
    for (const int wall : {0, 1, 2}) solvesTheFiniteElements(wall);
}

// Elements are parallelepipeds: nodes lie on a grid in the oblique coordinates in which the box is periodic, each in
// one of its images.
TEST(CoarseGrid, solvesTheFiniteElementsWhereImagesSlide) {
    const particles::Box box{{-1, 2, 0.5}, {5, 10, 4.5}, {true, true, true}};
    const std::array<int, 3> cells{5, 6, 3};
    const Vec3 step = box.size().cwiseQuotient(Vec3(5, 6, 3));
    CoarseGrid grid(box, 1.3);
    for (const auto& [axis, offset] : {std::pair(2, Vec3(1.9, -3.1, 0)), {1, Vec3(-2.7, 0, 0)}, {2, Vec3(0, 0, 0)}}) {
        Periodicity period = box.periodicity();
        period.slide(axis, offset, Vec3::Zero());
        const Vec3 tilt = offset / box.size()[axis];
        Mat3 toBox = Mat3::Identity();
        toBox.row(axis) -= tilt.transpose();
        const Eigen::MatrixXd A = assemble(cells, cells, step, toBox);
        const auto n = static_cast<std::size_t>(A.rows() / 3);
        grid.setCoefficients(inertia, viscosity, lambda, period);
        grid.begin(n);
        std::vector<double> r(4 * n, 0.0), z(4 * n, 0.0);
        for (int i = 0; i < cells[0]; ++i)
            for (int j = 0; j < cells[1]; ++j)
                for (int k = 0; k < cells[2]; ++k) {
                    const auto node = static_cast<std::size_t>((i * cells[1] + j) * cells[2] + k);
                    const Vec3 xi = step.cwiseProduct(Vec3(i, j, k)), x = box.low + xi + xi[axis] * tilt;
                    const Index3 image{static_cast<int>(node % 3) - 1, static_cast<int>(node % 2), 1 - i % 2};
                    grid.place(node, x + period.image(image).shift);
                }
        for (std::size_t k = 0; k < r.size(); ++k)
            if (k % 4 != 3) r[k] = std::sin(1 + 3.7 * static_cast<double>(k * k));
        grid.add(MPI_COMM_SELF, r.data(), z.data());
        Eigen::VectorXd solution(A.rows());
        for (Eigen::Index k = 0; k < A.rows(); ++k) solution[k] = z[static_cast<std::size_t>(4 * (k / 3) + k % 3)];
        const Eigen::VectorXd image = A * solution;
        for (Eigen::Index k = 0; k < A.rows(); ++k)
            ASSERT_NEAR(image[k], r[static_cast<std::size_t>(4 * (k / 3) + k % 3)], 1e-5) << "row " << k;
    }
}

// For particles between nodes too, P and its transpose are consistent; new coefficients take effect.
TEST(CoarseGrid, isSymmetricAndPositiveForParticlesAnywhere) {
    const particles::Box box{{0, 0, 0}, {6, 8, 4}, {true, true, false}};
    CoarseGrid grid(box, 1.3);
    constexpr std::size_t n = 200;
    for (const double bulk : {9.0, 0.0}) {
        grid.setCoefficients(inertia, viscosity, bulk);
        grid.begin(n);
        std::vector<double> r[2], z[2];
        for (int k = 0; k < 2; ++k) r[k].assign(4 * n, 0.0), z[k].assign(4 * n, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            const auto x = static_cast<double>(i);
            grid.place(i, Vec3(std::fmod(1.7 * x, 6.0), std::fmod(2.9 * x, 8.0), std::fmod(0.73 * x, 4.0)));
            for (std::size_t a = 0; a < 3; ++a)
                r[0][4 * i + a] = std::sin(5 * x + static_cast<double>(a)),
                             r[1][4 * i + a] = std::cos(x * x + 2.0 * static_cast<double>(a));
        }
        double dot[2][2] = {};
        for (int k = 0; k < 2; ++k) grid.add(MPI_COMM_SELF, r[k].data(), z[k].data());
        for (int k = 0; k < 2; ++k)
            for (int m = 0; m < 2; ++m)
                for (std::size_t i = 0; i < 4 * n; ++i) dot[k][m] += r[k][i] * z[m][i];
        EXPECT_NEAR(dot[0][1], dot[1][0], 1e-12 * std::sqrt(dot[0][0] * dot[1][1]));
        EXPECT_GT(dot[0][0] * dot[1][1], dot[0][1] * dot[0][1]);
        EXPECT_GT(dot[0][0], 0);
    }
}

// For forces on particles near some planes of the grid only, the solution restricted to these planes equals that on the
// whole grid, wherever the planes lie, also after coefficients have changed.
void someOfTheParticles(int wall) {
    particles::Box box{{0, 0, 0}, {9, 10, 11}, {true, true, true}};
    if (wall >= 0) box.periodic[static_cast<std::size_t>(wall)] = false;
    const auto axis = static_cast<std::size_t>(std::max(wall, 0));
    CoarseGrid grid(box, 1.3);
    constexpr std::size_t n = 400;
    for (const double viscosity : {1.3, 40.0})
        for (const double middle : {0.4, 3.9, 5.2, 8.5}) {
            grid.setCoefficients(inertia, viscosity, lambda);
            grid.begin(n);
            std::vector<int> some;
            std::vector<double> r(4 * n, 0.0);
            for (std::size_t i = 0; i < n; ++i) {
                const auto x = static_cast<double>(i);
                const Vec3 place(std::fmod(1.7 * x, 9.0), std::fmod(2.9 * x, 10.0), std::fmod(0.73 * x, 11.0));
                grid.place(i, place);
                if (std::abs(place[static_cast<Eigen::Index>(axis)] - middle) > 0.9) continue;
                some.push_back(static_cast<int>(i));
                for (std::size_t a = 0; a < 3; ++a) r[4 * i + a] = std::sin(5 * x + static_cast<double>(a));
            }
            ASSERT_GT(some.size(), 20U);
            std::vector<double> whole(4 * n, 0.0), part(4 * n, 0.0);
            grid.add(MPI_COMM_SELF, r.data(), whole.data());
            const CoarseGrid::Planes planes = grid.planesOf(MPI_COMM_SELF, some);
            EXPECT_TRUE(wall < 0 || planes.last - planes.first < 4);
            grid.gather(r.data(), some, planes);
            grid.solve(MPI_COMM_SELF, planes);
            grid.spread(part.data(), some, planes);
            double largest = 0;
            for (const double value : whole) largest = std::max(largest, std::abs(value));
            for (const int i : some)
                for (std::size_t a = 0; a < 3; ++a)
                    ASSERT_NEAR(part[4 * static_cast<std::size_t>(i) + a], whole[4 * static_cast<std::size_t>(i) + a],
                                1e-12 * largest)
                        << "particle " << i << " walls across " << wall << " around " << middle;
        }
}

TEST(CoarseGrid, planesOfSomeParticlesAreEnoughForThem) {
    for (const int wall : {-1, 0, 1, 2}) someOfTheParticles(wall);
}

}  // namespace
