#include "membrane/poreLaw.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "membrane/surface.hpp"

namespace corpuscle::membrane {

double PoreLaw::after(double share, double atRest, double dt) const {
    const double tau = atRest > share ? opening : resealing;
    return tau > 0 ? atRest + (share - atRest) * std::exp(-dt / tau) : atRest;
}

double PoreLaw::permeability(double share, const PoreSolute& solute) const {
    const double l = solute.radius / radius;
    if (l >= 1 || share <= 0 || solute.diffusivity <= 0) return 0;
    const double l2 = l * l, l3 = l2 * l;
    const double hindered = (1 - l) * (1 - l) * (1 - 2.104 * l + 2.09 * l3 - 0.95 * l2 * l3);
    return share * solute.diffusivity / (length / hindered + 0.5 * std::numbers::pi * radius);
}

double PoreLaw::flow(double share, double pressure, double viscosity) const {
    return share * pressure / (viscosity * (8 * length / (radius * radius) + 3 * std::numbers::pi / radius));
}

PoreFlux PoreLaw::flux(double share, double pressure, const PoreSolute& solute) const {
    const double l = solute.radius / radius;
    if (l >= 1 || share <= 0) return {};
    const double partition = (1 - l) * (1 - l);
    const double sieved = partition * (2 - partition) * (1 - 2.0 / 3 * l * l - 0.163 * l * l * l);
    const double carried = sieved * flow(share, pressure, solute.viscosity);
    const double P = permeability(share, solute);
    if (P <= 0) return {std::max(carried, 0.0), std::max(-carried, 0.0)};
    const double peclet = carried / P;
    constexpr double tiny = 1e-8, huge = 500;  // where the formula loses digits, or overflows
    if (std::abs(peclet) < tiny) return {P + 0.5 * carried, P - 0.5 * carried};
    if (std::abs(peclet) > huge) return {std::max(carried, 0.0), std::max(-carried, 0.0)};
    const double inward = carried / std::expm1(peclet);
    return {inward + carried, inward};
}

const Schema<PoreLaw>& PoreLaw::schema() {
    static constexpr Range ofPores{0, 1e-6, true, false};  // far below triangles
    static const Schema<PoreLaw> s =
        Schema<PoreLaw>("pores", "keys of every pore law")
            .quantity("radius", &PoreLaw::radius, unit::metre,
                      "radius of a pore; greater than that of the solute's molecules", {.range = ofPores})
            .quantity("length", &PoreLaw::length, unit::metre, "length of a pore: the thickness of the membrane",
                      {.fallback = "8 nm", .range = ofPores})
            .quantity("opening", &PoreLaw::opening, unit::second, "time in which pores open; 0: at once",
                      {.fallback = "0 s", .range = nonNegative})
            .quantity("resealing", &PoreLaw::resealing, unit::second, "time in which pores reseal; 0: at once",
                      {.fallback = "0 s", .range = nonNegative});
    return s;
}

std::vector<double> nodeMeans(const Network& network, std::span<const double> ofTriangles, std::span<const Vec3> x) {
    std::vector<double> sum(network.nodeCount(), 0.0), area(network.nodeCount(), 0.0);
    for (const int t : network.wholeTriangles()) {
        const Index3& corner = network.triangles()[static_cast<std::size_t>(t)];
        const double a = areaVector(x, corner).norm();
        for (const int n : corner) {
            sum[static_cast<std::size_t>(n)] += a * ofTriangles[static_cast<std::size_t>(t)];
            area[static_cast<std::size_t>(n)] += a;
        }
    }
    for (std::size_t n = 0; n < sum.size(); ++n)
        if (area[n] > 0) sum[n] /= area[n];
    return sum;
}

}  // namespace corpuscle::membrane
