#include "simulation/scheme.hpp"

namespace corpuscle::simulation {

namespace {

std::string couplingOf(const Case& c, const NumericsSettings& n) {
    if (n.coupling != "automatic") return n.coupling;
    return c.mesh.bodies.empty() || n.isImplicit() ? "immersed" : "dualIdentity";
}

}  // namespace

NumericsSettings schemeOf(const Case& c, const std::string& integrator) {
    NumericsSettings n = c.written;
    n.integrator = integrator;
    n.coupling = couplingOf(c, n);
    const bool immersed = n.isImmersed() && !c.mesh.cells.empty() && c.mesh.bodies.empty();
    if (n.operators == "automatic") n.operators = n.isImplicit() || (immersed && !n.isRkl2()) ? "corrected" : "plain";
    const auto file = c.files.find("system/numerics.yaml");
    if (n.isCorrected() && (file == c.files.end() || !file->second.find("shifting"))) n.shifting.emplace();
    if (!n.kernel->support) n.kernel.model = n.kernel->withSupport({n.kernel->usualSupport(n.isCorrected()), true});
    return n;
}

double jitterOf(const Case& c) {
    constexpr double usual = 0.1;
    const bool disordered = c.flowModel->isThreeDimensional() || (c.numerics.isImmersed() && !c.mesh.cells.empty());
    return c.mesh.fill.jitter.value_or(disordered ? usual : 0);
}

}  // namespace corpuscle::simulation
