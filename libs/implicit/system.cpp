#include "implicit/system.hpp"

#include <algorithm>

#include "coupling/insideShares.hpp"

namespace corpuscle::implicit {

using particles::ParticleStore;
using particles::setVector;
using particles::vectorAt;

template <class Real>
System<Real>::System(coupling::Scene& scene, const coupling::AdjointOptions& options, const ImplicitSettings& settings,
                     coupling::Immersed* immersed, coupling::NoFlux* noFlux, bool onGrid)
    : scene_(scene), immersed_(immersed), noFlux_(noFlux), fluid_(scene, options) {
    if (immersed_) {
        membranes_ = std::make_unique<MembraneTerm<Real>>(*immersed_, *scene.system, operators().volumes(), settings);
        terms_.push_back(membranes_.get());
    }
    if (scene.bodies) {
        rigid_ = std::make_unique<RigidUnknowns<Real>>(scene, operators(), onGrid);
        terms_.push_back(rigid_.get());
    }
    terms_.push_back(&fluid_);
    isLinear_ = std::all_of(terms_.begin(), terms_.end(), [](const Term<Real>* term) { return term->isLinear(); });
}

template <class Real>
void System<Real>::prepare(const TimeDifference& time) {
    time_ = time;
    // The fluid's first; that of the bodies, which applies the viscosity, once the stress within membranes is known.
    const Term<Real>* const bodies = rigid_.get();
    for (auto term = terms_.rbegin(); term != terms_.rend(); ++term)
        if (*term != bodies) (*term)->prepare(time.reach);
    if (noFlux_) noFlux_->find(*scene_.system, *immersed_, time.begin());
    operators().setInside(*scene_.system, coupling::insideShares(scene_, noFlux_, immersed_));
    if (rigid_) rigid_->prepare(time.reach);
    findDiagonal();
}

template <class Real>
void System<Real>::findGuess(Field& guess) {
    const ParticleStore& s = scene_.store();
    guess.resize(length());
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double ahead = isPrescribed(i) ? 0 : time_.h;
        setVector(guess, i, s.velocity(i) + ahead * Vec3(s.fx[i], s.fy[i], s.fz[i]));
    }
    if (rigid_) rigid_->extrapolate(time_.h, guess);
    shared().distribute(guess.data(), static_cast<int>(particles::fieldWidth));
}

template <class Real>
void System<Real>::findResidual(const Field& guess, Field& residual) {
    const ParticleStore& s = scene_.store();
    residual.resize(length());
    sumTerms([&](Term<Real>& term) { term.addFirstForces(guess, forces_); });
    const Vec3& g = scene_.model().bodyForce;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 a(s.fx[i], s.fy[i], s.fz[i]), change = vectorAt(guess, i) - s.velocity(i);
        const Vec3 f = force(i) + mass(i) * (g + time_.c2 * a - time_.c1 * change);
        setVector(residual, i, isPrescribed(i) ? force(i) : f);
    }
    if (rigid_) rigid_->putResidual(time_.c1, time_.c2, guess, forces_, residual);
}

template <class Real>
void System<Real>::product(const Field& z, Field& w) {
    sumTerms([&](Term<Real>& term) { term.addProduct(z, forces_); });
    for (std::size_t i = 0; i < entries(); ++i) setVector(w, i, rows_[i].inertia * vectorAt(z, i) - force(i));
    if (rigid_) rigid_->putProduct(time_.c1, z, forces_, w);
}

template <class Real>
void System<Real>::findDefect(Field& residual) {
    sumTerms([&](Term<Real>& term) { term.addDefect(forces_); });
    for (std::size_t i = 0; i < owned(); ++i)
        if (!isPrescribed(i)) setVector(residual, i, force(i));
    if (rigid_) rigid_->putForces(forces_, residual);
}

template <class Real>
void System<Real>::takeDefect(Field& residual) {
    for (Term<Real>* term : terms_) term->takeDefect();
    for (std::size_t i = 0; i < owned(); ++i)
        if (isPrescribed(i)) setVector(residual, i, vectorAt(residual, i) + force(i));
}

template <class Real>
std::string System<Real>::whyNot(const Field& v, double dt) {
    for (Term<Real>* term : terms_)
        if (std::string why = term->whyNot(v, dt); !why.empty()) return why;
    return {};
}

// Computes the forces by the system itself, so that they are those that change the momentum. The solver does not
// provide them: the rows of particles of bodies are empty.
template <class Real>
void System<Real>::findForcesOnBodies(const Field& v) {
    sumTerms([&](Term<Real>& term) { term.addForces(v, forces_); });
    rigid_->findWrenches(forces_);
}

template <class Real>
double System<Real>::power(const Field& v, const Field& w) {
    double sum = 0;
    for (Term<Real>* term : terms_) sum += term->power(v, w);
    return sum;
}

template <class Real>
double System<Real>::slidingPower(const Field& v, const std::vector<double>& divergence, const Field& w) {
    double sum = 0;
    for (Term<Real>* term : terms_) sum += term->slidingPower(v, divergence, w);
    return sum;
}

template <class Real>
void System<Real>::findDiagonal() {
    static_assert(sizeof(Row) == particles::fieldWidth * sizeof(double));
    const std::size_t n = owned();
    inverse_.resize(entries()), rows_.resize(entries());
    const auto diagonal = [&](std::size_t i) {
        double sum = 0;
        for (const Term<Real>* term : terms_) sum += term->diagonal(i);
        return sum;
    };
    for (std::size_t i = 0; i < n; ++i) {
        const double inertia = isPrescribed(i) ? 0 : time_.c1 * mass(i);
        const Vec3 x = scene_.store().position(i);
        rows_[i] = {inertia, {x[0], x[1], x[2]}};
        inverse_[i] = isPrescribed(i) ? Real(0) : static_cast<Real>(1 / (inertia + diagonal(i)));
    }
    if (rigid_) rigid_->factorise(time_.c1, diagonal, inverse_);
    shared().distribute(inverse_.data(), 1);
    shared().distribute(reinterpret_cast<double*>(rows_.data()), static_cast<int>(particles::fieldWidth));
}

template class System<double>;
template class System<float>;

}  // namespace corpuscle::implicit
