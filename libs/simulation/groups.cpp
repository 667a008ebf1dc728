#include "simulation/groups.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace corpuscle::simulation {

namespace {

class Groups {
  public:
    // whose: name of a cell or body; empty: the whole case. A group of a cell or body is not repeated if another one
    // has it with the same value.
    void add(const std::string& symbol, double number, std::string text, const std::string& whose = "") {
        std::string value = fmt::format("{:.4g}", number);
        const auto of = [&](const Group& g) { return g.symbol == symbol; };
        if (!whose.empty() &&
            std::any_of(groups_.begin(), groups_.end(), [&](const Group& g) { return of(g) && g.value == value; }))
            return;
        if (first_.empty()) first_ = whose;
        groups_.push_back({whose.empty() || whose == first_ ? symbol : fmt::format("{} ({})", symbol, whose),
                           std::move(value), std::move(text), number, symbol});
    }
    std::vector<Group> take() { return std::move(groups_); }

  private:
    std::string first_;  // name of the first cell or body
    std::vector<Group> groups_;
};

void addReynolds(Groups& groups, const Case& c, double a, const std::string& whose) {
    std::string text = "rho gammadot a^2/mu";
    if (c.flow.densityFromRe) text += "; sets rho = " + formatQuantity(c.flow.density, unit::kilogramPerMetre3);
    groups.add("Re", c.flow.density * c.flow.rate * a * a / c.fluid.viscosity, std::move(text), whose);
}

void addResolution(Groups& groups, const Case& c, double a, const std::string& whose, const char* text) {
    groups.add("a/dx", a / c.spacing(), text, whose);
}

void addGap(Groups& groups, const Case& c, double a, const std::string& whose, const char* text) {
    if (const auto k = c.planesAcross()) groups.add("L/a", c.mesh.domain.size[*k] / a, text, whose);
}

void addCell(Groups& groups, const Case& c, const CellSettings& cell) {
    const membrane::MembraneSettings& laws = c.membraneOf(cell);
    const std::string& whose = cell.name;
    const double a = cell.shape->radius(), Gs = laws.moduli(cell.edge).shear;
    addReynolds(groups, c, a, whose);
    groups.add("Ca", capillaryNumber(c, cell),
               fmt::format("mu gammadot a/Gs, Gs = {} (closed form{})", formatQuantity(Gs, unit::newtonPerMetre),
                           laws.bonds ? ", hexagonal network" : ""),
               whose);
    const bool jump = laws.interior.viscosityRatio != 1 && !c.scheme().traits().isAdjoint;
    groups.add("lambda", laws.interior.viscosityRatio,
               jump ? "viscosity inside/outside; dual identity holds back the rotation of the inside, coupling: "
                      "immersed does not"
                    : "viscosity inside/outside",
               whose);
    if (laws.viscosity)
        groups.add("Bq", laws.viscosity->shear / (c.fluid.viscosity * a),
                   laws.viscosity->thinning ? "Boussinesq number: shear viscosity of the membrane at rest over mu a"
                                            : "Boussinesq number: shear viscosity of the membrane over mu a",
                   whose);
    if (laws.bending) {
        const double kappa = laws.bending->bendingModulus({Gs, a});
        groups.add("E_b", kappa / (Gs * a * a),
                   fmt::format("kappa/(Gs a^2), kappa = {}", formatQuantity(kappa, unit::joule)), whose);
    }
    addGap(groups, c, a, whose, "gap between the walls over cell radius");
    addResolution(groups, c, a, whose, "particles per cell radius");
    groups.add("edge/dx", cell.edge / c.spacing(), "mesh edge over particle spacing", whose);
}

void addBody(Groups& groups, const Case& c, const BodyPlaceSettings& body) {
    const std::string& whose = body.name;
    const double a = body.shape->radius();
    addReynolds(groups, c, a, whose);
    groups.add("rho_b/rho", c.densityOf(body) / c.flow.density, "density of the body over that of the fluid", whose);
    addGap(groups, c, a, whose, "gap between the walls over the body's radius");
    addResolution(groups, c, a, whose, "particles per radius of the body");
}

}  // namespace

double capillaryNumber(const Case& c, const CellSettings& cell) {
    return c.fluid.viscosity * c.flow.rate * cell.shape->radius() / c.membraneOf(cell).moduli(cell.edge).shear;
}

std::vector<Group> dimensionlessGroups(const Case& c) {
    Groups groups;
    for (const CellSettings& cell : c.mesh.cells) addCell(groups, c, cell);
    if (c.mesh.cells.empty())
        for (const BodyPlaceSettings& body : c.mesh.bodies) addBody(groups, c, body);
    if (c.mesh.cells.empty() && c.mesh.bodies.empty())
        groups.add("Re", c.flow.speed * c.flow.length * c.flow.density / c.fluid.viscosity, "speed x length/nu");
    if (!c.fluid.layers.empty())
        groups.add("mu_max/mu_min", c.viscosities().largest / c.viscosities().least,
                   fmt::format("of {} layers; Re has the viscosity of the lowest", c.fluid.layers.size() + 1));
    groups.add("H_s/dx", c.support() / c.spacing(),
               fmt::format("kernel support; {} neighbours on the lattice{}",
                           c.numerics.kernel->latticeNeighbours(c.support() / c.spacing()),
                           c.numerics.operators == "corrected"
                               ? ""
                               : fmt::format(", viscosity error {:+.2f} %",
                                             100 * (c.numerics.kernel->secondMoment(c.support() / c.spacing()) - 1))));
    const double c0 = c.soundSpeed();
    groups.add("Ma", c.flow.speed / c0,
               fmt::format("largest speed/c0, c0 = {}{}", formatQuantity(c0, unit::metrePerSecond),
                           c.fluid.equationOfState->soundSpeed ? "" : " (automatic)"));
    return groups.take();
}

}  // namespace corpuscle::simulation
