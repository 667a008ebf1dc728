#include "schemes/choice.hpp"

#include <fmt/format.h>

#include "schemes/schemeParts.hpp"

namespace corpuscle::schemes {

NumericsSettings settled(const NumericsSettings& written, const CaseFacts& facts, const std::string& integrator) {
    NumericsSettings n = written;
    n.integrator = integrator;
    const std::string name = n.isAutomatic() ? "velocityVerlet" : integrator;
    n.scheme = n.tables.of(name);
    if (const auto own = n.scheme->settled(facts)) n.scheme = n.tables.models[name] = own;
    if (n.coupling == "automatic") n.coupling = n.scheme->usualCoupling(facts);
    if (n.operators == "automatic") n.operators = n.scheme->usualOperators(facts, n);
    if (n.isCorrected() && !facts.isWritten("shifting")) n.shifting.emplace();
    if (!n.kernel->support) n.kernel.model = n.kernel->withSupport({n.kernel->usualSupport(n.isCorrected()), true});
    if (const auto variant = n.scheme->variant(facts, n)) n.scheme = variant;
    return n;
}

namespace {

void checkScheme(const NumericsSettings& settled, const CaseFacts& facts, const std::string& integrator,
                 Problems& problems) {
    settled.scheme->check(facts, settled, problems);
    if (facts.hasContact && !settled.scheme->traits().hasContact)
        problems.add(numericsFile, "integrator",
                     "found " + integrator +
                         ", which knows no contact of membranes; write 'integrator: implicit', or remove "
                         "constant/contact.yaml");
    if (facts.slides && !settled.scheme->traits().knowsSlides)
        problems.add(numericsFile, "integrator",
                     "found " + integrator +
                         ", which does not know periodic images that slide; write 'integrator: implicit', or take "
                         "another flow in constant/flow.yaml");
}

}  // namespace

std::string whyNot(const NumericsSettings& written, const CaseFacts& facts, const std::string& integrator) {
    const NumericsSettings named = settled(written, facts, integrator);
    Problems problems;
    checkScheme(named, facts, integrator, problems);
    try {
        problems.throwIfAny();
    } catch (const CaseError& error) {
        const Problem& first = error.problems().front();
        const std::string reason = first.message.substr(0, first.message.find(';'));
        return first.key == "integrator" ? reason : first.key + ": " + reason;
    }
    return "";
}

namespace {

void checkAutomatic(const NumericsSettings& written, const CaseFacts& facts, Problems& problems) {
    std::string all;
    for (const std::string& name : Registry<Scheme>::instance().names()) {
        const std::string why = whyNot(written, facts, name);
        if (why.empty()) return;
        all += fmt::format("{}{}: {}", all.empty() ? "" : "; ", name, why);
    }
    problems.add(numericsFile, "integrator",
                 "found automatic, but no integrator can do this case (" + all +
                     "); name the one that is to do it, and follow what that message says");
}

}  // namespace

void check(const NumericsSettings& settled, const NumericsSettings& written, const CaseFacts& facts,
           Problems& problems) {
    if (settled.isAutomatic())
        checkAutomatic(written, facts, problems);
    else
        checkScheme(settled, facts, settled.integrator, problems);
    for (const Scheme::UnusedKey& key : settled.scheme->unused(settled))
        if (const Node* const found = facts.find(key.path))
            problems.add(found->mark, found->path,
                         "found " + found->scalar + ", which means nothing " + key.why + "; remove this key");
}

}  // namespace corpuscle::schemes
