// Budget of energy, momentum, mass and volume of a scene since somebody began to look (docs/theory/conservation.md);
// the columns of budget.csv of the observer `conservation`, and its lines at the end of a run.
#pragma once
#include <array>

#include "observers/observer.hpp"
#include "observers/summary.hpp"

namespace corpuscle::observers {

class BudgetTable {
  public:
    explicit BudgetTable(const Scene& scene);  // begins now. Collective

    static std::vector<io::Column> columns(const SceneParts& parts);
    std::vector<double> row(const Scene& scene) const;  // collective
    Summary summary(const Scene& scene) const;          // collective

    std::vector<double> state() const;
    void setState(std::span<const double> saved);

  private:
    // What depends on the state alone.
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
        sph::Budget::Values work;                                // since the beginning, of all ranks
        double elastic, compression, kinetic;                    // changes of what is stored
        double dissipated, residual, share;                      // share: |residual| over the largest of the entries
        double ofInertia, ofMembranes, ofCompression, ofSolver;  // what the residual is made of
        Vec3 momentum, drift, angular;  // of momentum: change, and what is not explained by forces; angular: change
        double driftShare;              // over what walls exchanged and the momentum of all particles
        double mass, volume;            // changes, relative
    };
    Balance balance(const Scene& scene) const;

    SceneParts parts_;
    Content start_;
    sph::Budget::Values before_;  // what the budget held at the beginning
};

}  // namespace corpuscle::observers
