#include "bodies/bodies.hpp"

#include <algorithm>
#include <cmath>

#include "bodies/extrapolation.hpp"

namespace corpuscle::bodies {

using particles::Kind;
using particles::ParticleStore;
using particles::ParticleSystem;

namespace {

// Approximate weight of a body's particles within reach of a fluid particle i in the viscous sum_j l_ij depth_j, by the
// distance of the fluid particle from the surface of the body.
double share(double distance, double reach) { return std::pow(1 - distance / reach, 6); }

// f(arm) for each periodic image of a particle within `reach` of the sphere around the body; arm: from the centre of
// the body to the image.
template <class F>
void forArms(const ParticleSystem& system, const Body& body, int particle, double reach, F&& f) {
    const double radius = body.solid.radius() + reach;
    const Vec3 all = Vec3::Constant(radius),
               from = system.store().position(static_cast<std::size_t>(particle)) - body.state.centre;
    system.periodicity().forImagesWithin(from, -all, all, [&](const Vec3& arm) {
        if (arm.squaredNorm() < radius * radius) f(arm);
    });
}

}  // namespace

Bodies::Bodies(std::vector<Body> bodies, const Medium& medium) : bodies_(std::move(bodies)), medium_(medium) {
    std::int64_t first = 0;
    for (Body& body : bodies_) {
        body.firstMember = first;
        first += static_cast<std::int64_t>(body.particles.size());
    }
    groups_.motion.resize(bodies_.size());
    groups_.rotationalDrag.resize(bodies_.size());
    groups_.wrenches.resize(bodies_.size());
    groups_.response = [this](const std::vector<Wrench>& wrenches) {
        std::vector<RigidMotion> accelerations;
        for (std::size_t b = 0; b < bodies_.size(); ++b)
            accelerations.push_back(bodies_[b].behaviour->response(bodies_[b].state, bodies_[b].solid, wrenches[b]));
        return accelerations;
    };
}

std::size_t Bodies::bodyOf(std::int64_t member) const {
    const auto next = std::upper_bound(bodies_.begin(), bodies_.end(), member,
                                       [](std::int64_t n, const Body& body) { return n < body.firstMember; });
    return static_cast<std::size_t>(next - bodies_.begin()) - 1;
}

void Bodies::drifted(ParticleSystem& system, double dt) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        Body& body = bodies_[b];
        body.behaviour->advance(body.state, body.solid, body.wrench, dt);
        // Eq 14 (sph/velocityVerlet.hpp) for a body: extrapolated by the force at the beginning of the step.
        const RigidMotion rate = body.behaviour->response(body.state, body.solid, body.wrench);
        groups_.motion[b] = {body.state.motion.linear + 0.5 * dt * rate.linear,
                             body.state.motion.angular + 0.5 * dt * rate.angular};
    }
    place(system);
}

void Bodies::place(ParticleSystem& system) const {
    ParticleStore& s = system.store();
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        const auto i = static_cast<std::size_t>(groups_.members[k].particle);
        const RigidState& state = bodies_[static_cast<std::size_t>(groups_.members[k].group)].state;
        s.setPosition(i,
                      system.periodicity().nearest(state.centre + state.orientation * parts_[k]->place, s.position(i)));
    }
}

void Bodies::moved(ParticleSystem& system, double, bool rebuilt) {
    if (rebuilt) findMembers(system), findCandidates(system);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        sph::RigidGroups::Member& member = groups_.members[k];
        const RigidState& state = bodies_[static_cast<std::size_t>(member.group)].state;
        member.arm = state.orientation * parts_[k]->place;
        member.surfaceArm = state.orientation * parts_[k]->foot;
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const Mat3 R = bodies_[b].state.rotation();
        groups_.rotationalDrag[b] = R * bodies_[b].rotationalDrag * R.transpose();
    }
    updateNear(system);
}

void Bodies::findMembers(const ParticleSystem& system) {
    groups_.members.clear();
    parts_.clear();
    const ParticleStore& s = system.store();
    for (int i = 0; i < system.owned(); ++i) {
        if (s.kindOf(static_cast<std::size_t>(i)) != Kind::body) continue;
        const std::int64_t number = s.member[i];
        const std::size_t b = bodyOf(number);
        const BodyParticle& part = bodies_[b].particles[static_cast<std::size_t>(number - bodies_[b].firstMember)];
        groups_.members.push_back({i, static_cast<int>(b), part.depth, Vec3::Zero(), Vec3::Zero()});
        parts_.push_back(&part);
    }
}

// Until the next rebuild a particle and a body each move by no more than the skin from where they are now.
void Bodies::findCandidates(const ParticleSystem& system) {
    candidates_.clear();
    const double margin = system.support() + 2 * system.skin();
    for (int i = 0; i < system.owned(); ++i) {
        if (particles::isBoundary(system.store().kindOf(static_cast<std::size_t>(i)))) continue;
        Candidate candidate{i, {}};
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
            bool isNear = false;
            forArms(system, bodies_[b], i, margin, [&](const Vec3&) { isNear = true; });
            if (isNear) candidate.bodies.push_back(static_cast<int>(b));
        }
        if (!candidate.bodies.empty()) candidates_.push_back(std::move(candidate));
    }
}

void Bodies::updateNear(const ParticleSystem& system) {
    groups_.near.clear();
    const double reach = system.support(), least = medium_.leastDistance * medium_.spacing;
    struct Surface {
        double distance, weight;
    };
    std::vector<Surface> surfaces;  // of the present candidate, in the order of its entries in `near`
    for (const Candidate& candidate : candidates_) {
        surfaces.clear();
        double whole = 0;
        for (const int b : candidate.bodies) {
            const Body& body = bodies_[static_cast<std::size_t>(b)];
            forArms(system, body, candidate.particle, reach, [&](const Vec3& from) {
                const double distance = std::max(0.0, body.distance.at(body.inBody(from)));
                if (distance >= reach) return;
                surfaces.push_back({distance, share(distance, reach)});
                whole += surfaces.back().weight;
                groups_.near.push_back({candidate.particle, b, 0, from});
            });
        }
        auto near = groups_.near.end() - static_cast<std::ptrdiff_t>(surfaces.size());
        for (const Surface& surface : surfaces) {
            const Body& body = bodies_[static_cast<std::size_t>(near->group)];
            const double distance = effectiveDistance(body.distance, body.inBody(near->arm),
                                                      std::max(surface.distance, least), medium_.spacing);
            (near++)->inverseDistance = surface.weight / whole / distance;
        }
    }
}

void Bodies::addAccelerations(ParticleSystem&) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        bodies_[b].wrench = groups_.wrenches[b];
        bodies_[b].wrench.force += medium_.density * bodies_[b].solid.volume * medium_.bodyForce;
    }
}

void Bodies::addRates(const ParticleSystem& system, const sph::FluidForces&, sph::Budget::Values& rates) const {
    if (system.decomposition().rank() != 0) return;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        addRates(system, bodies_[b], groups_.motion[b], rates);
        if (bodies_[b].behaviour->yields())
            rates[sph::Budget::kinetic] += groups_.motion[b].linear.dot(bodies_[b].wrench.force) +
                                           groups_.motion[b].angular.dot(bodies_[b].wrench.torque);
    }
}

void Bodies::addRates(const ParticleSystem& system, const Body& body, const RigidMotion& motion,
                      sph::Budget::Values& rates) const {
    const Vec3 byBodyForce = medium_.density * body.solid.volume * medium_.bodyForce;
    if (body.behaviour->yields()) {
        const Vec3 x = system.periodicity().shortest(body.state.centre - system.box().middle());
        sph::Budget::addBodyForce(rates, motion.linear, x, byBodyForce);
        return;
    }
    const Vec3 onFluid = byBodyForce - body.wrench.force;
    rates[sph::Budget::ofBodies] += motion.linear.dot(onFluid) - motion.angular.dot(body.wrench.torque);
    sph::Budget::add(rates, sph::Budget::givenBodies, onFluid);
}

void Bodies::kicked(ParticleSystem& system, double dt) {
    std::vector<RigidMotion> motions;
    for (Body& body : bodies_) {
        body.behaviour->finish(body.state, body.solid, body.wrench, dt);
        motions.push_back(body.state.motion);
    }
    ParticleStore& s = system.store();
    groups_.spread(motions, s.u.data(), s.v.data(), s.w.data());
}

}  // namespace corpuscle::bodies
