#include "coupling/volumeProjection.hpp"

#include <algorithm>

#include "membrane/surface.hpp"

namespace corpuscle::coupling {

void VolumeProjection::place(const Cells& cells, const NodeLayout& layout) {
    layout_ = layout;
    gradient_.assign(layout.nodes(), Vec3::Zero());
    isClosed_.assign(layout.cells(), 0);
    torn_.clear();
    for (std::size_t c = 0; c < layout.cells(); ++c) {
        const membrane::Membrane& m = cells[c].membrane;
        if (m.network().isTorn()) placeTorn(cells[c], c);
        if (m.network().isOpen()) continue;
        isClosed_[c] = 1;
        const NodeVectors g = membrane::volumeGradient(m.position, m.network().triangles());
        std::copy(g.begin(), g.end(), layout.of(c, gradient_).begin());
    }
}

void VolumeProjection::placeTorn(const Cell& cell, std::size_t index) {
    const membrane::Network& network = cell.membrane.network();
    const std::size_t first = layout_.first(index), before = torn_.size();
    for (const int t : network.wholeTriangles()) {
        const Index3& triangle = network.triangles()[static_cast<std::size_t>(t)];
        const Vec3 third = membrane::areaVector(cell.membrane.position, triangle) / 3;
        for (const int node : triangle) gradient_[first + static_cast<std::size_t>(node)] += third;
    }
    const std::vector<int> sheets = network.sheetOfNodes();
    const auto sheetOf = [&](std::size_t node) -> TornSheet& {
        return torn_[before + static_cast<std::size_t>(sheets[node])];
    };
    torn_.resize(before + static_cast<std::size_t>(1 + *std::max_element(sheets.begin(), sheets.end())));
    for (std::size_t n = 0; n < sheets.size(); ++n) {
        if (sheets[n] < 0) continue;
        TornSheet& sheet = sheetOf(n);
        sheet.cell = index;
        sheet.nodes.push_back(first + n);
        sheet.square += gradient_[first + n].squaredNorm();
    }
    for (std::vector<int>& rim : network.rims()) {
        const auto at = static_cast<std::size_t>(rim.front());
        sheetOf(at).rims.push_back(std::move(rim));
    }
}

void VolumeProjection::apply(NodeVectors& v) const {
    for (std::size_t c = 0; c < layout_.cells(); ++c) {
        if (!isClosed_[c]) continue;
        double dot = 0, square = 0;
        for (std::size_t n = layout_.first(c); n < layout_.last(c); ++n)
            dot += gradient_[n].dot(v[n]), square += gradient_[n].squaredNorm();
        if (square == 0) continue;
        for (std::size_t n = layout_.first(c); n < layout_.last(c); ++n) v[n] -= dot / square * gradient_[n];
    }
}

void VolumeProjection::apply(NodeVectors& v, std::span<const double> flux) const {
    apply(v);
    for (std::size_t k = 0; k < torn_.size(); ++k) {
        const TornSheet& sheet = torn_[k];
        if (sheet.square == 0) continue;
        double sum = flux[k];
        for (const std::size_t n : sheet.nodes) sum += gradient_[n].dot(v[n]);
        for (const std::size_t n : sheet.nodes) v[n] -= sum / sheet.square * gradient_[n];
    }
}

std::vector<double> VolumeProjection::applyToForces(NodeVectors& f) const {
    apply(f);
    std::vector<double> pressures;
    for (const TornSheet& sheet : torn_) {
        double sum = 0;
        for (const std::size_t n : sheet.nodes) sum += gradient_[n].dot(f[n]);
        pressures.push_back(sheet.square > 0 ? -sum / sheet.square : 0);
        for (const std::size_t n : sheet.nodes) f[n] += pressures.back() * gradient_[n];
    }
    return pressures;
}

void VolumeProjection::restore(Cells& cells) {
    for (Cell& cell : cells) {
        membrane::Membrane& m = cell.membrane;
        if (m.network().isOpen()) continue;
        const NodeVectors g = membrane::volumeGradient(m.position, m.network().triangles());
        double square = 0;
        for (const Vec3& a : g) square += a.squaredNorm();
        const double missing = cell.initialVolume - m.volume();
        for (std::size_t n = 0; n < g.size(); ++n) m.position[n] += missing / square * g[n];
    }
}

}  // namespace corpuscle::coupling
