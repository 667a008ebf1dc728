#include "schemes/explicitStepper.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::schemes {

ExplicitStepper::ExplicitStepper(coupling::Scene& scene, const NumericsSettings& numerics, long stepsPerEstimate)
    : scene_(scene), safety_(numerics.safety), stepsPerEstimate_(stepsPerEstimate) {}

void ExplicitStepper::setNewRates(const ExplicitRates& rates) {
    rates_ = rates;
    setRates(rates);
}

void ExplicitStepper::start() {
    startScheme();
    setNewRates(estimate());
}

std::vector<double> ExplicitStepper::state() const {
    return {rates_.viscous, rates_.membrane, rates_.spring2, static_cast<double>(count())};
}

void ExplicitStepper::resume(const std::vector<double>& state) {
    resumeScheme(std::lround(state.at(3)));
    setNewRates({state[0], state[1], state[2]});
}

bool ExplicitStepper::limitsChange(long step) {
    if (step % stepsPerEstimate_ == 0) setNewRates(estimate());
    return scene_.system->rebuilds() != rebuilds_;
}

sph::StepLimits ExplicitStepper::limits(double t) {
    const auto& s = scene_.store();
    double most = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
        most = std::max(most, s.u[i] * s.u[i] + s.v[i] * s.v[i] + s.w[i] * s.w[i]);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, scene_.system->comm());
    const sph::FluidModel& model = scene_.model();
    sph::StepLimits limits;
    const double force = std::max(scene_.flow.largestForce(), model.bodyForce.norm());
    addLimits({0.5 * scene_.system->support(), model.soundSpeed + std::sqrt(most), force, safety_}, t, limits);
    rebuilds_ = scene_.system->rebuilds();
    return limits;
}

void ExplicitStepper::addLimits(const ExplicitMedium& medium, double /*t*/, sph::StepLimits& limits) const {
    addViscousLimit(rates_, safety_, limits);
    addOtherLimits(rates_, medium, 1, limits);
}

}  // namespace corpuscle::schemes
