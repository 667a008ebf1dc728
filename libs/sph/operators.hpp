// Adjoint operators of the fluid: viscosity, divergence, and the transpose of the divergence.
//
//     B_i = (sum_j V_j F d d^T)^-1,   S2_i = tr(B_i^-1)/3,   F = -W'(r)/r,   d = x_j - x_i
//     (D u)_i     = sum_j V_j F (B_i d).(u_j - u_i)                               divergence, exact for linear fields
//     (D^T V p)_i = -V_i sum_j V_j F (p_i B_i + p_j B_j) d                        force of the pressure p
//     (L u)_i     = sum_j V_i V_j mu F (1/S2_i + 1/S2_j) beta (u_i - u_j)
//         Morris' viscosity, with unit second moment
// Morris' form is the divergence of mu grad u, which is that of 2 mu e, e the symmetric part of the gradient, only
// where mu is uniform: at a jump it would put a torque on what turns rigidly. Where viscosity varies, L has the fluid's
// mu, and the rest is a stress by the corrected gradient and its transpose,
//     (grad u)_i = B_i sum_j V_j F d (u_j - u_i)^T,   force_i = V_i sum_j V_j F (tau_i B_i + tau_j B_j) d
// which is 2 (mu_i - mu) e_i away from the jump, and what excessStress.hpp says near it. Gradients cost as much again:
// only the blocks of pairs in which a particle has such a stress find them.
// In a fluid of layers (FluidModel::lowestLayer) L has instead the harmonic mean of both particles' viscosities, so
// that the layer beside a wall meets it by beta as a uniform fluid does, and what Morris' form lacks is tau_i = (mu_i -
// mu_low) (grad u)_i^T, force by first index: nothing in a plane shear flow along the layers. mu_low, their lowest
// viscosity, may be any constant, as the divergence vanishes; with it no mode gains power where they are no more than
// 20 apart (tests/sph/operators.cpp: all eigenvalues; at 50 some are negative), and no case may have more. D and D^T V
// are transposes of each other to rounding, L is symmetric and positive semi-definite (layers: see above), and no force
// is left over in the sum. Particles of walls have B = 1 and the S2 of a lattice. Plain operators have B = 1 and S2 = 1
// everywhere.
//
// The weights are computed anew at each application: that needs a hundred bytes a particle and is as fast as reading
// them. Real: what records and pair terms are; sums are double. Fields of vectors have four numbers a particle, the
// last one 0.
//
// Over ranks: the divergence of an own particle needs the velocities of its neighbours, of which this rank may know
// those of others already; then each rank gives the force of its own particles' stresses to all neighbours, others'
// particles included, and one message to each neighbouring rank adds up the forces (particles/sharedParticles.hpp),
// behind the pairs of particles that no other rank knows.
#pragma once
#include <array>
#include <utility>

#include "particles/sharedParticles.hpp"
#include "particles/sumOverPairs.hpp"
#include "sph/excessStress.hpp"

namespace corpuscle::sph {

enum class OperatorForm { plain, corrected };

// What a field of velocities is, where the images of a box slide (core/periodicity.hpp): velocities, which images have
// with their slide, or changes of velocities, which all images share.
enum class FieldOf { velocities, changes };

template <class Real>
class Operators {
  public:
    using Field = particles::AlignedVector<Real>;
    static constexpr std::size_t width = 4;

    Operators(const FluidModel& model, const particles::ParticleSystem& system, OperatorForm form);

    // For the particles at their present positions, whose lists have just been built there. Collective.
    // Throws Failure(numerics) where a particle has too few neighbours for a gradient.
    void build(particles::ParticleSystem& system);
    // Where viscosity varies, but not in layers: after `build`, of owned particles. Collective.
    void setInside(particles::ParticleSystem& system, const std::vector<Inside>& inside);

    // force_i = -(L u)_i + (D^T V p)_i + (that of tau)_i [N], four numbers a particle, with p_i = pressure(i, (D u)_i)
    // [Pa] of owned particles. u: of the owned particles, and as it is of all of their images. Collective.
    template <class Pressure>
    void apply(particles::ParticleSystem& system, const Field& u, Pressure&& pressure) {
        force_.assign(width * shared_.entries(), 0.0);
        addForces(system, u, Known::ownVelocities, FieldOf::changes, pressure, force_);
    }
    // The same added to `force`, with u and force of all entries of shared(): velocities of ghosts need no
    // message. What own particles, and they alone, had as force before is in the sum that all ranks get. Collective.
    template <class Pressure>
    void addForces(particles::ParticleSystem& system, const Field& u, FieldOf of, Pressure&& pressure,
                   particles::RealArray& force) {
        addForces(system, u, Known::allVelocities, of, pressure, force);
    }
    // Without pressure; of owned particles. Collective.
    void applyViscosity(particles::ParticleSystem& system, const Field& u);
    particles::RealArray& force() { return force_; }  // what else acts may be added, until the next application
    const particles::RealArray& force() const { return force_; }
    particles::SharedParticles& shared() { return shared_; }  // since the last `build`
    const particles::SharedParticles& shared() const { return shared_; }
    double divergence(std::size_t i) const { return divergence_[i]; }  // of the last application [1/s]

    // Of ghosts, by how much they are faster than their particles [m/s]; empty in a box whose images do not slide.
    const std::vector<Vec3>& slides() const { return slides_; }

    double volume(std::size_t i) const { return volume_[i]; }  // m/rho [m^3]
    const std::vector<double>& volumes() const { return volume_; }
    double viscousScale(std::size_t i) const { return scale_[i]; }  // 1/S2
    double wallGap(std::size_t i) const { return gap_[i]; }         // distance from the nearest wall [m]
    bool isWall(std::size_t i) const { return wall_[i] != 0; }
    // Of momentPair.hpp:
    const Vec3& disorder(std::size_t i) const { return disorder_[i]; }              // R [1/m]
    double crowding(std::size_t i) const { return moment_[Moments::strength][i]; }  // sum_j V_j F [1/m^2]
    double evenness(std::size_t i) const { return moment_[Moments::number][i]; }    // sum_j V_j W
    // Diagonal of L [N s/m], and of D^T V D [m], both as multiples of the unit matrix.
    double viscousDiagonal(std::size_t i) const { return viscous_[i]; }
    double bulkDiagonal(std::size_t i) const { return bulk_[i]; }

  private:
    enum class Known { ownVelocities, allVelocities };
    template <class Pressure>
    void addForces(particles::ParticleSystem& system, const Field& u, Known known, FieldOf of, Pressure&& pressure,
                   particles::RealArray& force) {
        findRates(system, u, known, of);
        for (std::size_t i = 0; i < volume_.size(); ++i) setPressure(i, pressure(i, divergence_[i]));
        addStress(system, force);
    }
    bool isLayered() const { return viscosity_ == ViscosityKind::layers; }
    bool isTwoFluids() const { return viscosity_ == ViscosityKind::sides; }
    double layerExcess(const particles::ParticleSystem& system, std::size_t i) const {  // over the lowest [Pa s]
        return system.store().viscosity[i] - model_.lowestLayer;
    }
    // Blocks of pairs by whether one of their particles has a stress by the gradient.
    struct Blocks {
        std::vector<int> uniform, varying;
    };
    struct BlocksByWall {
        Blocks away, atWall;
    };
    template <class HasStress>
    void sortBlocks(const particles::ParticleSystem& system, HasStress&& hasStress);
    void findMoments(particles::ParticleSystem& system);
    void packRecords(particles::ParticleSystem& system);
    void findRates(particles::ParticleSystem& system, const Field& u, Known known, FieldOf of);
    void setPressure(std::size_t i, double pressure);
    void addStress(particles::ParticleSystem& system, particles::RealArray& force);
    void takeForces(std::size_t from, std::size_t entry, particles::RealArray& force) {  // of sums_, which have 0 then
        for (std::size_t k = 0; k < 3; ++k)
            force[width * entry + k] += viscousUnit_ * std::exchange(sums_[width * from + k], 0.0);
    }
    void takeGradients(const particles::ParticleSystem& system);  // stress_ and divergence_ of gradientSums_

    FluidModel model_;
    OperatorForm form_;
    ViscosityKind viscosity_;
    PairKernels::Operators<Real> uniform_, varying_;
    MomentConstants moments_;
    NoSlip noSlip_;
    double unitVolume_, wallScale_, viscousUnit_, rateUnit_;  // of the sums
    Field momentRecords_, rateRecords_, stressRecords_, varyingStressRecords_;
    particles::SharedParticles shared_;
    std::vector<Vec3> slides_;  // of ghosts; none in a box whose images do not slide
    long plannedAt_ = -1;       // builds of the system's lists
    particles::RealArray sums_, force_, divergence_;
    std::array<Blocks, particles::PairList::groups> groups_;
    BlocksByWall reaching_, rest_;       // of shared_
    std::vector<std::size_t> touched_;   // records of own particles in varying blocks, in order, then of ghosts
    std::vector<int> place_;             // of an own particle in touched_, -1: not there
    particles::RealArray gradientSums_;  // 0 but in touched_
    std::vector<Mat3> stress_;           // tau of touched_
    ExcessStress excess_;
    bool hasInside_ = false;
    std::array<particles::RealArray, Moments::count> moment_;
    std::vector<double> volume_, viscous_, bulk_;
    std::vector<std::array<double, 6>> correction_;  // B: xx yy zz xy xz yz
    std::vector<double> scale_;                      // 1/S2
    std::vector<Vec3> disorder_;
    std::vector<char> wall_;
    std::vector<double> gap_;  // distance from the nearest wall [m]
};

extern template class Operators<double>;
extern template class Operators<float>;

}  // namespace corpuscle::sph
