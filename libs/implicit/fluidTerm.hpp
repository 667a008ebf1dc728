// The term of the fluid: viscosity, and pressure with the bulk stiffness.
//
//     load = D^T V (p^n + lead K D v0),   A = L + (middle + lead) D^T V K D,   K = rho c^2      (Reach of term.hpp)
// It uses the operators of sph/operators.hpp, which include walls and bodies. This term comes last: it adds up over the
// ranks the forces that it and the terms before it have exerted on particles that several ranks know.
#pragma once
#include "coupling/adjoint.hpp"
#include "coupling/scene.hpp"
#include "implicit/term.hpp"
#include "particles/vectorField.hpp"
#include "sph/operators.hpp"

namespace corpuscle::implicit {

template <class Real>
class FluidTerm final : public Term<Real> {
  public:
    using typename Term<Real>::Field;
    using typename Term<Real>::Forces;

    FluidTerm(const coupling::Scene& scene, const coupling::AdjointOptions& options)
        : scene_(scene),
          backgroundPressure_(options.backgroundPressure),
          operators_(scene.model(), *scene.system, options.form,
                     sph::NoSlip::ofImplicit(scene.system->spacing(), scene.system->support())) {}

    void prepare(const Reach& reach) override {
        operators_.build(*scene_.system);
        coupling::findPressures(scene_, backgroundPressure_, pressure_);
        const sph::FluidModel& model = scene_.model();
        stiffness_.resize(pressure_.size());
        for (std::size_t i = 0; i < stiffness_.size(); ++i)
            stiffness_[i] = reach.total() * model.equationOfState->bulkModulus(scene_.store().density[i], model.density,
                                                                               model.soundSpeed);
        leadShare_ = reach.lead / reach.total();
    }
    void addFirstForces(const Field& v0, Forces& forces) override {
        const auto pressure = [&](std::size_t i, double rate) {
            pressure_[i] += leadShare_ * stiffness_[i] * rate;
            return pressure_[i] - stiffness_[i] * rate;
        };
        operators_.addForces(*scene_.system, v0, sph::FieldOf::velocities, pressure, forces);
    }
    void addForces(const Field& v, Forces& forces) override {
        const auto pressure = [&](std::size_t i, double rate) { return pressure_[i] - stiffness_[i] * rate; };
        operators_.addForces(*scene_.system, v, sph::FieldOf::velocities, pressure, forces);
    }
    void addProduct(const Field& v, Forces& forces) override {
        const auto pressure = [&](std::size_t i, double rate) { return -stiffness_[i] * rate; };
        operators_.addForces(*scene_.system, v, sph::FieldOf::changes, pressure, forces);
    }
    double diagonal(std::size_t i) const override {
        return operators_.viscousDiagonal(i) + stiffness_[i] * operators_.bulkDiagonal(i);
    }

    double slidingPower(const Field& v, const std::vector<double>& divergence, const Field& w) override {
        using particles::vectorAt;
        Forces force(particles::fieldWidth * operators_.shared().entries(), 0.0);  // -L w
        operators_.addForces(
            *scene_.system, w, sph::FieldOf::velocities, [](std::size_t, double) { return 0.0; }, force);
        double power = 0;
        for (std::size_t i = 0; i < stiffness_.size(); ++i)
            power += vectorAt(v, i).dot(vectorAt(force, i)) +
                     operators_.volume(i) * pressure(i, divergence[i]) * operators_.divergence(i);
        return power;
    }

    sph::Operators<Real>& operators() { return operators_; }
    const sph::Operators<Real>& operators() const { return operators_; }
    double pressure(std::size_t i) const { return pressure_[i]; }  // that in the load [Pa]
    double pressure(std::size_t i, double divergence) const {
        return pressure_[i] - stiffness_[i] * divergence;
    }  // the acting one, at this divergence [Pa]

  private:
    const coupling::Scene& scene_;
    double backgroundPressure_;  // [Pa]
    sph::Operators<Real> operators_;
    particles::RealArray pressure_;
    std::vector<double> stiffness_;  // (middle + lead) K [Pa s]
    double leadShare_ = 0;           // lead/(middle + lead)
};

}  // namespace corpuscle::implicit
