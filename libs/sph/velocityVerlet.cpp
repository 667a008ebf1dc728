#include "sph/velocityVerlet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle::sph {

using particles::ParticleStore;
using particles::ParticleSystem;

VelocityVerlet::VelocityVerlet(ParticleSystem& system, FluidForces& forces, Shifting* shifting,
                               std::vector<Load*> loads, Budget* budget)
    : system_(system), forces_(forces), shifting_(shifting), loads_(std::move(loads)), budget_(budget) {
    if (budget_) forces_.keepBudget();
}

void VelocityVerlet::start() {
    ParticleStore& s = system_.store();
    for (auto* a : {&s.fx, &s.fy, &s.fz, &s.densityRate}) std::fill(a->begin(), a->end(), 0.0);
    evaluate(0, true);
}

void VelocityVerlet::resume() {
    forces_.findWalls(system_);
    for (Load* load : loads_) load->moved(system_, 0, true);
}

void VelocityVerlet::advance(double dt) {
    ParticleStore& s = system_.store();
    const double half = 0.5 * dt;
    double displacement2 = 0, sum = 0;  // the sum detects NaN, which a maximum does not
    const int n = system_.owned();
    for (int i = 0; i < n; ++i) {
        s.u[i] += half * s.fx[i];  // Eq 12
        s.v[i] += half * s.fy[i];
        s.w[i] += half * s.fz[i];
        s.density[i] += half * s.densityRate[i];  // Eq 13
        s.x[i] += dt * s.u[i];                    // Eq 15
        s.y[i] += dt * s.v[i];
        s.z[i] += dt * s.w[i];
        const double dx = s.x[i] - s.xBuilt[i], dy = s.y[i] - s.yBuilt[i], dz = s.z[i] - s.zBuilt[i];
        const double d2 = dx * dx + dy * dy + dz * dz;
        displacement2 = std::max(displacement2, d2);
        sum += d2;
    }
    if (!std::isfinite(sum)) displacement2 = std::numeric_limits<double>::infinity();
    for (Load* load : loads_) load->drifted(system_, dt);
    if (shifting_ && shifting_->due()) {
        shifting_->apply(system_, dt);
        displacement2 = system_.largestDisplacement2();
    }
    const bool rebuilt = system_.mustRebuild(displacement2);
    if (rebuilt) system_.rebuild();
    if (budget_ && budget_->lastKnown) budget_->add(half, budget_->last);
    const double after = budget_ && budget_->lastKnown ? half : dt;
    evaluate(half, rebuilt);  // Eqs 5, 6, 14
    if (budget_) budget_->add(after, budget_->last);

    ParticleStore& t = system_.store();
    const int m = system_.owned();
    for (int i = 0; i < m; ++i) {
        t.u[i] += half * t.fx[i];  // Eq 16
        t.v[i] += half * t.fy[i];
        t.w[i] += half * t.fz[i];
        t.density[i] += half * t.densityRate[i];  // Eq 17
    }
    for (Load* load : loads_) load->kicked(system_, dt);
}

void VelocityVerlet::evaluate(double extrapolation, bool rebuilt) {
    if (rebuilt) forces_.findWalls(system_);
    for (Load* load : loads_) load->moved(system_, extrapolation, rebuilt);
    forces_.evaluate(system_, extrapolation);
    for (Load* load : loads_) load->addAccelerations(system_);
    if (!budget_) return;
    budget_->last = forces_.rates();
    for (const Load* load : loads_) load->addRates(system_, forces_, budget_->last);
    budget_->lastKnown = true;
}

}  // namespace corpuscle::sph
