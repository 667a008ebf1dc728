#include "coupling/soluteTransport.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/communicator.hpp"
#include "core/error.hpp"
#include "coupling/nodeBasis.hpp"
#include "coupling/nodeImages.hpp"
#include "membrane/diagnostics.hpp"

namespace corpuscle::coupling {

using particles::Kind;
using particles::ParticleStore;
using particles::ParticleSystem;

namespace {

constexpr std::size_t width = 4;     // sums of a node
constexpr double largestPart = 0.5;  // of what a particle has, passed on at once
constexpr long mostParts = 10000;    // of a step
constexpr double layer = 0.45;       // k

// passed: largest part of what a particle has that it would pass on in the step, which may be more than all of it.
long partsOf(double passed) {
    const double parts = std::ceil(passed / largestPart);
    if (!(parts <= mostParts))
        throw Failure(
            ExitCode::numerics,
            fmt::format(
                "a step would take {:.3g} parts for the solute, at most {} are allowed: 'solute.diffusivity' in "
                "constant/fluid.yaml is too large for the spacing and the step, or membranes are unstable",
                parts, mostParts));
    return std::max(1L, std::lround(parts));
}

bool hasOpenPores(const Cell& cell) {
    const std::vector<double>& pores = cell.membrane.pores();
    return std::any_of(pores.begin(), pores.end(), [](double share) { return share > 0; });
}

}  // namespace

SoluteTransport::SoluteTransport(const sph::FluidModel& model, const ParticleSystem& system)
    : solute_(*model.solute),
      mass_(model.mass),
      density_(model.density),
      viscosity_(model.viscosity),
      radius_(radiusInSpacings * system.spacing()),
      diffusion_(model, system) {}

void SoluteTransport::arrive(Cells& cells) {
    for (Cell& cell : cells) cell.membrane.openPores(rest_);
}

void SoluteTransport::advance(Cells& cells, ParticleSystem& system, double dt, double rest) {
    const Communicator ranks(system.comm());
    ParticleStore& s = system.store();
    bool open = false;
    rest_ = rest;
    for (Cell& cell : cells) {
        cell.membrane.openPores(dt - rest);
        open = open || hasOpenPores(cell);
    }
    isOpen_ = cells.havePores() && ranks.anyTrue(open);
    if (!isOpen_ && solute_.diffusivity == 0) return;
    nodes_.clear(), near_.clear();
    if (isOpen_) findNodes(cells, system);
    concentrations_.resize(s.size());
    long parts = 1;
    for (long part = 0; part < parts; ++part) {
        for (std::size_t i = 0; i < s.size(); ++i)
            concentrations_[i] = s.kindOf(i) == Kind::fluid ? concentration(s, i) : 0;
        rates_.assign(s.size(), 0.0), speeds_.assign(s.size(), 0.0);
        if (solute_.diffusivity > 0) {
            diffusion_.find(system, concentrations_);
            rates_ = diffusion_.rates(), speeds_ = diffusion_.speeds();
        }
        if (isOpen_) findPassage(s);
        if (part == 0) parts = partsOf(ranks.max(largestSpeed()) * dt);
        const double seconds = dt / static_cast<double>(parts);
        for (std::size_t i = 0; i < s.size(); ++i) s.solute[i] += seconds * rates_[i];
    }
    mostParts_ = std::max(mostParts_, parts);
}

// Infinite if a speed is not a number, so that all ranks see it.
double SoluteTransport::largestSpeed() const {
    double largest = 0;
    for (const double speed : speeds_)
        largest = std::isnan(speed) ? std::numeric_limits<double>::infinity() : std::max(largest, speed);
    return largest;
}

// The nodes with open pores, with the particles around them and their speeds of passage.
void SoluteTransport::findNodes(const Cells& cells, const ParticleSystem& system) {
    const ParticleStore& s = system.store();
    const double reach = radius_ + 0.5 * system.skin();  // the search uses positions at the time of the last list build
    const membrane::PoreSolute solute{solute_.radius, solute_.diffusivity, viscosity_};
    rows_ = 0;
    for (const Cell& cell : cells) {
        const membrane::Membrane& m = cell.membrane;
        const std::size_t first = rows_;
        rows_ += m.position.size();
        if (!hasOpenPores(cell)) continue;
        std::vector<Vec3> force(m.position.size(), Vec3::Zero());
        m.addElasticForces(m.position, force);
        const std::vector<double> areas = m.vertexAreas(),
                                  pressure = membrane::heldPressures(m.network(), m.position, force);
        for (std::size_t n = 0; n < m.position.size(); ++n) {
            if (m.pores()[n] <= 0) continue;
            const membrane::PoreFlux flux = m.laws().pores->flux(m.pores()[n], pressure[n], solute);
            const double diffusive = 2 * std::min(flux.outward, flux.inward);
            const double area =
                diffusive > 0 ? areas[n] / (1 + layer * system.spacing() * diffusive / solute_.diffusivity) : areas[n];
            Node node{first + n, near_.size(), 0, area * flux.outward, area * flux.inward};
            forImages(system, m.position[n], reach, [&](const Vec3& image) {
                system.forOwnedNear(image, reach, [&](int i) {
                    const auto k = static_cast<std::size_t>(i);
                    const bool inside = s.side[k] == m.cell;
                    if (s.kindOf(k) != Kind::fluid || (!inside && s.side[k] != 0)) return;
                    const double r = (s.position(k) - image).norm() / radius_;
                    if (r < 1) near_.push_back({i, NodeBasis::weight(r), inside});
                });
            });
            node.last = near_.size();
            nodes_.push_back(node);
        }
    }
    std::vector<char> isMine(rows_, 0);
    for (const Node& node : nodes_) isMine[node.row] = node.last > node.first;
    holders_.plan(
        cells, system.comm(), [](const Cell& cell) { return cell.nodeCount(); }, isMine);
}

// Adds the passage through the pores to rates_ and speeds_.
void SoluteTransport::findPassage(const ParticleStore& s) {
    sums_.assign(width * rows_, 0.0);
    const auto forNear = [&](const Node& node, auto&& f) {
        for (std::size_t k = node.first; k < node.last; ++k)
            f(near_[k], static_cast<std::size_t>(near_[k].particle), sums_.data() + width * node.row);
    };
    for (const Node& node : nodes_)
        forNear(node, [&](const Near& near, std::size_t i, double* sum) {
            sum += near.inside ? 0 : 2;
            sum[0] += near.weight * volume(s, i);
            sum[1] += near.weight * s.solute[i];
        });
    holders_.addUp(sums_, width);
    for (const Node& node : nodes_)
        forNear(node, [&](const Near& near, std::size_t i, const double* sum) {
            if (sum[0] <= 0 || sum[2] <= 0) return;
            const double given = near.inside ? node.outward / sum[0] : node.inward / sum[2];
            const double received =
                near.inside ? node.inward * sum[3] / sum[2] / sum[0] : node.outward * sum[1] / sum[0] / sum[2];
            rates_[i] += near.weight * (received * volume(s, i) - given * s.solute[i]);
            speeds_[i] += near.weight * given;
        });
}

}  // namespace corpuscle::coupling
