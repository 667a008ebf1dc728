#include "implicit/preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "implicit/coarseGrid.hpp"
#include "implicit/membraneCorrection.hpp"

namespace corpuscle::implicit {

namespace {

// Resistance of a node's membrane over mu dx above which the preconditioner with membranes is the cheaper one
// (docs/implicit.md).
constexpr double stiffMembrane = 50;

template <class Real>
using Field = typename Preconditioner<Real>::Field;

template <class Real>
void applyDiagonal(const Field<Real>& inverse, const Field<Real>& r, Field<Real>& z) {
    for (std::size_t i = 0; i < inverse.size(); ++i) {
        const std::size_t at = particles::fieldWidth * i;
        for (std::size_t k = 0; k < 3; ++k) z[at + k] = inverse[i] * r[at + k];
        z[at + 3] = 0;
    }
}

template <class Real>
class BlockJacobi final : public Preconditioner<Real> {
  public:
    explicit BlockJacobi(System<Real>& system) : system_(system) {}
    void prepare() override {}
    void apply(const Field<Real>& r, Field<Real>& z) override { applyDiagonal<Real>(system_.inverseDiagonal(), r, z); }

  private:
    System<Real>& system_;
};

template <class Real>
class TwoLevel : public Preconditioner<Real> {
  public:
    explicit TwoLevel(System<Real>& system)
        : system_(system), grid_(system.scene().fluidBox, CoarseGrid::spacingInParticles * system.scene().spacing) {}

    void prepare() override {
        const sph::FluidModel& model = system_.scene().model();
        const double bulk = model.equationOfState->bulkModulus(model.density, model.density, model.soundSpeed);
        grid_.setCoefficients(system_.time().c1 * model.density + model.viscosity * missingConfinement(),
                              model.viscosity, system_.time().reach.total() * bulk,
                              system_.scene().system->periodicity());
        const std::size_t own = system_.owned(), all = system_.entries();
        grid_.begin(own, all - own);
        for (std::size_t i = 0; i < all; ++i)
            if (const auto& row = system_.row(i); row.inertia > 0) grid_.place(i, Vec3::Map(row.place));
    }
    void apply(const Field<Real>& r, Field<Real>& z) override {
        applyDiagonal<Real>(system_.inverseDiagonal(), r, z);
        grid_.add(system_.scene().system->comm(), r.data(), z.data());
    }

  protected:
    System<Real>& system_;
    CoarseGrid grid_;

  private:
    // The grid has walls across one axis at most. Where others confine the fluid as well, as in a tube, a friction
    // makes its slowest velocity decay as fast as that of the fluid: the rate over the viscosity [1/m^2].
    double missingConfinement() const {
        const particles::Box& box = system_.scene().fluidBox;
        double ofGrid = 0;
        for (int k = 0; k < 3; ++k)  // as CoarseGrid: walls across the last of these axes
            if (!box.periodic[static_cast<std::size_t>(k)]) ofGrid = std::pow(std::numbers::pi / box.size()[k], 2);
        return std::max(0.0, system_.scene().flow.confinement - ofGrid);
    }
};

template <class Real>
class WithMembrane final : public TwoLevel<Real> {
  public:
    // always: with the membranes however soft they are.
    WithMembrane(System<Real>& system, bool always) : TwoLevel<Real>(system), always_(always) {}

    void prepare() override {
        TwoLevel<Real>::prepare();
        isIn_ = system_.immersed() && (always_ || isStiff());
        if (isIn_)
            system_.immersed()->placeOthers(*system_.scene().system, system_.shared(), system_.operators().volumes());
    }
    void apply(const Field<Real>& r, Field<Real>& z) override {
        if (!isIn_) return TwoLevel<Real>::apply(r, z);
        correction_.apply(system_.scene().system->comm(), *system_.immersed(), this->grid_,
                          system_.time().reach.total(), system_.inverseDiagonal(), system_.owned(), r, z);
    }
    long takeInnerIterations() override { return correction_.takeIterations(); }

  private:
    using TwoLevel<Real>::system_;
    bool isStiff() const {
        const double fluid = system_.scene().model().viscosity * system_.scene().spacing;  // around a node
        return system_.immersed()->meanResistance(system_.time().reach.total()) > stiffMembrane * fluid;
    }
    bool always_, isIn_ = false;
    MembraneCorrection<Real> correction_;
};

template <class Real>
class AroundBodies final : public Preconditioner<Real> {
  public:
    AroundBodies(RigidUnknowns<Real>& rigid, std::unique_ptr<Preconditioner<Real>> inner)
        : rigid_(rigid), inner_(std::move(inner)) {}
    void prepare() override { inner_->prepare(); }
    void apply(const Field<Real>& r, Field<Real>& z) override {
        inner_->apply(rigid_.distribute(r), z);
        rigid_.project(z);
    }
    long takeInnerIterations() override { return inner_->takeInnerIterations(); }

  private:
    RigidUnknowns<Real>& rigid_;
    std::unique_ptr<Preconditioner<Real>> inner_;
};

template <class Real>
std::unique_ptr<Preconditioner<Real>> ofParticles(const std::string& name, System<Real>& system) {
    if (name == "blockJacobi") return std::make_unique<BlockJacobi<Real>>(system);
    if (name == "twoLevel") return std::make_unique<TwoLevel<Real>>(system);
    if (name == "withMembrane") return std::make_unique<WithMembrane<Real>>(system, true);
    if (name == "automatic") return std::make_unique<WithMembrane<Real>>(system, false);
    throw std::invalid_argument("there is no preconditioner '" + name + "'");
}

}  // namespace

bool isOnGrid(const std::string& name) { return name != "blockJacobi"; }

template <class Real>
std::unique_ptr<Preconditioner<Real>> makePreconditioner(const std::string& name, System<Real>& system) {
    std::unique_ptr<Preconditioner<Real>> made = ofParticles(name, system);
    if (!system.rigid()) return made;
    return std::make_unique<AroundBodies<Real>>(*system.rigid(), std::move(made));
}

template std::unique_ptr<Preconditioner<double>> makePreconditioner(const std::string&, System<double>&);
template std::unique_ptr<Preconditioner<float>> makePreconditioner(const std::string&, System<float>&);

}  // namespace corpuscle::implicit
