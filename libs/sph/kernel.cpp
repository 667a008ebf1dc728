#include "sph/kernel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace corpuscle::sph {

namespace {

// A scalar with the operations that kernel formulas use.
struct Scalar {
    double v;
    Scalar(double value) : v(value) {}
    friend Scalar operator+(Scalar a, Scalar b) { return a.v + b.v; }
    friend Scalar operator-(Scalar a, Scalar b) { return a.v - b.v; }
    friend Scalar operator*(Scalar a, Scalar b) { return a.v * b.v; }
    friend Scalar operator/(Scalar a, Scalar b) { return a.v / b.v; }
    friend Scalar max(Scalar a, Scalar b) { return std::max(a.v, b.v); }
};

template <class Formula>
struct KernelOf : Kernel {
    static const Schema<KernelOf>& schema() {
        static const Schema<KernelOf> s =
            Schema<KernelOf>(Formula::name, "smoothing kernel")
                .length("support", static_cast<std::optional<Length> KernelOf::*>(&Kernel::support),
                        fmt::format("support radius H_s; absent: {:.1f} dx, with corrected operators {:.1f} dx",
                                    Formula::defaultSupport, Formula::correctedSupport),
                        {.range = positive});
        return s;
    }
    KernelKind kind() const override { return Kernels::kindOf<Formula>(); }
    double usualSupport(bool corrected) const override {
        return corrected ? Formula::correctedSupport : Formula::defaultSupport;
    }
    std::shared_ptr<const Kernel> withSupport(Length support) const override {
        auto copy = std::make_shared<KernelOf>(*this);
        copy->support = support;
        return copy;
    }
    double normalisation(double H) const override { return Formula::normalisation(H); }
    double gradientNormalisation(double H) const override { return Formula::gradientNormalisation(H); }
    double value(double q) const override { return Formula::template value<Scalar>(q).v; }
    double slope(double q) const override { return Formula::template slope<Scalar>(q).v; }
};

// f(distance along each axis, distance) for all neighbours on a lattice of spacing 1, the particle itself included.
template <class F>
void forLattice(double support, F&& f) {
    const int n = static_cast<int>(std::ceil(support));
    for (int i = -n; i <= n; ++i)
        for (int j = -n; j <= n; ++j)
            for (int k = -n; k <= n; ++k)
                if (const double r2 = i * i + j * j + k * k; r2 < support * support) f(Index3{i, j, k}, std::sqrt(r2));
}

}  // namespace

double Kernel::secondMoment(double supportOverSpacing) const {
    double sum = 0;
    forLattice(supportOverSpacing,
               [&](const Index3& d, double r) { sum += d[0] * d[0] * slope(r / supportOverSpacing); });
    return sum * gradientNormalisation(supportOverSpacing);
}

int Kernel::latticeNeighbours(double supportOverSpacing) const {
    int count = 0;
    forLattice(supportOverSpacing, [&](const Index3&, double) { ++count; });
    return count;
}

double Kernel::viscousRate(double supportOverSpacing) const {
    constexpr int parts = 8;
    double most = 0;
    for (int part = 0; part <= parts; ++part) {  // wave vectors (pi, pi, k), among which is that of the stiffest mode
        double sum = 0;
        forLattice(supportOverSpacing, [&](const Index3& d, double r) {
            const double sign = (d[0] + d[1]) % 2 ? -1 : 1;
            sum += 2 * slope(r / supportOverSpacing) * (1 - sign * std::cos(std::numbers::pi * part / parts * d[2]));
        });
        most = std::max(most, sum);
    }
    return most * gradientNormalisation(supportOverSpacing);
}

[[maybe_unused]] const bool areRegistered = [] {
    Kernels::each(
        []<class Formula>(KernelKind) { Registration<Kernel, KernelOf<Formula>>(Formula::name, Formula::text); });
    return true;
}();

}  // namespace corpuscle::sph
