#include "membrane/rim.hpp"

#include "membrane/elementTerm.hpp"

namespace corpuscle::membrane {

namespace {

struct LineTension {
    double tension;
    double energy(double l, double /*rest*/) const { return tension * l; }
    double derivative(double /*l*/, double /*rest*/) const { return tension; }
    double secondDerivative(double /*l*/, double /*rest*/) const { return 0; }
};

}  // namespace

std::unique_ptr<Term> Rim::makeTerm(Network& network) const {
    network.useRims();
    return std::make_unique<ElementTerm<RimLength, LineTension>>(network, LineTension{tension});
}

const Schema<Rim>& Rim::schema() {
    static const Schema<Rim> s =
        Schema<Rim>("rim", "the rims of holes")
            .quantity("tension", &Rim::tension, unit::newton, "line tension, the energy of a rim for each length",
                      {.range = positive});
    return s;
}

}  // namespace corpuscle::membrane
