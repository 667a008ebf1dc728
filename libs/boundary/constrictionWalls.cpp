// `constriction`: a round tube along x with a throat in the middle of the box: a capillary, or without a straight part
// a stenosis. The radius is R0 in the tube, Rt in the straight part of the throat, and between them
//     R(x) = (R0 + Rt)/2 + (R0 - Rt)/2 cos(pi (1 - u)),   u = (|x| - l/2)/t from 0 at the throat to 1 at the tube
// l: length of the straight part, t: length of each taper.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "boundary/revolvedTube.hpp"
#include "core/units.hpp"

namespace corpuscle::boundary {

namespace {

struct ThroatProfile : RadiusProfile {
    double wide, narrow, half, taper, period;
    ThroatProfile(double R0, double Rt, double l, double t, double length)
        : wide(R0), narrow(Rt), half(0.5 * l), taper(t), period(length) {}
    Value at(double x) const override {
        x -= period * std::round(x / period);
        const double u = (std::abs(x) - half) / taper;
        if (u <= 0) return {narrow, 0, 0};
        if (u >= 1) return {wide, 0, 0};
        const double rate = std::numbers::pi / taper, rise = 0.5 * (wide - narrow);
        const double c = std::cos(std::numbers::pi * u), s = std::sin(std::numbers::pi * u);
        return {0.5 * (wide + narrow) - rise * c, std::copysign(rise * rate * s, x), rise * rate * rate * c};
    }
};

struct ConstrictionWalls : RevolvedWalls {
    double diameter = 0, throat = 0;  // 2 R0, 2 Rt [m]
    double length = 0, taper = 0;     // l, t [m]
    static const Schema<ConstrictionWalls>& schema() {
        static const Schema<ConstrictionWalls> s =
            Schema<ConstrictionWalls>("constriction", "a round tube along x with a narrow throat in the middle")
                .quantity("diameter", &ConstrictionWalls::diameter, unit::metre, "of the tube", {.range = positive})
                .quantity("throat", &ConstrictionWalls::throat, unit::metre, "diameter of the throat",
                          {.range = positive})
                .quantity("length", &ConstrictionWalls::length, unit::metre,
                          "length of the straight part of the throat", {.fallback = "0 um", .range = nonNegative})
                .quantity("taper", &ConstrictionWalls::taper, unit::metre,
                          "length over which the tube narrows, on each side", {.range = positive});
        return s;
    }
    void check(const particles::Box& fluid, const Mark& mark, Problems& problems) const override {
        for (const int axis : {1, 2}) checkWidth("diameter", diameter, axis, fluid, mark, problems);
        if (!(throat < diameter))
            problems.add(
                mark, "walls.throat",
                fmt::format(
                    "found {}, which is not narrower than the tube, {}; make the throat narrower, or use 'type: "
                    "tube'",
                    formatQuantity(throat, unit::metre), formatQuantity(diameter, unit::metre)));
        if (const double all = length + 2 * taper; all > fluid.size()[0] * (1 + 1e-9))
            problems.add(mark, "walls.taper",
                         fmt::format("the throat and its two tapers are {} long, but the box of system/mesh.yaml has "
                                     "{} along x; make the box longer, or these shorter",
                                     formatQuantity(all, unit::metre), formatQuantity(fluid.size()[0], unit::metre)));
    }
    std::shared_ptr<const RadiusProfile> profile(double box) const override {
        return std::make_shared<ThroatProfile>(0.5 * diameter, 0.5 * throat, length, taper, box);
    }
};

CORPUSCLE_REGISTER(WallShape, ConstrictionWalls, "constriction", "a round tube along x with a narrow throat");

}  // namespace
}  // namespace corpuscle::boundary
