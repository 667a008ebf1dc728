#include "contact/barrierMorse.hpp"

#include <cmath>

#include "core/registry.hpp"

namespace corpuscle::contact {
namespace {

// C(z): 1 for z <= 0, 0 for z >= 1, with two continuous derivatives.
ContactLaw::Value ending(double z) {
    if (z <= 0) return {1, 0, 0};
    if (z >= 1) return {};
    const double left = 1 - z;
    return {1 - z * z * z * (10 - z * (15 - 6 * z)), -30 * z * z * left * left, -60 * z * left * (1 - 2 * z)};
}

}  // namespace

ContactLaw::Value BarrierMorse::at(double gap) const {
    if (gap >= cutoff) return {};
    Value sum = Barrier::at(gap);
    const double e = std::exp(-(gap - rest) / decay), width = cutoff - rest;
    const Value morse{depth * e * (e - 2), 2 * depth / decay * e * (1 - e),
                      2 * depth / (decay * decay) * e * (2 * e - 1)};
    const Value end = ending((gap - rest) / width);
    sum.energy += morse.energy * end.energy;
    sum.slope += morse.slope * end.energy + morse.energy * end.slope / width;
    sum.curvature += morse.curvature * end.energy + 2 * morse.slope * end.slope / width +
                     morse.energy * end.curvature / (width * width);
    return sum;
}

const Schema<BarrierMorse>& BarrierMorse::schema() {
    static const Schema<BarrierMorse> s =
        Schema<BarrierMorse>("barrier with attraction",
                             "surfaces attract each other and repel without limit as their gap closes")
            .include<Barrier>()
            .quantity("depth", &BarrierMorse::depth, unit::newtonPerMetre,
                      "energy per area that separates resting surfaces", {.range = positive})
            .quantity("rest", &BarrierMorse::rest, unit::metre, "gap of resting surfaces, not below reach",
                      {.range = positive})
            .quantity("decay", &BarrierMorse::decay, unit::metre, "decay length of the attraction", {.range = positive})
            .quantity("cutoff", &BarrierMorse::cutoff, unit::metre, "gap at which the attraction ends, above rest",
                      {.range = positive})
            .check([](const BarrierMorse& law, const Node& node, Problems& problems) {
                if (law.rest < law.length) {
                    problems.add(node.place(), node.path,
                                 "rest is below reach: the barrier would move the gap of resting surfaces; give a "
                                 "rest of at least reach");
                }
                if (law.cutoff <= law.rest) {
                    problems.add(node.place(), node.path, "cutoff is not above rest; give a cutoff above rest");
                }
            });
    return s;
}

CORPUSCLE_REGISTER(ContactLaw, BarrierMorse, "barrierMorse",
                   "surfaces attract each other and repel without limit as their gap closes");

}  // namespace corpuscle::contact
