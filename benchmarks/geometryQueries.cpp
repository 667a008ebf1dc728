// Costs of the geometric queries on a red cell's mesh: rebuilding the grid, nearest point within and beyond its reach,
// inside test.
//
//     geometryQueries [EDGE_UM]      edge of the mesh, 0.25 by default
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

#include "geometry/insideTest.hpp"
#include "geometry/kuchelFackerell.hpp"
#include "geometry/mesher.hpp"
#include "geometry/triangleTree.hpp"

using namespace corpuscle;
using namespace corpuscle::geometry;

namespace {

// Least of five times, per item [s].
template <class Work>
double secondsPerItem(std::size_t items, Work&& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 5; ++k) {
        const auto begin = std::chrono::steady_clock::now();
        work();
        least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return least / static_cast<double>(items);
}

}  // namespace

int main(int argc, char* argv[]) {
    const double edge = (argc > 1 ? std::atof(argv[1]) : 0.25) * 1e-6, reach = 2 * edge;
    const TriangleMesh mesh = meshSurface(KuchelFackerell(8e-6, 2.12e-6, 1e-6), edge);
    TriangleTree grid(mesh, reach);
    const InsideTest test(mesh);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-6e-6, 6e-6);
    std::vector<Vec3> near, far;
    for (int n = 0; n < 100000; ++n) {
        const Vec3 x(uniform(random), uniform(random), uniform(random));
        (grid.nearest(x) ? near : far).push_back(x);
    }

    double sum = 0;  // printed, so that nothing is optimised away
    const auto distances = [&](const std::vector<Vec3>& points) {
        for (const Vec3& x : points)
            if (const SurfacePoint p = grid.nearest(x)) sum += p.distance;
    };
    const double rebuild = secondsPerItem(1, [&] { grid.update(mesh.nodes); });
    const double within = secondsPerItem(near.size(), [&] { distances(near); });
    const double beyond = secondsPerItem(far.size(), [&] { distances(far); });
    const double inside = secondsPerItem(near.size(), [&] {
        for (const Vec3& x : near) sum += test.inside(x) ? edge : 0;
    });
    std::printf("%zu triangles, reach %.2f um, %zu points within, %zu beyond (check %.6g)\n", mesh.triangles.size(),
                reach * 1e6, near.size(), far.size(), sum);
    std::printf("rebuild of the grid          %8.2f ms\n", rebuild * 1e3);
    std::printf("nearest point, within reach  %8.0f ns\n", within * 1e9);
    std::printf("nearest point, beyond        %8.0f ns\n", beyond * 1e9);
    std::printf("inside test                  %8.0f ns\n", inside * 1e9);
}
