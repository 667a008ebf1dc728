// The rigid bodies of a scene and their particles: a Load of velocity Verlet.
//
// The particles of a body are particles of the fluid that move with the body: they exert pressure as walls do (density
// by the continuity equation), and in the viscous term they have the velocity of the fluid continued beyond the surface
// (sph/fluidPair.hpp). The forces on them are summed to force and torque on the body (sph/rigidGroups.hpp), which give
// its motion (rigidState.hpp).
//
//     drifted            first half of the kick and drift of each body; moves its particles to their new positions
//     moved              after a rebuild, finds the particles on this rank; at each step, computes arms and distances
//     addAccelerations   stores force and torque on each body
//     kicked             second half of the kick; sets the velocities of the particles
//
// A uniform body force b represents a pressure gradient: it acts on a body of volume V as on the fluid, by rho0 b V.
#pragma once
#include "bodies/body.hpp"
#include "sph/velocityVerlet.hpp"

namespace corpuscle::bodies {

class Bodies : public sph::Load {
  public:
    struct Medium {
        double density = 0;             // rho0 of the fluid [kg/m^3]
        Vec3 bodyForce = Vec3::Zero();  // [m/s^2]
        double spacing = 0;             // [m]
        // A fluid particle closer to a surface than this counts as being at this distance [spacings]: the viscous force
        // at smaller distances would limit an explicit step. The reduced force makes bodies appear smaller, by 0.04 dx
        // with 0.25.
        double leastDistance = 0.25;
        static constexpr double unlimited = 0.05;  // for steps without this limit
    };
    // bodies: filled with their particles.
    Bodies(std::vector<Body> bodies, const Medium& medium);

    const std::vector<Body>& all() const { return bodies_; }
    std::vector<Body>& all() { return bodies_; }
    sph::RigidGroups& groups() { return groups_; }
    void setBodyForce(const Vec3& force) { medium_.bodyForce = force; }
    // Index of the body of a particle. member: its field `member` in the store.
    std::size_t bodyOf(std::int64_t member) const;

    void drifted(particles::ParticleSystem& system, double dt) override;
    void moved(particles::ParticleSystem& system, double extrapolation, bool rebuilt) override;
    void addAccelerations(particles::ParticleSystem& system) override;
    void kicked(particles::ParticleSystem& system, double dt) override;
    void addRates(const particles::ParticleSystem& system, const sph::FluidForces& forces,
                  sph::Budget::Values& rates) const override;
    // The same for one body that moves with `motion` under its wrench; to be called on rank 0 only.
    void addRates(const particles::ParticleSystem& system, const Body& body, const RigidMotion& motion,
                  sph::Budget::Values& rates) const;

    // For other schemes. findMembers finds the bodies' particles on this rank, after particles have changed their
    // order; place moves them to their positions in the bodies, at the images nearest to their present positions.
    void findMembers(const particles::ParticleSystem& system);
    void place(particles::ParticleSystem& system) const;

  private:
    void findCandidates(const particles::ParticleSystem& system);
    void updateNear(const particles::ParticleSystem& system);

    std::vector<Body> bodies_;
    Medium medium_;
    sph::RigidGroups groups_;
    std::vector<const BodyParticle*> parts_;  // one for each of groups_.members
    struct Candidate {
        int particle;
        std::vector<int> bodies;
    };
    std::vector<Candidate> candidates_;  // fluid particles that may come within the support of a surface
};

}  // namespace corpuscle::bodies
