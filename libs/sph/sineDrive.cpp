// `sine`: an oscillating drive, alone or on top of a steady one,
//     f = mean + amplitude sin(2 pi (nu t + phase)),   nu: frequency [Hz]
#include <cmath>
#include <numbers>

#include "sph/drive.hpp"

namespace corpuscle::sph {

namespace {

struct SineDrive : Drive {
    double frequency = 0, mean = 0, amplitude = 1, phase = 0;
    static const Schema<SineDrive>& schema() {
        static const Schema<SineDrive> s =
            Schema<SineDrive>("sine", "mean + amplitude sin(2 pi (frequency t + phase))")
                .quantity("frequency", &SineDrive::frequency, unit::perSecond, "periods in unit time",
                          {.range = positive})
                .quantity("mean", &SineDrive::mean, unit::none, "mean factor", {.fallback = "0"})
                .quantity("amplitude", &SineDrive::amplitude, unit::none, "amplitude of the factor",
                          {.fallback = "1", .range = positive})
                .quantity("phase", &SineDrive::phase, unit::none,
                          "fraction of a period that has passed at t = 0; 0.25 makes a cosine", {.fallback = "0"});
        return s;
    }
    double omega() const { return 2 * std::numbers::pi * frequency; }
    double factor(double t) const override {
        return mean + amplitude * std::sin(omega() * t + 2 * std::numbers::pi * phase);
    }
    double largest() const override { return std::abs(mean) + amplitude; }
    double changesIn() const override { return largest() / (amplitude * omega()); }
};

CORPUSCLE_REGISTER(Drive, SineDrive, "sine", "oscillates about a mean");

}  // namespace

}  // namespace corpuscle::sph
