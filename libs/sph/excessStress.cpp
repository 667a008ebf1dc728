#include "sph/excessStress.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sph/viscousLayers.hpp"

namespace corpuscle::sph {

using particles::ParticleSystem;

namespace {

constexpr double otherWeight = 0.02;  // least weight of neighbours, for those in the less viscous fluid
constexpr double leastShare = 1e-3;   // of the more viscous fluid; with less a particle has no one-sided stress
constexpr double pure = 1e-6;         // if p or 1 - p is below this, there is only one fluid around the particle

using Six = Eigen::Matrix<double, 6, 1>;

Six vectorOf(const Mat3& e) {
    constexpr double r = std::numbers::sqrt2;
    return (Six() << e(0, 0), e(1, 1), e(2, 2), r * e(0, 1), r * e(0, 2), r * e(1, 2)).finished();
}
Mat3 tensorOf(const Six& v) {
    constexpr double r = 1 / std::numbers::sqrt2;
    Mat3 e;
    e << v[0], r * v[3], r * v[4], r * v[3], v[1], r * v[5], r * v[4], r * v[5], v[2];
    return e;
}

}  // namespace

std::vector<Inside> insideByCentre(const particles::ParticleStore& store, double outside) {
    std::vector<Inside> inside(store.size());
    for (std::size_t i = 0; i < store.size(); ++i)
        if (store.viscosity[i] != outside) inside[i] = {1, store.viscosity[i]};
    return inside;
}

// Per particle, owned before ghosts: x y z, volume, f, f (mu_in - mu), f kappa, a vector along the gradient of p (3).
struct ExcessStress::Records {
    static constexpr int fields = 10, gradientAt = 7;
    ParticleSystem& system;
    double H;
    particles::RealArray values;

    const double* of(std::size_t k) const { return values.data() + fields * k; }
    Vec3 position(std::size_t k) const { return Vec3::Map(of(k)); }
    Vec3 gradient(std::size_t k) const { return Vec3::Map(of(k) + gradientAt); }
    void exchangeGradients() {
        const particles::Halo::Part part{gradientAt, fields};
        system.halo().begin(values.data(), system.owned(), fields, part);
        system.halo().finish(values.data(), system.owned(), fields, part);
    }
    // Finds all records within the support around x, that of the particle at x included.
    void findNear(const Vec3& x, std::vector<int>& near) const {
        const double reach = H + 0.5 * system.skin();  // the search uses positions at the time when lists were built
        const auto each = [&](int k) {
            if ((position(static_cast<std::size_t>(k)) - x).squaredNorm() < H * H) near.push_back(k);
        };
        near.clear();
        system.forOwnedNear(x, reach, each);
        system.forGhostsNear(x, reach, [&](int g) { each(system.owned() + g); });
    }
    // f(record, d, q) for each record of `near`, d its position relative to x and q = |d|/H.
    template <class F>
    void forThese(std::span<const int> near, const Vec3& x, F&& f) const {
        for (const int k : near) {
            const Vec3 d = position(static_cast<std::size_t>(k)) - x;
            f(static_cast<std::size_t>(k), d, d.norm() / H);
        }
    }
};

// The tensor that maps e to tr(e) 1, with symmetric tensors as vectors.
static const Eigen::Matrix<double, 6, 6>& traceOf() {
    static const Eigen::Matrix<double, 6, 6> J = [] {
        const Six one = vectorOf(Mat3::Identity());
        return Eigen::Matrix<double, 6, 6>(one * one.transpose());
    }();
    return J;
}

Mat3 ExcessStress::stressOf(const Tensor& viscosity, const Mat3& gradient) {
    return tensorOf(viscosity * vectorOf(gradient + gradient.transpose()));
}

Mat3 ExcessStress::stress(std::size_t i, const Mat3& gradient) const {
    if (mixed_[i] < 0)
        return mean_[i] * (gradient + gradient.transpose()) -
               std::min(mean_[i], 0.0) * gradient.trace() * Mat3::Identity();
    return stressOf(viscosities_[static_cast<std::size_t>(mixed_[i])], gradient);
}

double ExcessStress::filmCoefficient(double ratio, double supportOverSpacing) {
    const auto [at, isNew] = film_.try_emplace(ratio, 0.0);
    if (isNew) at->second = ViscousLayers(*model_.kernel, supportOverSpacing).filmCoefficient(ratio);
    return at->second;
}

void ExcessStress::build(ParticleSystem& system, const particles::SharedParticles& shared,
                         const std::vector<double>& volume, const std::vector<Inside>& inside) {
    const std::size_t n = shared.owned(), all = n + static_cast<std::size_t>(system.ghosts());
    const double mu = model_.viscosity, H = system.support();
    mean_.assign(n, 0.0), mixed_.assign(n, -1);
    viscosities_.clear(), oneSided_.clear(), neighbours_.clear();

    Records records{system, H, {}};
    records.values.assign(Records::fields * all, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        double* r = records.values.data() + Records::fields * i;
        Vec3::Map(r) = system.store().position(i);
        r[3] = volume[i];
        if (inside[i].share == 0) continue;
        r[4] = inside[i].share;
        r[5] = inside[i].share * (inside[i].viscosity - mu);
        r[6] = inside[i].share * filmCoefficient(inside[i].viscosity / mu, H / system.spacing());
    }
    system.halo().exchange(records.values.data(), system.owned(), Records::fields);

    std::vector<char> isNear(n, 0);  // whether a particle lies near one that is partly or fully within a membrane
    for (std::size_t k = 0; k < all; ++k)
        if (records.of(k)[4] > 0)
            system.forOwnedNear(records.position(k), H + 0.5 * system.skin(),
                                [&](int i) { isNear[static_cast<std::size_t>(i)] = 1; });

    std::vector<std::size_t> mixed, first{0};
    std::vector<int> near, nearMixed;  // neighbours of mixed[k]: nearMixed[first[k]] to nearMixed[first[k + 1] - 1]
    for (std::size_t i = 0; i < n; ++i) {
        if (!isNear[i]) continue;
        records.findNear(records.position(i), near);
        double sum = 0, share = 0, excess = 0;
        Vec3 ofShare = Vec3::Zero(), ofOne = Vec3::Zero();
        records.forThese(near, records.position(i), [&](std::size_t k, const Vec3& d, double q) {
            const double *r = records.of(k), w = r[3] * model_.kernel->value(q), slope = r[3] * model_.kernel->slope(q);
            sum += w, share += w * r[4], excess += w * r[5];
            ofShare += slope * r[4] * d, ofOne += slope * d;
        });
        const double p = share / sum;
        mean_[i] = excess / sum;
        if (p < pure)
            mean_[i] = 0;
        else if (p < 1 - pure) {
            mixed.push_back(i);
            nearMixed.insert(nearMixed.end(), near.begin(), near.end());
            first.push_back(nearMixed.size());
            Vec3::Map(records.values.data() + Records::fields * i + Records::gradientAt) = ofShare - p * ofOne;
        }
    }
    records.exchangeGradients();
    for (std::size_t k = 0; k < mixed.size(); ++k)
        findMixed(records, std::span(nearMixed).subspan(first[k], first[k + 1] - first[k]), mixed[k], inside[mixed[k]]);
}

// In the means over normals, neighbours are weighted by the magnitude of the gradient of p.
void ExcessStress::findMixed(const Records& records, std::span<const int> near, std::size_t i, const Inside& inside) {
    const Vec3 x = records.position(i);
    double sum = 0, share = 0, excess = 0, kappa = 0, steepness = 0;
    Mat3 nn = Mat3::Zero();
    Tensor nnnn = Tensor::Zero();
    records.forThese(near, x, [&](std::size_t k, const Vec3&, double q) {
        const double *r = records.of(k), w = r[3] * model_.kernel->value(q);
        sum += w, share += w * r[4], excess += w * r[5], kappa += w * r[6];
        const Vec3 g = records.gradient(k);
        const double l = g.norm();
        if (l == 0) return;
        const Mat3 product = w / l * g * g.transpose();
        const Six v = vectorOf(product);
        nn += product, nnnn += v * v.transpose() / (w * l), steepness += w * l;
    });
    if (steepness > 0) nn /= steepness, nnnn /= steepness;
    Tensor P;
    for (int k = 0; k < 6; ++k) {
        const Mat3 e = tensorOf(Six::Unit(k));
        P.col(k) = vectorOf(nn * e + e * nn);
    }
    P -= 2 * nnnn;

    const double mu = model_.viscosity, p = share / sum, lambda = 1 + excess / (share * mu);
    const double across = mu * (ViscousLayers::laminate(p, lambda, kappa / share) - 1);
    Tensor viscosity = across * P;
    const Tensor inPlane = Tensor::Identity() - P;
    const bool isThicker = lambda > 1;  // whether the fluid inside is the more viscous one
    const auto ofThicker = [&](double f) { return isThicker ? f : 1 - f; };
    if (!isThicker) viscosity += mu * (lambda - 1) * inPlane;
    if (const double own = ofThicker(inside.share); own > leastShare) {
        OneSided one{i, neighbours_.size(), records.of(i)[3], own * mu * std::abs(lambda - 1) * inPlane};
        Mat3 moment = Mat3::Zero();
        records.forThese(near, x, [&](std::size_t k, const Vec3& d, double q) {
            const double* r = records.of(k);
            const double w = q > 0 ? r[3] * model_.kernel->slope(q) * std::max(ofThicker(r[4]), otherWeight) : 0;
            if (w == 0) return;
            moment += w * d * d.transpose();
            neighbours_.push_back({static_cast<int>(k), w * d});
        });
        const Mat3 B = moment.inverse();
        for (std::size_t m = one.first; m < neighbours_.size(); ++m) neighbours_[m].weight = B * neighbours_[m].weight;
        oneSided_.push_back(std::move(one));
    }
    const double least = std::min(across, isThicker ? 0.0 : mu * (lambda - 1));
    viscosity -= 0.5 * std::min(least, 0.0) * traceOf();
    mixed_[i] = static_cast<int>(viscosities_.size());
    viscosities_.push_back(viscosity);
}

}  // namespace corpuscle::sph
