// `sinusoidalTube`: a round tube along x whose radius varies as a cosine, widest in the middle of the box:
//     R(x) = R0 (1 + e cos(2 pi n x/L)),   L the length of the box, n the number of waves in it
#include <cmath>
#include <numbers>

#include "boundary/revolvedTube.hpp"

namespace corpuscle::boundary {

namespace {

struct CosineProfile : RadiusProfile {
    double mean, amplitude, wavenumber;
    CosineProfile(double R0, double e, double k) : mean(R0), amplitude(e * R0), wavenumber(k) {}
    Value at(double x) const override {
        const double c = amplitude * std::cos(wavenumber * x), s = amplitude * std::sin(wavenumber * x);
        return {mean + c, -wavenumber * s, -wavenumber * wavenumber * c};
    }
};

struct SinusoidalTubeWalls : RevolvedWalls {
    double diameter = 0;   // 2 R0 [m]
    double amplitude = 0;  // e
    int waves = 1;         // n
    static const Schema<SinusoidalTubeWalls>& schema() {
        static const Schema<SinusoidalTubeWalls> s =
            Schema<SinusoidalTubeWalls>("sinusoidalTube", "a round tube along x whose radius varies as a cosine")
                .quantity("diameter", &SinusoidalTubeWalls::diameter, unit::metre, "mean diameter 2 R0",
                          {.range = positive})
                .quantity("amplitude", &SinusoidalTubeWalls::amplitude, unit::none, "amplitude of the radius over R0",
                          {.range = Range{0, 1, false, true}})
                .integer("waves", &SinusoidalTubeWalls::waves, "number of waves along the box",
                         {.fallback = "1", .range = atLeast(1)});
        return s;
    }
    void check(const particles::Box& fluid, const Mark& mark, Problems& problems) const override {
        for (const int axis : {1, 2}) checkWidth("diameter", diameter * (1 + amplitude), axis, fluid, mark, problems);
    }
    std::shared_ptr<const RadiusProfile> profile(double length) const override {
        return std::make_shared<CosineProfile>(0.5 * diameter, amplitude, 2 * std::numbers::pi * waves / length);
    }
};

CORPUSCLE_REGISTER(WallShape, SinusoidalTubeWalls, "sinusoidalTube",
                   "a round tube along x whose radius varies as a cosine");

}  // namespace
}  // namespace corpuscle::boundary
