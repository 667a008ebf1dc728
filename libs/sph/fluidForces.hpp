// Accelerations and rates of density of all particles of one rank (fluidPair.hpp), with the body force and the forces
// on walls.
//
// Pressure and viscosity act between all particles; a node of a membrane that is a particle (dual identity) counts as
// fluid here. The velocity that enters viscosity and continuity is the extrapolated one of the paper's Eq 14, u* + e a
// with e = dt/2 and a the last acceleration; density is extrapolated likewise, rho* + e rhodot (velocityVerlet.hpp
// explains why).
#pragma once
#include <memory>
#include <optional>

#include "boundary/walls.hpp"
#include "particles/particleSystem.hpp"
#include "sph/budget.hpp"
#include "sph/equationOfState.hpp"
#include "sph/kernel.hpp"
#include "sph/rigidGroups.hpp"
#include "sph/solute.hpp"

namespace corpuscle::sph {

struct FluidModel {
    std::shared_ptr<const Kernel> kernel;
    std::shared_ptr<const EquationOfState> equationOfState;
    double density = 0;             // rho0 [kg/m^3]
    double viscosity = 0;           // mu of the outer fluid [Pa s]
    double soundSpeed = 0;          // c0 [m/s]
    double mass = 0;                // of one fluid particle, rho0 dx^3 [kg]
    Vec3 bodyForce = Vec3::Zero();  // per unit mass [m/s^2]
    boundary::Walls walls;
    double lowestLayer = 0;  // lowest viscosity of the fluid's layers [Pa s]; 0: no layers
    std::optional<Solute> solute{};
};

class FluidForces {
  public:
    // groups: rigid bodies, which must outlive this object; null: none. They need the store's fields mass and member.
    FluidForces(const FluidModel& model, const particles::ParticleSystem& system, RigidGroups* groups = nullptr);

    const FluidModel& model() const { return model_; }
    // What drives the flow at present (FlowState of flow.hpp).
    void setDrive(const Vec3& bodyForce, const boundary::Walls& walls) {
        model_.bodyForce = bodyForce, model_.walls = walls;
    }

    // Fills fx, fy, fz and densityRate of the owned particles. Accelerations of wall particles and of rigid groups are
    // summed up and set to zero.
    void evaluate(particles::ParticleSystem& system, double extrapolation);

    // rates(): contribution of the last evaluation to the budget (budget.hpp), without members of rigid groups and
    // other loads. velocityUsed(i): velocity of particle i in that evaluation. Both only after keepBudget(), which
    // costs one loop over particles in each evaluation and the memory of their velocities.
    void keepBudget() { keepsBudget_ = true; }
    const Budget::Values& rates() const { return rates_; }
    Vec3 velocityUsed(std::size_t i) const { return {used_[0][i], used_[1][i], used_[2][i]}; }

    // Finds the particles that belong to walls; to be called after each list build.
    void findWalls(const particles::ParticleSystem& system);

    // Forces of the fluid on the walls at the last evaluation, by number of the wall: the part of this rank [N].
    const std::vector<Vec3>& wallForces() const { return wallForces_; }
    // For schemes that compute forces by other operators.
    void setWallForces(std::vector<Vec3> forces) { wallForces_ = std::move(forces); }

    // Accelerations of the owned particles due to viscosity alone at this velocity; those of walls are 0. Not for
    // scenes with rigid groups. Collective.
    void findViscosity(particles::ParticleSystem& system, const particles::RealArray (&velocity)[3],
                       particles::RealArray (&acceleration)[3]);

    // Largest eigenvalue of the viscous operator per mass, 1/m_i (L u)_i, by power iterations with a start that depends
    // on particle numbers only [1/s]. Collective. Leaves the state as it was.
    double viscousRate(particles::ParticleSystem& system, int iterations);

    std::size_t bytes() const;

  private:
    // Records and kernels in one precision.
    template <class Real>
    struct Pairs {
        particles::AlignedVector<Real> records;
        PairKernels::Fluid<Real> away{}, atWall{};
    };
    // Packs the records and computes the sums over pairs. velocity(i, Real[3]) writes the velocity of particle i;
    // members of rigid groups have that of `motion` instead. pressure(i) is p/rho^2.
    template <class Velocity, class Pressure>
    void run(particles::ParticleSystem& system, const particles::RealArray& density,
             const std::vector<RigidMotion>& motion, Velocity&& velocity, Pressure&& pressure,
             double* const results[4]);
    template <class Real, class Velocity, class Pressure>
    void run(Pairs<Real>& pairs, particles::ParticleSystem& system, const particles::RealArray& density,
             const std::vector<RigidMotion>& motion, Velocity&& velocity, Pressure&& pressure,
             double* const results[4]);
    void runViscosity(particles::ParticleSystem& system, const particles::RealArray (&velocity)[3],
                      const std::vector<RigidMotion>& motion, particles::RealArray (&acceleration)[3]);
    void findRates(const particles::ParticleSystem& system);
    template <class Real>
    void packGroups(Real* records, int owned, const std::vector<RigidMotion>& motion) const;

    FluidModel model_;
    RigidGroups* groups_;
    std::vector<RigidMotion> still_;  // motion of the groups in a scene without groups: empty
    FluidVariant variant_;
    FluidConstants constants_;
    Pairs<double> double_;
    Pairs<float> float_;
    particles::RealArray sums_, density_, pressure_, unused_;
    struct WallParticle {
        int particle, wall;
    };
    std::vector<WallParticle> wallParticles_;
    std::vector<double> gap_;  // distance from the nearest wall [m]
    std::vector<Vec3> wallForces_;
    bool keepsBudget_ = false;
    Budget::Values rates_;
    particles::RealArray used_[3];
};

}  // namespace corpuscle::sph
