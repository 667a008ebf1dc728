#include "sph/rkl2.hpp"

#include <algorithm>
#include <limits>

namespace corpuscle::sph {

using particles::ParticleStore;
using particles::ParticleSystem;
using particles::RealArray;

const Schema<Rkl2Settings>& Rkl2Settings::schema() {
    static const Schema<Rkl2Settings> s =
        Schema<Rkl2Settings>("rkl2", "super-time-stepping of viscosity; its step is set by sound and by accuracy")
            .integer("stages", &Rkl2Settings::stages, "evaluations of viscosity in a step, at most; an odd number",
                     {.fallback = "31", .range = between(3, 99)})
            .quantity("resolution", &Rkl2Settings::resolution, unit::none,
                      "steps, at least, in the time that a flow from rest has taken, or a decaying one takes to change",
                      {.fallback = "40", .range = between(1, 1e4)})
            .check([](const Rkl2Settings& r, const Node& node, Problems& problems) {
                if (r.stages % 2 == 1) return;
                if (const Node* given = node.find("stages"))
                    problems.add(given->mark, given->path,
                                 "found " + std::to_string(r.stages) +
                                     ", an even number, which leaves the stiffest modes undamped; nearest that fit: " +
                                     std::to_string(r.stages - 1) + ", " + std::to_string(r.stages + 1));
            });
    return s;
}

double Rkl2Settings::accurateStep(const FlowState& flow, double t, double lambda) const {
    const double drive = flow.drive ? flow.drive->changesIn() / resolution : std::numeric_limits<double>::infinity();
    if (flow.transient == 0) return drive;
    if (flow.settles) return std::min(drive, std::max(2 / lambda, t / resolution));
    return std::min(drive, flow.transient / resolution);
}

void Rkl2Settings::addLimits(const FlowState& flow, double t, double lambda, StepLimits& limits) const {
    if (lambda <= 0) return;
    limits.add("viscous, " + std::to_string(stages) + " stages",
               LegendreStages::reach(static_cast<int>(stages)) / lambda);
    if (flow.transient > 0 || flow.drive) limits.add("unsteady flow", accurateStep(flow, t, lambda));
}

Rkl2::Rkl2(ParticleSystem& system, FluidForces& forces, Shifting* shifting, Budget* budget)
    : system_(system), forces_(forces), shifting_(shifting), budget_(budget) {
    if (!budget_) return;
    forces_.keepBudget();
    budget_->lastKnown = false;  // rates from a checkpoint of another scheme are not used
}

void Rkl2::start() {
    forces_.findWalls(system_);
    ParticleStore& s = system_.store();
    for (auto* a : {&s.fx, &s.fy, &s.fz, &s.densityRate}) std::fill(a->begin(), a->end(), 0.0);
    forces_.evaluate(system_, 0);
}

void Rkl2::resume() { forces_.findWalls(system_); }

void Rkl2::drift(double dt) {
    ParticleStore& s = system_.store();
    const auto n = static_cast<std::size_t>(system_.owned());
    for (std::size_t i = 0; i < n; ++i) s.x[i] += dt * s.u[i], s.y[i] += dt * s.v[i], s.z[i] += dt * s.w[i];
}

void Rkl2::advance(double dt) {
    drift(0.5 * dt);
    if (shifting_ && shifting_->due()) shifting_->apply(system_, dt);
    if (system_.mustRebuild()) {
        system_.rebuild();
        forces_.findWalls(system_);
    }
    ParticleStore& s = system_.store();
    const auto n = static_cast<std::size_t>(system_.owned());
    const double half = 0.5 * dt;
    densityRate_ = s.densityRate;
    for (std::size_t i = 0; i < n; ++i) s.density[i] += half * s.densityRate[i];
    forces_.evaluate(system_, 0);
    if (budget_) budget_->add(half, forces_.rates());
    findIncrement(dt);
    for (std::size_t i = 0; i < n; ++i) {
        s.u[i] += increment_[0][i], s.v[i] += increment_[1][i], s.w[i] += increment_[2][i];
        // Density at the end of the step, to first order, for the pressure in the next evaluation.
        s.density[i] += dt * s.densityRate[i] - half * densityRate_[i];
    }
    densityRate_ = s.densityRate;
    forces_.evaluate(system_, 0);
    if (budget_) budget_->add(half, forces_.rates());
    for (std::size_t i = 0; i < n; ++i) s.density[i] += half * (s.densityRate[i] - densityRate_[i]);
    drift(half);
}

void Rkl2::findIncrement(double dt) {
    const ParticleStore& s = system_.store();
    const auto n = static_cast<std::size_t>(system_.owned());
    const RealArray* const start[3] = {&s.fx, &s.fy, &s.fz};  // L u + g
    const LegendreStages stages(this->stages(dt));
    for (int k = 0; k < 3; ++k) {
        before_[k].assign(n, 0.0);
        increment_[k].resize(n), viscous_[k].resize(n);
        for (std::size_t i = 0; i < n; ++i) increment_[k][i] = stages.first() * dt * (*start[k])[i];
    }
    for (const LegendreStages::Stage& stage : stages.later()) {
        forces_.findViscosity(system_, increment_, viscous_);
        for (int k = 0; k < 3; ++k) {
            const double *const f = start[k]->data(), *const L = viscous_[k].data();
            double *const d = increment_[k].data(), *const old = before_[k].data();
            for (std::size_t i = 0; i < n; ++i) {
                const double next = stage.last * d[i] + stage.before * old[i] +
                                    dt * (stage.rate * (f[i] + L[i]) + stage.startRate * f[i]);
                old[i] = d[i], d[i] = next;
            }
        }
    }
}

}  // namespace corpuscle::sph
