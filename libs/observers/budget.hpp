// Budget of energy, momentum, mass and volume of a scene since this object was made (docs/theory/conservation.md); the
// columns of budget.csv of the observer `conservation`, and its lines at the end of a run.
#pragma once
#include <array>

#include "observers/observer.hpp"
#include "observers/summary.hpp"

namespace corpuscle::observers {

class BudgetTable {
  public:
    explicit BudgetTable(const Scene& scene);  // the budget starts now. Collective

    static std::vector<io::Column> columns(const SceneParts& parts);
    std::vector<double> row(const Scene& scene) const;  // collective
    Summary summary(const Scene& scene) const;          // collective

    std::vector<double> state() const;
    void setState(std::span<const double> saved);

  private:
    // Quantities that depend on the present state alone.
    struct Content {
        double kinetic = 0, elastic = 0, compression = 0;  // energies [J]; compression: of walls and bodies, too
        double mass = 0, volume = 0;                       // of fluid and nodes [kg], and sum of m/rho [m^3]
        double speeds = 0;                                 // sum of m |u| [N s]
        double momentum[3] = {0, 0, 0};                    // with bodies [N s]
        double angular[3] = {0, 0, 0};                     // about the middle of the box [N m s]
    };
    static constexpr std::size_t contentLength = sizeof(Content) / sizeof(double);
    using Numbers = std::array<double, contentLength>;
    static Content contentOf(const Scene& scene);
    static Content contentFrom(std::span<const double> numbers);

    struct Balance {
        sph::Budget::Values work;                                // since the start, of all ranks
        double elastic, compression, kinetic;                    // changes of the stored energies
        double dissipated, residual, share;                      // share: |residual| over the largest of the entries
        double ofInertia, ofMembranes, ofCompression, ofSolver;  // parts of the residual
        Vec3 momentum, drift, angular;  // momentum, angular: changes; drift: change of momentum that no force explains
        double driftShare;              // drift over the momentum exchanged, or over sum m |u| if that is larger
        double mass, volume;            // relative changes
    };
    Balance balance(const Scene& scene) const;

    SceneParts parts_;
    Content start_;
    sph::Budget::Values before_;  // values of the scene's budget at the start
};

}  // namespace corpuscle::observers
