#include "schemes/scheme.hpp"

#include "schemes/numericsSettings.hpp"

namespace corpuscle::schemes {

std::string Scheme::usualCoupling(const CaseFacts& facts) const {
    return facts.hasBodies ? "dualIdentity" : "immersed";
}

std::string Scheme::usualOperators(const CaseFacts&, const NumericsSettings&) const { return "plain"; }

// Decaying vortices stir the particles, and on stirred particles plain operators do not converge as the spacing
// decreases.
std::string Scheme::unfit(const CaseFacts& facts, const NumericsSettings& numerics) const {
    const bool stirs = facts.flow.transient > 0 && !facts.flow.settles;
    const Node* const operators = facts.find("operators");
    const bool isNamed = operators && operators->scalar != "automatic";
    if (!stirs || numerics.isCorrected() || isNamed) return "";
    return "its plain operators lose accuracy on the particles of vortices; 'operators: plain' would take them";
}

}  // namespace corpuscle::schemes
