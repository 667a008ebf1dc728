#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/mesher.hpp"

namespace corpuscle::geometry {

MeshQuality meshQuality(const TriangleMesh& mesh, const Shape* shape) {
    MeshQuality q;
    const std::vector<MeshEdge> edges = mesh.edges();
    q.nodes = static_cast<int>(mesh.nodes.size());
    q.triangles = static_cast<int>(mesh.triangles.size());
    q.edges = static_cast<int>(edges.size());
    q.euler = q.nodes - q.edges + q.triangles;
    q.closed = checkClosedManifold(mesh).empty();

    std::vector<int> around(mesh.nodes.size(), 0);
    q.edgeMin = std::numeric_limits<double>::infinity();
    for (const MeshEdge& e : edges) {
        const double l = (mesh.nodes[e.a] - mesh.nodes[e.b]).norm();
        q.edgeMin = std::min(q.edgeMin, l);
        q.edgeMax = std::max(q.edgeMax, l);
        q.edgeMean += l / q.edges;
        ++around[e.a];
        ++around[e.b];
    }
    q.valence.assign(around.empty() ? 0 : *std::max_element(around.begin(), around.end()) + 1, 0);
    for (int n : around) ++q.valence[n];

    q.angleMin = 180;
    for (const Index3& t : mesh.triangles)
        for (int s = 0; s < 3; ++s) {
            const double degrees =
                cornerAngle(mesh.nodes[t[s]], mesh.nodes[t[(s + 1) % 3]], mesh.nodes[t[(s + 2) % 3]]) * 180 /
                std::numbers::pi;
            q.angleMin = std::min(q.angleMin, degrees);
            q.angleMax = std::max(q.angleMax, degrees);
        }

    q.area = mesh.area();
    q.volume = mesh.volume();
    if (shape) {
        q.exactArea = shape->area();
        q.exactVolume = shape->volume();
        q.areaError = q.area / q.exactArea - 1;
        q.volumeError = q.volume / q.exactVolume - 1;
        for (const Vec3& x : mesh.nodes)
            q.residual =
                std::max(q.residual, std::abs(shape->implicit(x)) / shape->gradient(x).norm() / shape->radius());
    }
    return q;
}

std::string MeshQuality::text() const {
    std::string valences;
    for (std::size_t n = 0; n < valence.size(); ++n)
        if (valence[n] > 0) valences += fmt::format("{}{}: {}", valences.empty() ? "" : ", ", n, valence[n]);
    std::string s =
        fmt::format("nodes, edges, triangles   {}, {}, {} (Euler characteristic {})\n", nodes, edges, triangles, euler);
    s += fmt::format("closed, sound             {}\n", closed ? "yes" : "no");
    s += fmt::format("edge, least/mean/most     {:.4g} / {:.4g} / {:.4g} um\n", edgeMin * 1e6, edgeMean * 1e6,
                     edgeMax * 1e6);
    s += fmt::format("angle, least/most         {:.1f} / {:.1f} degrees\n", angleMin, angleMax);
    s += fmt::format("edges at a node: nodes    {}\n", valences);
    s += fmt::format("area                      {:.6g} um^2", area * 1e12);
    if (exactArea > 0) s += fmt::format(" ({:+.3g} % of {:.6g})", areaError * 100, exactArea * 1e12);
    s += fmt::format("\nvolume                    {:.6g} fL", volume * 1e18);
    if (exactVolume > 0)
        s += fmt::format(" ({:+.3g} % of {:.6g})\ndistance to the surface   {:.2g} radii at most", volumeError * 100,
                         exactVolume * 1e18, residual);
    return s + "\n";
}

}  // namespace corpuscle::geometry
