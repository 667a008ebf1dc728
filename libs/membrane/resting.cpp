#include "membrane/resting.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<Resting>& Resting::schema() {
    static const Schema<Resting> s =
        Schema<Resting>("resting", "the shape of least energy, without loads")
            .quantity("shake", &Resting::shake, unit::metre, "largest random displacement of the nodes at the start",
                      {.fallback = "0 m", .range = atLeast(0)})
            .integer("seed", &Resting::seed, "of the random numbers", {.fallback = "1", .range = atLeast(0)});
    return s;
}

Loads Resting::apply(int, Membrane& membrane) const {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::uniform_real_distribution<double> part(-shake, shake);
    for (Vec3& x : membrane.position) {
        for (int k = 0; k < 3 && shake > 0; ++k) {
            x[k] += part(random);
        }
    }
    return {};
}

std::string Resting::describe(int) const { return "no load"; }

std::vector<Protocol::Column> Resting::columns() const {
    return {{"extentX", "m", "extent along x"},
            {"extentY", "m", "extent along y"},
            {"extentZ", "m", "extent along z"},
            {"reducedVolume", "", "volume over that of a sphere with the same area"}};
}

std::vector<double> Resting::measure(int, const Membrane& membrane) const {
    Vec3 low = membrane.position.front(), high = low;
    for (const Vec3& x : membrane.position) {
        low = low.cwiseMin(x), high = high.cwiseMax(x);
    }
    const Vec3 size = high - low;
    const double radius = std::sqrt(membrane.area() / (4 * std::numbers::pi));
    return {size[0], size[1], size[2], membrane.volume() / (4 * std::numbers::pi / 3 * radius * radius * radius)};
}

CORPUSCLE_REGISTER(Protocol, Resting, "resting", "the shape of least energy, without loads");

}  // namespace corpuscle::membrane
