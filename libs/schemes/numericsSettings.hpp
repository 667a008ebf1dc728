// system/numerics.yaml: how a case is discretised. One table for each scheme that has settings, under its name.
#pragma once
#include <optional>

#include "schemes/scheme.hpp"
#include "sph/kernel.hpp"
#include "sph/shifting.hpp"

namespace corpuscle::schemes {

struct NumericsSettings {
    double spacing = 0;  // dx [m]
    Choice<sph::Kernel> kernel;
    std::string integrator, coupling, operators, precision;
    std::optional<sph::ShiftingSettings> shifting;
    ModelTables<Scheme> tables;  // settings of the schemes
    Length skin;
    long guard = 10;                       // steps between two checks by the leakage guard; 0: none
    std::optional<long> densityBalance{};  // as written
    double safety = 0.95;                  // fraction of each limit that the step takes
    long rollbacks = 4;  // most in a row; each returns to an earlier state and goes on with shorter steps

    // The scheme that advances the case: null as read, set when absent and automatic keys have been settled
    // (choice.hpp).
    std::shared_ptr<const Scheme> scheme;

    double support() const { return kernel->support->metres(spacing); }  // [m]
    // Steps between two balances of density against volume; 0: none. With long steps, the correction by a rare balance
    // would be a jump of the pressure.
    long balanceInterval() const { return densityBalance.value_or(scheme->traits().stepsPerBalance); }
    bool isAutomatic() const { return integrator == "automatic"; }
    bool isImmersed() const { return coupling == "immersed"; }
    bool isCorrected() const { return operators == "corrected"; }
    static const Schema<NumericsSettings>& schema();
};

}  // namespace corpuscle::schemes
