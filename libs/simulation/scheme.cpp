#include "simulation/scheme.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace corpuscle::simulation {

namespace {

std::string couplingOf(const Case& c, const NumericsSettings& n) {
    if (n.coupling != "automatic") return n.coupling;
    return c.mesh.bodies.empty() || n.isImplicit() ? "immersed" : "dualIdentity";
}

// Whether system/numerics.yaml has this key.
bool names(const Case& c, std::initializer_list<std::string_view> path) {
    const auto file = c.files.find("system/numerics.yaml");
    const Node* at = file == c.files.end() ? nullptr : &file->second;
    for (const std::string_view key : path) at = at ? at->find(key) : nullptr;
    return at;
}

}  // namespace

NumericsSettings schemeOf(const Case& c, const std::string& integrator) {
    NumericsSettings n = c.written;
    n.integrator = integrator;
    n.coupling = couplingOf(c, n);
    const bool immersed = n.isImmersed() && !c.mesh.cells.empty() && c.mesh.bodies.empty();
    if (n.operators == "automatic") n.operators = n.isImplicit() || (immersed && !n.isRkl2()) ? "corrected" : "plain";
    if (n.isCorrected() && !names(c, {"shifting"})) n.shifting.emplace();
    if (c.flow.transient > 0 && !names(c, {"implicit", "step"}))
        n.implicit.step = std::min(n.implicit.step, longestStep(c.flow) * c.flow.rate);
    if (!n.kernel->support) n.kernel.model = n.kernel->withSupport({n.kernel->usualSupport(n.isCorrected()), true});
    return n;
}

double longestStep(const sph::FlowState& flow) {
    constexpr double stepsPerTransient = 40;
    return flow.transient / stepsPerTransient;
}

double jitterOf(const Case& c) {
    constexpr double usual = 0.1;
    const bool disordered = c.flowModel->isThreeDimensional() || (c.numerics.isImmersed() && !c.mesh.cells.empty());
    return c.mesh.fill.jitter.value_or(disordered ? usual : 0);
}

}  // namespace corpuscle::simulation
