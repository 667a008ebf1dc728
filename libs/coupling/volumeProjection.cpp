#include "coupling/volumeProjection.hpp"

#include <algorithm>

#include "membrane/surface.hpp"

namespace corpuscle::coupling {

void VolumeProjection::place(const Cells& cells, const NodeLayout& layout) {
    layout_ = layout;
    gradient_.assign(layout.nodes(), Vec3::Zero());
    for (std::size_t c = 0; c < layout.cells(); ++c) {
        const membrane::Membrane& m = cells[c].membrane;
        if (m.network().isOpen()) continue;
        const NodeVectors g = membrane::volumeGradient(m.position, m.network().triangles());
        std::copy(g.begin(), g.end(), layout.of(c, gradient_).begin());
    }
}

void VolumeProjection::apply(NodeVectors& v) const {
    for (std::size_t c = 0; c < layout_.cells(); ++c) {
        double dot = 0, square = 0;
        for (std::size_t n = layout_.first(c); n < layout_.last(c); ++n)
            dot += gradient_[n].dot(v[n]), square += gradient_[n].squaredNorm();
        if (square == 0) continue;
        for (std::size_t n = layout_.first(c); n < layout_.last(c); ++n) v[n] -= dot / square * gradient_[n];
    }
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
