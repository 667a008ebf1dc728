// The system of one implicit step, A v = b (implicitStep.hpp), for the velocities of all particles that a rank knows
// and of rigid bodies:
//
//     A = c1 M + sum of the terms' A,   b = M (c1 u + c2 a + g) + sum of the terms' loads
//         (term.hpp, timeDifference.hpp)
//
// Velocities of walls are prescribed: in their rows the preconditioner returns 0 and the residual is the whole force on
// them, which is linear in the velocity like the other rows. Rows of rigid bodies follow those of the particles
// (rigidUnknowns.hpp).
//
// Fields have four numbers per entry, three of them a vector (particles/vectorField.hpp). Entries of ghosts equal those
// of the ranks that own the particles, to rounding.
#pragma once
#include <memory>
#include <vector>

#include "coupling/immersed.hpp"
#include "coupling/noFlux.hpp"
#include "implicit/conjugateGradients.hpp"
#include "implicit/fluidTerm.hpp"
#include "implicit/implicitSettings.hpp"
#include "implicit/membraneTerm.hpp"
#include "implicit/rigidUnknowns.hpp"
#include "implicit/timeDifference.hpp"
#include "particles/vectorField.hpp"

namespace corpuscle::implicit {

template <class Real>
class System {
  public:
    using Field = particles::AlignedVector<Real>;
    using RealArray = particles::RealArray;

    // immersed, noFlux: null without cells. onGrid: the preconditioner has a part on the background grid.
    // scene, settings, immersed and noFlux are kept by reference.
    System(coupling::Scene& scene, const coupling::AdjointOptions& options, const ImplicitSettings& settings,
           coupling::Immersed* immersed, coupling::NoFlux* noFlux, bool onGrid);

    // Prepares, at x* with up-to-date lists, the terms, the particles near membranes, and the diagonal. Collective.
    void prepare(const TimeDifference& time);

    // The velocity extrapolated from the last two steps, for all entries and bodies. Collective.
    void findGuess(Field& guess);
    // residual = b - A guess, for the first guess after prepare. Collective.
    void findResidual(const Field& guess, Field& residual);
    // w = A z. Collective.
    void product(const Field& z, Field& w);
    // Divergence of the velocity last given to findResidual or product, at own particles [1/s].
    double divergence(std::size_t i) const { return operators().divergence(i); }

    // The defect: forces of the terms at the positions to which the velocity v leads, less the linearised forces; as
    // the residual of the rows that are not prescribed. Collective.
    void findDefect(Field& residual);
    // Adds this defect to the load, and to the force on walls.
    void takeDefect(Field& residual);
    bool isLinear() const { return isLinear_; }
    // Why a step of dt with the computed velocity is too long; empty if it is not. Collective.
    std::string whyNot(const Field& v, double dt);

    // Computes the forces of the terms on own particles at the computed velocity, and force and torque on bodies.
    // Collective.
    void findForcesOnBodies(const Field& v);
    // Force on particle i as last computed [N].
    Vec3 force(std::size_t i) const { return particles::vectorAt(forces_, i); }
    const RealArray& forces() const { return forces_; }
    // w.(load - A v) of the terms that are not in the fluid's budget (Term::power), this rank's share [W]. Collective.
    double power(const Field& v, const Field& w);
    // w.(load - A v) of all terms, where images slide in both flows (term.hpp); divergence: of v. This rank's share
    // [W].
    double slidingPower(const Field& v, const std::vector<double>& divergence, const Field& w);

    // The diagonal: inertia and position of each entry, as on the rank that owns it, and 1/(inertia + diagonal of the
    // terms), which is 0 where the velocity is prescribed or belongs to a body.
    struct Row {
        double inertia;  // c1 m, 0 where the velocity is prescribed [kg/s]
        double place[3];
    };
    const Row& row(std::size_t entry) const { return rows_[entry]; }
    const Field& inverseDiagonal() const { return inverse_; }

    coupling::Scene& scene() const { return scene_; }
    const TimeDifference& time() const { return time_; }
    sph::Operators<Real>& operators() { return fluid_.operators(); }
    const sph::Operators<Real>& operators() const { return fluid_.operators(); }
    particles::SharedParticles& shared() { return operators().shared(); }
    const FluidTerm<Real>& fluid() const { return fluid_; }
    coupling::Immersed* immersed() const { return immersed_; }          // null without cells
    MembraneTerm<Real>* membranes() const { return membranes_.get(); }  // null without cells
    RigidUnknowns<Real>* rigid() const { return rigid_.get(); }         // null without bodies

    std::size_t owned() const { return scene_.store().size(); }
    std::size_t entries() const { return operators().shared().entries(); }
    std::size_t length() const { return particles::fieldWidth * entries() + (rigid_ ? rigid_->length() : 0); }
    // The rows that other ranks own and count.
    Copies copies() const { return {particles::fieldWidth * owned(), particles::fieldWidth * entries()}; }
    bool isPrescribed(std::size_t i) const { return operators().isWall(i); }
    bool isOfBody(std::size_t i) const { return rigid_ && rigid_->isMember(i); }
    double mass(std::size_t i) const { return scene_.mass(i); }

  private:
    // forces_ = sum of what add(term) of each term adds, the fluid's last.
    template <class Add>
    void sumTerms(Add&& add) {
        forces_.assign(particles::fieldWidth * entries(), 0.0);
        for (Term<Real>* term : terms_) add(*term);
    }
    void findDiagonal();

    coupling::Scene& scene_;
    coupling::Immersed* immersed_;
    coupling::NoFlux* noFlux_;
    FluidTerm<Real> fluid_;
    std::unique_ptr<MembraneTerm<Real>> membranes_;
    std::unique_ptr<RigidUnknowns<Real>> rigid_;
    std::vector<Term<Real>*> terms_;  // all of these, the fluid's last
    bool isLinear_;
    TimeDifference time_;
    RealArray forces_;  // sum over the terms, at the velocity last given to them
    Field inverse_;
    std::vector<Row> rows_;
};

extern template class System<double>;
extern template class System<float>;

}  // namespace corpuscle::implicit
