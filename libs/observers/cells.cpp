#include "observers/cells.hpp"

#include <algorithm>

#include "core/communicator.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::observers {

using coupling::Cell;
using coupling::Scene;

std::vector<std::vector<double>> ofEachCell(const Scene& scene, std::size_t count,
                                            const std::function<void(const Cell&, double* out)>& work) {
    const Communicator ranks(scene.system->comm());
    std::vector<double> all(count * scene.cells.count(), 0.0);  // the sum adds zeros to each number, which is exact
    for (const Cell& cell : scene.cells)
        if (cell.isOwnedBy(ranks.rank()))
            work(cell, all.data() + count * (static_cast<std::size_t>(cell.membrane.cell) - 1));
    all = ranks.sum(std::move(all));
    std::vector<std::vector<double>> result;
    result.reserve(scene.cells.count());
    for (std::size_t c = 0; c < scene.cells.count(); ++c)
        result.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(c * count),
                            all.begin() + static_cast<std::ptrdiff_t>((c + 1) * count));
    return result;
}

std::vector<Row> rowsByType(const Scene& scene, std::size_t first, const std::vector<std::vector<double>>& ofCells) {
    std::vector<Row> rows;
    rows.reserve(ofCells.size());
    for (std::size_t c = 0; c < ofCells.size(); ++c) {
        const int number = static_cast<int>(c) + 1;
        Row& row = rows.emplace_back(Row{first + scene.cells.typeOf(number), {static_cast<double>(number)}});
        row.values.insert(row.values.end(), ofCells[c].begin(), ofCells[c].end());
    }
    return rows;
}

std::vector<io::Column> cellTable(std::vector<io::Column> columns) {
    columns.insert(columns.begin(), {"cell", "", "number of the cell, 1 and up, through all types"});
    return columns;
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

TrueSides::TrueSides(const Scene& scene) : scene_(scene), period_(scene.system->periodicity()) {
    std::vector<geometry::Bounds> bounds(scene.cells.heldCount());
    surfaces_.resize(bounds.size());
    for (std::size_t c = 0; c < bounds.size(); ++c) {
        const geometry::TriangleMesh mesh = closedSurface(scene.cells[c]);
        if (mesh.nodes.empty()) continue;
        surfaces_[c].emplace(mesh);
        bounds[c] = geometry::boundsOf(mesh.nodes);
    }
    const particles::Box& box = scene.system->box();
    index_ = geometry::BoundsIndex(bounds, box.low, box.high, period_);
}

bool TrueSides::isInHeld(std::size_t index, const Vec3& x) const {
    return surfaces_[index] && surfaces_[index]->inside(x, period_);
}

bool TrueSides::inside(int cell, const Vec3& x) const {
    const std::size_t index = scene_.cells.indexOf(cell);
    return index != coupling::Cells::notHeld && isInHeld(index, x);
}

int TrueSides::side(const Vec3& x) const {
    for (const int c : index_.near(x))
        if (isInHeld(static_cast<std::size_t>(c), x)) return scene_.cells[static_cast<std::size_t>(c)].membrane.cell;
    return 0;
}

}  // namespace corpuscle::observers
