#include "coupling/flowControl.hpp"

#include <cmath>

#include "core/communicator.hpp"
#include "core/error.hpp"
#include "coupling/scene.hpp"

namespace corpuscle::coupling {

namespace {
constexpr double approach = 10;       // rate at which short steps approach the given flow rate, times tau
constexpr double share = 0.2;         // of the new mobility in the one that is used
constexpr double leastOfGiven = 0.1;  // flow rate over the given one from which on a mobility is taken
double factorAt(const sph::FlowState& flow, double t) { return flow.drive ? flow.drive->factor(t) : 1; }
}  // namespace

FlowControl::FlowControl(const sph::FlowState& flow)
    : force_(flow.factor * flow.bodyForce[0]), mobility_(flow.flowRate / flow.bodyForce[0]) {}

void FlowControl::restore(const std::vector<double>& state) {
    if (state.size() != 3) throw Failure(ExitCode::io, "the checkpoint holds another state of the flow rate");
    force_ = state[0], before_ = state[1], mobility_ = state[2];
}

void FlowControl::follow(const Scene& scene, double t, double dt) {
    const sph::FlowState& flow = scene.flow;
    const double rate = flowRate(scene), tau = mobility_ / flow.section;
    const double given = flow.flowRate * factorAt(flow, t), next = flow.flowRate * factorAt(flow, t + dt);
    const double unchanged = rate + (rate - before_) * std::exp(-dt / tau);
    const double wanted = rate - std::expm1(-approach * dt / tau) * (given - rate) + next - given;
    if (dt > tau && force_ * rate > 0 && std::abs(rate) > leastOfGiven * flow.flowRate)
        mobility_ += share * (rate / force_ - mobility_);
    force_ += (wanted - unchanged) / (mobility_ * -std::expm1(-dt / tau));
    before_ = rate;
}

double flowRate(const Scene& scene) {
    const particles::ParticleStore& s = scene.store();
    double sum = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.kindOf(i) != particles::Kind::wall) sum += scene.mass(i) / s.density[i] * s.u[i];
    return Communicator(scene.system->comm()).sum(sum) / scene.fluidBox.size()[0];
}

}  // namespace corpuscle::coupling
