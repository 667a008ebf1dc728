// The term of the membranes, through the immersed coupling (coupling/immersed.hpp):
//
//     load = S^T P (f(x*) + k (middle u_m + lead P S v0)),   A = S^T P ((middle + lead) k + C) P S
//         (Reach of term.hpp)
//
// symbol | meaning
// S, P   | interpolation to the nodes, with the volume of closed cells kept
// f, k   | elastic force of the membranes, and its stiffness
// C      | damping by the membrane's own viscosity
// u_m    | velocity with which the nodes were moved to x*
//
// The term adds nothing to the diagonal: blocks of the membrane make the preconditioner worse, because they hold back
// all velocities near the membrane that are not smooth along it (docs/implicit.md, Iterations). membraneCorrection.hpp
// includes the membrane in full.
#pragma once
#include "coupling/immersed.hpp"
#include "implicit/implicitSettings.hpp"
#include "implicit/term.hpp"
#include "sph/budget.hpp"

namespace corpuscle::implicit {

template <class Real>
class MembraneTerm final : public Term<Real> {
  public:
    using typename Term<Real>::Field;
    using typename Term<Real>::Forces;
    using Vectors = coupling::Immersed::Vectors;

    // volumes: of the particles at x*. All arguments are kept by reference.
    MembraneTerm(coupling::Immersed& immersed, const particles::ParticleSystem& system,
                 const std::vector<double>& volumes, const ImplicitSettings& settings)
        : immersed_(immersed), system_(system), volumes_(volumes), settings_(settings) {}

    void prepare(const Reach& reach) override;
    void addFirstForces(const Field& v0, Forces& forces) override;
    void addForces(const Field& v, Forces& forces) override;
    void addProduct(const Field& v, Forces& forces) override;
    // Rejects a step in which a bond would change by too much, or membranes would meet.
    std::string whyNot(const Field& v, double dt) override;
    bool isLinear() const override { return false; }
    void addDefect(Forces& forces) override;
    void takeDefect() override;
    double power(const Field& v, const Field& w) override;
    double slidingPower(const Field& v, const std::vector<double>& divergence, const Field& w) override;

    // Adds to the budget, for the cells that this rank owns, the power of the velocity last given against elasticity
    // and against viscosity.
    void addRates(sph::Budget::Values& rates) const;

    // Forces on walls by membranes in contact with them, at the computed velocity, for the cells that this rank owns.
    std::vector<coupling::CellContacts::OnWall> forcesOnWalls() const;

    // Velocities of the nodes of the cells that this rank holds, for the field last given to addFirstForces, addForces
    // or whyNot.
    const Vectors& velocities() const { return nodes_; }
    // The same for the field given to addFirstForces.
    const Vectors& extrapolated() const { return extrapolated_; }

  private:
    Vectors displacement() const;                           // of the nodes from x*, by the velocity last given
    void give(const Vectors& nodes, Forces& forces) const;  // adds the forces at these velocities of the nodes
    double contactAcrossImages() const;                     // power of contact forces due to the sliding of images [W]
    coupling::Immersed& immersed_;
    const particles::ParticleSystem& system_;
    const std::vector<double>& volumes_;
    const ImplicitSettings& settings_;
    Reach reach_{};
    Vectors load_, defect_, nodes_, extrapolated_;
};

extern template class MembraneTerm<double>;
extern template class MembraneTerm<float>;

}  // namespace corpuscle::implicit
