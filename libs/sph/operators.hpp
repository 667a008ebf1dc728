// Adjoint operators of the fluid: viscosity, divergence, and the transpose of the divergence.
//
//     B_i = (sum_j V_j F d d^T)^-1,   S2_i = tr(B_i^-1)/3,   F = -W'(r)/r,   d = x_j - x_i
//     (D u)_i     = sum_j V_j F (B_i d).(u_j - u_i)                               divergence, exact for linear fields
//     (D^T V p)_i = -V_i sum_j V_j F (p_i B_i + p_j B_j) d                        force of the pressure p
//     (L u)_i     = sum_j V_i V_j mu F (1/S2_i + 1/S2_j) beta (u_i - u_j)
//         Morris' viscosity, with unit second moment
// Morris' form is the divergence of mu grad u. This equals the divergence of 2 mu e, with e the symmetric part of the
// gradient, only where mu is uniform: at a jump it would exert a torque on a rigid rotation. Where viscosity varies, L
// therefore has the mu of the outer fluid, and the rest is a stress tau from the corrected gradient, whose force is
// computed by the transpose of that gradient,
//     (grad u)_i = B_i sum_j V_j F d (u_j - u_i)^T,   force_i = V_i sum_j V_j F (tau_i B_i + tau_j B_j) d
// tau is 2 (mu_i - mu) e_i away from the jump, and that of excessStress.hpp near it. Gradients double the cost: they
// are computed only in blocks of pairs in which a particle has such a stress.
//
// In a fluid of layers (FluidModel::lowestLayer) L has instead the harmonic mean of both particles' viscosities, so
// that in the layer beside a wall beta acts as in a uniform fluid. What Morris' form lacks is tau_i =
// (mu_i - mu_low) (grad u)_i^T, with the force along its first index: it exerts no force in a plane shear flow along
// the layers. mu_low could be any constant, as the divergence vanishes; it is the lowest viscosity of the layers, with
// which no mode gains power if viscosities differ by a factor of at most 20 (tests/sph/operators.cpp: all eigenvalues;
// at 50 some are negative). No case may have a larger factor.
//
// D and D^T V are transposes of each other to rounding, L is symmetric and positive semi-definite (layers: see above),
// and forces sum to zero. Wall particles have B = 1 and the S2 of a lattice. Plain operators have B = 1 and S2 = 1
// everywhere.
//
// The weights are computed anew at each application: this needs a hundred bytes per particle and is as fast as reading
// stored weights. Real: type of records and pair terms; sums are double. Fields of vectors have four numbers per
// particle, the last one 0.
//
// Over ranks: the divergence at an own particle needs the velocities of its neighbours; this rank may already know
// those owned by other ranks, else they are exchanged. Each rank then adds the forces due to the stresses of its own
// particles to all neighbours, including those owned by other ranks, and one message to each neighbouring rank adds up
// the forces (particles/sharedParticles.hpp) while pairs of particles that no other rank knows are processed.
#pragma once
#include <array>
#include <utility>

#include "particles/sharedParticles.hpp"
#include "particles/sumOverPairs.hpp"
#include "sph/excessStress.hpp"

namespace corpuscle::sph {

enum class OperatorForm { plain, corrected };

// Meaning of a field in a box whose images slide (core/periodicity.hpp): velocities, to which images add their slide,
// or changes of velocities, which are the same for all images.
enum class FieldOf { velocities, changes };

template <class Real>
class Operators {
  public:
    using Field = particles::AlignedVector<Real>;
    static constexpr std::size_t width = 4;

    // noSlip: the bounds of the factor at walls; without it those of explicit steps.
    Operators(const FluidModel& model, const particles::ParticleSystem& system, OperatorForm form,
              std::optional<NoSlip> noSlip = {});

    // Builds the operators for the present positions of the particles, at which lists have just been built. Collective.
    // Throws Failure(numerics) if a particle has too few neighbours for a gradient.
    void build(particles::ParticleSystem& system);
    // If viscosity varies, but not in layers, to be called after `build`; inside: of the owned particles. Collective.
    void setInside(particles::ParticleSystem& system, const std::vector<Inside>& inside);

    // force_i = -(L u)_i + (D^T V p)_i + (force of tau)_i [N], four numbers per particle, with p_i = pressure(i,
    // (D u)_i) [Pa] for owned particles. u: of the owned particles; their images have the same u. Collective.
    template <class Pressure>
    void apply(particles::ParticleSystem& system, const Field& u, Pressure&& pressure) {
        force_.assign(width * shared_.entries(), 0.0);
        addForces(system, u, Known::ownVelocities, FieldOf::changes, pressure, force_);
    }
    // The same added to `force`, where u and force have all entries of shared(), so that velocities of ghosts need no
    // message. Forces that own particles, and they alone, had before are included in the sum that all ranks get.
    // Collective.
    template <class Pressure>
    void addForces(particles::ParticleSystem& system, const Field& u, FieldOf of, Pressure&& pressure,
                   particles::RealArray& force) {
        addForces(system, u, Known::allVelocities, of, pressure, force);
    }
    // The same as `apply`, without pressure. Collective.
    void applyViscosity(particles::ParticleSystem& system, const Field& u);
    // Force of the last `apply` or `applyViscosity`; other forces may be added, until the next application.
    particles::RealArray& force() { return force_; }
    const particles::RealArray& force() const { return force_; }
    particles::SharedParticles& shared() { return shared_; }  // since the last `build`
    const particles::SharedParticles& shared() const { return shared_; }
    double divergence(std::size_t i) const { return divergence_[i]; }  // of the last application [1/s]

    // Velocity of each ghost less that of its particle [m/s]; empty in a box whose images do not slide.
    const std::vector<Vec3>& slides() const { return slides_; }

    double volume(std::size_t i) const { return volume_[i]; }  // m/rho [m^3]
    const std::vector<double>& volumes() const { return volume_; }
    double viscousScale(std::size_t i) const { return scale_[i]; }  // 1/S2
    double wallGap(std::size_t i) const { return gap_[i]; }         // distance from the nearest wall [m]
    bool isWall(std::size_t i) const { return wall_[i] != 0; }
    // Sums of momentPair.hpp:
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
    // Viscosity of particle i less the lowest of the layers [Pa s].
    double layerExcess(const particles::ParticleSystem& system, std::size_t i) const {
        return system.store().viscosity[i] - model_.lowestLayer;
    }
    // Blocks of pairs, sorted by whether one of their particles has a stress tau (varying) or none (uniform).
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
    // Adds the sums of record `from` to the force of `entry` and sets them to 0.
    void takeForces(std::size_t from, std::size_t entry, particles::RealArray& force) {
        for (std::size_t k = 0; k < 3; ++k)
            force[width * entry + k] += viscousUnit_ * std::exchange(sums_[width * from + k], 0.0);
    }
    void takeGradients(const particles::ParticleSystem& system);  // stress_ and divergence_ from gradientSums_

    FluidModel model_;
    OperatorForm form_;
    ViscosityKind viscosity_;
    PairKernels::Operators<Real> uniform_, varying_;
    MomentConstants moments_;
    NoSlip noSlip_;
    double unitVolume_, wallScale_, viscousUnit_,
        rateUnit_;  // wallScale_: 1/S2 of walls; others: units of records, sums
    Field momentRecords_, rateRecords_, stressRecords_, varyingStressRecords_;
    particles::SharedParticles shared_;
    std::vector<Vec3> slides_;  // of ghosts; empty in a box whose images do not slide
    long plannedAt_ = -1;       // system.builds() when shared_ was planned
    particles::RealArray sums_, force_, divergence_;
    std::array<Blocks, particles::PairList::groups> groups_;
    BlocksByWall reaching_, rest_;       // the blocks of shared_
    std::vector<std::size_t> touched_;   // records in varying blocks: of own particles, in order, then of ghosts
    std::vector<int> place_;             // index of each own particle in touched_; -1: it is not in touched_
    particles::RealArray gradientSums_;  // by record; 0 except for touched_
    std::vector<Mat3> stress_;           // tau of each entry of touched_
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
