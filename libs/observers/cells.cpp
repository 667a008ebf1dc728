#include "observers/cells.hpp"

#include <algorithm>

#include "core/communicator.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::observers {

using coupling::Cell;
using coupling::Scene;

std::vector<int> sourceRanks(const Scene& scene) {
    const Communicator ranks(scene.system->comm());
    std::vector<double> lowest;
    for (const Cell& cell : scene.cells) lowest.push_back(cell.held ? ranks.rank() : ranks.size());
    std::vector<int> sources;
    for (const double rank : ranks.min(std::move(lowest))) sources.push_back(static_cast<int>(rank));
    return sources;
}

std::vector<std::vector<double>> ofEachCell(const Scene& scene, std::size_t count,
                                            const std::function<void(const Cell&, std::size_t, double* out)>& work) {
    const Communicator ranks(scene.system->comm());
    const std::vector<int> sources = sourceRanks(scene);
    std::vector<double> all(count * scene.cells.size(), 0.0);  // the sum adds zeros to each number: exact
    for (std::size_t c = 0; c < scene.cells.size(); ++c)
        if (sources[c] == ranks.rank()) work(scene.cells[c], c, all.data() + c * count);
    all = ranks.sum(std::move(all));
    std::vector<std::vector<double>> result;
    for (std::size_t c = 0; c < scene.cells.size(); ++c)
        result.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(c * count),
                            all.begin() + static_cast<std::ptrdiff_t>((c + 1) * count));
    return result;
}

std::vector<double> gatherNumbers(const Scene& scene, const std::vector<double>& own) {
    const Communicator ranks(scene.system->comm());
    std::vector<int> lengths, starts;
    int total = 0;
    for (const long length : ranks.gatherAll(static_cast<long>(own.size()))) {
        lengths.push_back(static_cast<int>(length));
        starts.push_back(total);
        total += lengths.back();
    }
    std::vector<double> all(static_cast<std::size_t>(total));
    MPI_Allgatherv(own.data(), static_cast<int>(own.size()), MPI_DOUBLE, all.data(), lengths.data(), starts.data(),
                   MPI_DOUBLE, ranks.handle());
    return all;
}

geometry::TriangleMesh closedSurface(const Cell& cell) {
    const membrane::Network& network = cell.membrane.network();
    const std::vector<Vec3>& x = cell.membrane.position;
    if (network.brokenTriangles() == 0) return {x, network.triangles()};
    geometry::TriangleMesh mesh;
    std::vector<int> number(x.size(), -1);
    const auto node = [&](int n) {
        if (number[n] < 0) {
            number[n] = static_cast<int>(mesh.nodes.size());
            mesh.nodes.push_back(x[n]);
        }
        return number[n];
    };
    for (const int t : network.wholeTriangles()) {
        const Index3& corner = network.triangles()[t];
        mesh.triangles.push_back({node(corner[0]), node(corner[1]), node(corner[2])});
    }
    for (const std::vector<int>& rim : network.rims()) {
        const int mean = static_cast<int>(mesh.nodes.size());
        mesh.nodes.push_back(membrane::meanPoint(x, rim));
        for (std::size_t k = 0; k < rim.size(); ++k)
            mesh.triangles.push_back({mean, node(rim[(k + 1) % rim.size()]), node(rim[k])});
    }
    return mesh;
}

TrueSides::TrueSides(const Scene& scene)
    : scene_(scene), period_(scene.system->periodicity()), surfaces_(scene.cells.size()) {
    for (std::size_t c = 0; c < scene.cells.size(); ++c) {
        if (!scene.cells[c].held) continue;
        const geometry::TriangleMesh mesh = closedSurface(scene.cells[c]);
        if (mesh.nodes.empty()) continue;
        surfaces_[c].emplace(mesh);
    }
}

bool TrueSides::inside(std::size_t cell, const Vec3& x) const {
    return surfaces_[cell] && surfaces_[cell]->inside(x, period_);
}

int TrueSides::side(const Vec3& x) const {
    for (std::size_t c = 0; c < surfaces_.size(); ++c)
        if (inside(c, x)) return scene_.cells[c].membrane.cell;
    return 0;
}

}  // namespace corpuscle::observers
