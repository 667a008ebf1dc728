#include "coupling/membraneStiffness.hpp"

#include "core/communicator.hpp"

namespace corpuscle::coupling {

void MembraneStiffness::build(const Cells& cells, const NodeLayout& layout) {
    cells_ = &cells;
    layout_ = layout;
    number_.resize(layout.cells(), 0);
    const membrane::BlockStiffness none(0);
    stiffness_.resize(layout.cells(), none), damping_.resize(layout.cells(), none);
    for (std::size_t c = 0; c < layout.cells(); ++c) {
        const membrane::Membrane& m = cells[c].membrane;
        if (number_[c] == m.cell) {
            stiffness_[c].clear(), damping_[c].clear();
        } else {
            stiffness_[c] = membrane::BlockStiffness(m.position.size());
            damping_[c] = membrane::BlockStiffness(m.isViscous() ? m.position.size() : 0);
            number_[c] = m.cell;
        }
        m.addStiffness(membrane::Definiteness::partwise, stiffness_[c]);
        m.addDamping(damping_[c]);
    }
}

void MembraneStiffness::addStiffness(double factor, const NodeVectors& u, NodeVectors& f) const {
    for (std::size_t c = 0; c < layout_.cells(); ++c)
        stiffness_[c].addProduct(factor, layout_.of(c, u), layout_.of(c, f));
}

void MembraneStiffness::addDamping(const NodeVectors& u, NodeVectors& f) const {
    for (std::size_t c = 0; c < layout_.cells(); ++c)
        if ((*cells_)[c].membrane.isViscous()) damping_[c].addProduct(-1, layout_.of(c, u), layout_.of(c, f));
}

double MembraneStiffness::meanResistance(double time, MPI_Comm comm) const {
    const Communicator ranks(comm);
    double trace = 0;
    for (std::size_t c = 0; c < layout_.cells(); ++c) {
        if (!(*cells_)[c].isOwnedBy(ranks.rank())) continue;
        for (std::size_t m = 0; m < layout_.last(c) - layout_.first(c); ++m) {
            trace += time * stiffness_[c].diagonal(m).trace();
            if ((*cells_)[c].membrane.isViscous()) trace += damping_[c].diagonal(m).trace();
        }
    }
    return ranks.sum(trace) / (3.0 * static_cast<double>(cells_->nodeCount()));
}

void MembraneStiffness::addViscousForces(const Cells& cells, const NodeLayout& layout, const NodeVectors& u,
                                         NodeVectors& f) {
    for (std::size_t c = 0; c < layout.cells(); ++c)
        if (cells[c].membrane.isViscous()) cells[c].membrane.addViscousForces(layout.of(c, u), layout.of(c, f));
}

NodeVectors MembraneStiffness::forceAt(const Cells& cells, const NodeLayout& layout, const NodeVectors& displacement) {
    NodeVectors f(layout.nodes(), Vec3::Zero());
    for (std::size_t c = 0; c < layout.cells(); ++c) {
        NodeVectors x = cells[c].membrane.position;
        for (std::size_t n = 0; n < x.size(); ++n) x[n] += displacement[layout.first(c) + n];
        cells[c].membrane.addElasticForces(x, layout.of(c, f));
    }
    return f;
}

}  // namespace corpuscle::coupling
