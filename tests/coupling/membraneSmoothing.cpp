#include "coupling/membraneSmoothing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/sphereScene.hpp"
#include "membrane/surface.hpp"

namespace {

using namespace corpuscle;
using namespace corpuscle::coupling;
using coupling::testing::SphereScene;

// M u, and the weighted mean of squares, at all nodes of the first cell of a scene at these positions.
struct Found {
    NodeVectors mean;
    std::vector<double> square;
};
Found meanAt(SphereScene& scene, const std::vector<Vec3>& x, const NodeVectors& u) {
    Cell& cell = scene.cells[0];
    cell.membrane.position = x;
    const NodeLayout layout(scene.cells);
    MembraneSmoothing smoothing(1);
    smoothing.place(scene.cells, layout, membrane::volumeGradient(x, cell.membrane.network().triangles()));
    Found found{u, {}};
    smoothing.apply(found.mean);
    for (std::size_t m = 0; m < x.size(); ++m) found.square.push_back(smoothing.square(m));
    return found;
}

}  // namespace

// The two sheets of a ball that is pressed flat are neighbours through space, and along the membrane only around the
// rim. As the ball flattens, nodes near the rim reach further and further around it, one after the other, and none of
// them enters the mean by a jump.
TEST(MembraneSmoothing, isContinuousInFoldedMembranes) {
    SphereScene scene({14, 12, 12}, {Vec3(7, 6, 6)}, false);
    const std::vector<Vec3> round = scene.cells[0].membrane.position;
    const Vec3 middle(7, 6, 6);
    NodeVectors u(round.size(), Vec3::Zero());
    membrane::testing::jitter(u, 1, 7);
    constexpr int positions = 500;
    Found before;
    double ofMean = 0, ofSquare = 0, whole = 0;
    for (int k = 0; k < positions; ++k) {
        const double height = 0.3 - 0.28 * k / positions;
        std::vector<Vec3> x = round;
        for (Vec3& at : x) at[2] = middle[2] + height * (at[2] - middle[2]);
        const Found now = meanAt(scene, x, u);
        for (std::size_t m = 0; k > 0 && m < u.size(); ++m) {
            ofMean = std::max(ofMean, (now.mean[m] - before.mean[m]).norm());
            ofSquare = std::max(ofSquare, std::abs(now.square[m] - before.square[m]));
        }
        if (k > 0) whole += std::abs(now.square[0] - before.square[0]);
        before = now;
    }
    EXPECT_GT(whole, 0.01);
    EXPECT_LT(ofMean, 0.005);
    EXPECT_LT(ofSquare, 0.003);
}
