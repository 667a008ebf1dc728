// The membranes' term, through the immersed coupling (coupling/immersed.hpp):
//
//     load = S^T P (f(x*) + k (middle u_m + lead P S v0)),   A = S^T P ((middle + lead) k + C) P S
//         (Reach of term.hpp)
//
// symbol | meaning
// S, P   | interpolation to the nodes, with the volume of closed cells kept
// f, k   | elastic force of the membranes, and its stiffness
// C      | damping by the membrane's own viscosity
// u_m    | velocity of the nodes with which they came to x*
//
// Its diagonal is left out: blocks of the membrane make the preconditioner worse, because near it they hold back all
// that is not smooth along it (docs/implicit.md, Figures); membraneCorrection.hpp has it in full.
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

    // volumes: of the particles, as they are at x*. All must stay where they are.
    MembraneTerm(coupling::Immersed& immersed, const particles::ParticleSystem& system,
                 const std::vector<double>& volumes, const ImplicitSettings& settings)
        : immersed_(immersed), system_(system), volumes_(volumes), settings_(settings) {}

    void prepare(const Reach& reach) override;
    void addFirstForces(const Field& v0, Forces& forces) override;
    void addForces(const Field& v, Forces& forces) override;
    void addProduct(const Field& v, Forces& forces) override;
    std::string whyNot(const Field& v, double dt) override;  // a bond would change by too much, or membranes would meet
    bool isLinear() const override { return false; }
    void addDefect(Forces& forces) override;
    void takeDefect() override;
    double power(const Field& v, const Field& w) override;
    double slidingPower(const Field& v, const std::vector<double>& divergence, const Field& w) override;

    // What the velocity last given does for the budget, of the cells that this rank owns: power against elasticity and
    // against viscosity.
    void addRates(sph::Budget::Values& rates) const;

    // What walls feel of membranes in contact with them, at the velocity found, of the cells that this rank owns.
    std::vector<coupling::CellContacts::OnWall> forcesOnWalls() const;

    // Of the nodes of the cells that this rank holds, for the velocity last given to addFirstForces, addForces or
    // whyNot.
    const Vectors& velocities() const { return nodes_; }
    // For that given to addFirstForces.
    const Vectors& extrapolated() const { return extrapolated_; }

  private:
    Vectors displacement() const;                           // from x*, of the velocity last given
    void give(const Vectors& nodes, Forces& forces) const;  // those of the velocities of the nodes
    double contactAcrossImages() const;                     // power of its forces by the slide of images [W]
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
