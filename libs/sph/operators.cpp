#include "sph/operators.hpp"

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/together.hpp"

namespace corpuscle::sph {

using particles::Kind;
using particles::ParticleStore;
using particles::ParticleSystem;

namespace {
constexpr int rateFields = 16, momentFields = 4, stressAt = 4, stressFields = 10, varyingStressFields = 13;
constexpr particles::Halo::Part velocityPart{3, 6};
constexpr int volumeAt = 6, scaleAt = 7, correctionAt = 8, viscosityAt = 14, gapAt = 15;
constexpr int gradientSums = 16, gradientAt = 4;  // of gradientPair.hpp
constexpr double leastMoment = 0.05;              // in the direction where it is smallest; 1 ideally

// The symmetric matrix with the elements xx yy zz xy xz yz.
Mat3 matrix(const std::array<double, 6>& s) {
    Mat3 m;
    m << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    return m;
}

ViscosityKind kindOf(const FluidModel& model, const ParticleSystem& system) {
    if (!system.store().optional().viscosity) return ViscosityKind::uniform;
    return model.lowestLayer > 0 ? ViscosityKind::layers : ViscosityKind::sides;
}

template <class Real>
PairKernels::Operators<Real> kernelsOf(KernelKind kernel, ViscosityKind viscosity) {
    if constexpr (std::is_same_v<Real, double>)
        return pairKernels().operators(kernel, viscosity);
    else
        return pairKernels().operatorsFloat(kernel, viscosity);
}
}  // namespace

template <class Real>
Operators<Real>::Operators(const FluidModel& model, const ParticleSystem& system, OperatorForm form,
                           std::optional<NoSlip> noSlip)
    : model_(model),
      form_(form),
      viscosity_(kindOf(model, system)),
      uniform_(kernelsOf<Real>(model.kernel->kind(), ViscosityKind::uniform)),
      varying_(kernelsOf<Real>(model.kernel->kind(), viscosity_)),
      excess_(model) {
    const double H = system.support(), gradient = model.kernel->gradientNormalisation(H);
    unitVolume_ = model.mass / model.density;
    const double atSpacing = model.kernel->value(system.spacing() / H);
    moments_ = {H, model.kernel->normalisation(H), gradient, unitVolume_, atSpacing};
    viscousUnit_ = model.viscosity * gradient * unitVolume_ * unitVolume_;
    rateUnit_ = gradient * H * unitVolume_ * unitVolume_;
    wallScale_ = form == OperatorForm::plain ? 1 : 1 / model.kernel->secondMoment(H / system.spacing());
    noSlip_ = noSlip.value_or(NoSlip::of(system.spacing(), H));
}

template <class Real>
void Operators<Real>::build(ParticleSystem& system) {
    const ParticleStore& s = system.store();
    const std::size_t n = s.size();
    if (std::exchange(plannedAt_, system.builds()) != system.builds()) {
        shared_.plan(system);
        if (system.periodicity().slides()) slides_ = system.halo().slides(system.owned());
    }
    volume_.resize(n), wall_.resize(n), divergence_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        volume_[i] = (s.optional().mass ? s.mass[i] : model_.mass) / s.density[i];
        wall_[i] = s.kindOf(i) == Kind::wall;
    }
    findMoments(system);
    packRecords(system);
    if (!isTwoFluids()) sortBlocks(system, [&](std::size_t) { return isLayered(); });
    hasInside_ = false;
}

template <class Real>
template <class HasStress>
void Operators<Real>::sortBlocks(const ParticleSystem& system, HasStress&& hasStress) {
    const particles::PairList& list = system.list();
    const particles::PairView view = list.view();
    const std::size_t n = volume_.size(), all = n + static_cast<std::size_t>(system.ghosts());
    std::vector<char> stressed(all, 0), touched(all, 0);
    for (std::size_t i = 0; i < n; ++i) stressed[i] = hasStress(i) ? 1 : 0;
    for (std::size_t g = n; g < all; ++g)
        if (const std::size_t own = shared_.entry(static_cast<int>(g - n)); own < n) stressed[g] = stressed[own];
    const auto forBoth = [&](int block, auto&& f) {
        for (int i = block * list.lanes(), end = std::min(view.owned, i + list.lanes()); i < end; ++i)
            f(static_cast<std::size_t>(i));
        std::for_each(view.j + view.begin(block), view.j + view.end(block),
                      [&](int j) { f(static_cast<std::size_t>(j)); });
    };
    const auto sort = [&](const std::vector<int>& blocks, Blocks& into) {
        into.uniform.clear(), into.varying.clear();
        for (const int block : blocks) {
            bool isVarying = false;
            forBoth(block, [&](std::size_t k) { isVarying = isVarying || stressed[k] != 0; });
            (isVarying ? into.varying : into.uniform).push_back(block);
            if (isVarying) forBoth(block, [&](std::size_t k) { touched[k] = 1; });
        }
    };
    for (std::size_t g = 0; g < groups_.size(); ++g)
        sort(list.blocks(static_cast<particles::PairList::Group>(g)), groups_[g]);
    for (auto [from, to] : {std::pair{&shared_.reaching(), &reaching_}, std::pair{&shared_.rest(), &rest_}})
        sort(from->away, to->away), sort(from->atWall, to->atWall);
    // A particle whose image is in a varying block need not be in one itself, as a pair across a periodic face is
    // listed by the earlier block alone.
    for (std::size_t g = n; g < all; ++g)
        if (const std::size_t own = shared_.entry(static_cast<int>(g - n)); touched[g] && own < n) touched[own] = 1;

    touched_.clear(), place_.assign(n, -1);
    for (std::size_t k = 0; k < all; ++k) {
        if (!touched[k]) continue;
        if (k < n) place_[k] = static_cast<int>(touched_.size());
        touched_.push_back(k);
    }
    const bool any = !touched_.empty();
    gradientSums_.assign(any ? gradientSums * all : 0, 0.0);
    stress_.resize(touched_.size());
    if (!any) return varyingStressRecords_.clear();
    varyingStressRecords_.assign(varyingStressFields * all, Real(0));
    for (std::size_t k = 0; k < all; ++k)
        std::copy_n(stressRecords_.data() + stressFields * k, stressAt,
                    varyingStressRecords_.data() + varyingStressFields * k);
}

template <class Real>
void Operators<Real>::findMoments(ParticleSystem& system) {
    const std::size_t n = volume_.size();
    momentRecords_.resize((n + static_cast<std::size_t>(system.ghosts())) * momentFields);
    const particles::RecordFrame frame(system);
    double* results[Moments::count];
    for (std::size_t k = 0; k < moment_.size(); ++k) moment_[k].resize(n), results[k] = moment_[k].data();
    for (std::size_t i = 0; i < n; ++i) {
        Real* r = momentRecords_.data() + momentFields * i;
        frame.position(i, r);
        r[3] = static_cast<Real>(volume_[i] / unitVolume_);
    }
    particles::sumOverPairs(system, uniform_.moments, uniform_.moments, moments_, momentRecords_, momentFields, sums_,
                            results, static_cast<int>(moment_.size()));

    disorder_.resize(n), viscous_.resize(n), bulk_.resize(n), correction_.resize(n);
    scale_.assign(n, wallScale_);
    std::string fault;
    for (std::size_t i = 0; i < n; ++i) {
        const auto m = [&](std::size_t k) { return moment_[k][i]; };
        const auto second = [&](std::size_t k) { return m(Moments::second + k); };
        disorder_[i] = Vec3(m(Moments::shift), m(Moments::shift + 1), m(Moments::shift + 2));
        correction_[i] = {1, 1, 1, 0, 0, 0};
        if (!wall_[i] && form_ == OperatorForm::corrected) {
            const Mat3 M = matrix({second(0), second(1), second(2), second(3), second(4), second(5)});
            const double scale = M.trace() / 3, determinant = M.determinant();
            if (!(scale > leastMoment && determinant > leastMoment * leastMoment * scale)) {
                const Vec3 x = system.store().position(i);
                fault = fmt::format(
                    "particle {} at ({:.4g}, {:.4g}, {:.4g}) m has too few neighbours for a gradient: particles have "
                    "moved away from it and left a void",
                    system.store().id[i], x[0], x[1], x[2]);
                break;
            }
            const Mat3 B = M.inverse();
            correction_[i] = {B(0, 0), B(1, 1), B(2, 2), B(0, 1), B(0, 2), B(1, 2)};
            scale_[i] = 1 / scale;
        }
        const double mu = isLayered() ? system.store().viscosity[i] : model_.viscosity;
        viscous_[i] = 2 * mu * volume_[i] * scale_[i] * m(Moments::strength);
        bulk_[i] = m(Moments::square) * volume_[i] / 3;
        if (isLayered()) viscous_[i] += layerExcess(system, i) * bulk_[i];
    }
    throwTogether(system.comm(), !fault.empty(), fault, ExitCode::numerics);
}

template <class Real>
void Operators<Real>::setInside(ParticleSystem& system, const std::vector<Inside>& inside) {
    if (!isTwoFluids()) return;
    excess_.build(system, shared_, volume_, inside);
    hasInside_ = true;
    sortBlocks(system, [&](std::size_t i) { return excess_.hasStress(i); });
    for (std::size_t i = 0; i < volume_.size(); ++i) viscous_[i] += excess_.diagonal(i) * bulk_[i];
}

template <class Real>
void Operators<Real>::packRecords(ParticleSystem& system) {
    const std::size_t n = volume_.size(), all = n + static_cast<std::size_t>(system.ghosts());
    rateRecords_.assign(all * rateFields, Real(0));
    stressRecords_.assign(all * stressFields, Real(0));
    model_.walls.findDistances(boundary::pointsOf(system.store()), gap_);
    for (std::size_t i = 0; i < n; ++i) {
        Real *rate = rateRecords_.data() + rateFields * i, *stress = stressRecords_.data() + stressFields * i;
        std::copy_n(momentRecords_.data() + momentFields * i, 3, rate);
        std::copy_n(rate, 3, stress);
        rate[volumeAt] = static_cast<Real>((wall_[i] ? -1 : 1) * volume_[i] / unitVolume_);
        rate[scaleAt] = static_cast<Real>(scale_[i]);
        for (std::size_t k = 0; k < 6; ++k) rate[correctionAt + k] = static_cast<Real>(correction_[i][k]);
        if (isLayered()) rate[viscosityAt] = static_cast<Real>(system.store().viscosity[i] / model_.viscosity);
        rate[gapAt] = static_cast<Real>(NoSlip::gap(gap_[i], system.support()));
        stress[3] = rate[volumeAt];
    }
    const double scale = 1 / system.support();
    particles::Halo& halo = system.halo();
    halo.begin(rateRecords_.data(), system.owned(), rateFields, scale);
    halo.finish(rateRecords_.data(), system.owned(), rateFields);
    halo.begin(stressRecords_.data(), system.owned(), stressFields, scale);
    halo.finish(stressRecords_.data(), system.owned(), stressFields);
}

// Unknown velocities of ghosts are received while interior blocks are processed.
template <class Real>
void Operators<Real>::findRates(ParticleSystem& system, const Field& u, Known known, FieldOf of) {
    if (isTwoFluids() && !hasInside_) throw std::logic_error("Operators: setInside comes after build");
    using particles::PairList;
    const auto put = [&](std::size_t record, std::size_t entry) {
        std::copy_n(u.data() + width * entry, 3, rateRecords_.data() + rateFields * record + 3);
    };
    const PairList& list = system.list();
    const auto work = [&](PairList::Group group) {
        const bool atWall = PairList::isAtWall(group);
        const Blocks& blocks = groups_[group];
        particles::addPairs(atWall ? uniform_.ratesAtWall : uniform_.rates, noSlip_, list, blocks.uniform, rateRecords_,
                            sums_);
        if (!blocks.varying.empty())
            particles::addPairs(atWall ? varying_.ratesAtWall : varying_.rates, noSlip_, list, blocks.varying,
                                rateRecords_, gradientSums_);
    };
    const std::size_t n = volume_.size();
    for (std::size_t i = 0; i < n; ++i) put(i, i);
    sums_.assign((n + static_cast<std::size_t>(system.ghosts())) * width, 0.0);
    for (const std::size_t k : touched_) std::fill_n(gradientSums_.data() + gradientSums * k, gradientSums, 0.0);
    if (known == Known::allVelocities) {
        for (int g = 0; g < system.ghosts(); ++g) put(n + static_cast<std::size_t>(g), shared_.entry(g));
        if (of == FieldOf::velocities)
            for (std::size_t g = 0; g < slides_.size(); ++g)
                for (int k = 0; k < 3; ++k)
                    rateRecords_[rateFields * (n + g) + static_cast<std::size_t>(velocityPart.first + k)] +=
                        static_cast<Real>(slides_[g][k]);
        for (int group = 0; group < PairList::groups; ++group) work(static_cast<PairList::Group>(group));
    } else
        system.forEachPair(rateRecords_.data(), rateFields, velocityPart, work);
    system.halo().foldImages(sums_.data(), system.owned(), width);
    if (!touched_.empty()) system.halo().foldImages(gradientSums_.data(), system.owned(), gradientSums);
    for (std::size_t i = 0; i < n; ++i) divergence_[i] = rateUnit_ * sums_[width * i + 3] / volume_[i];
    takeGradients(system);
}

template <class Real>
void Operators<Real>::takeGradients(const ParticleSystem& system) {
    const std::size_t n = volume_.size();
    for (std::size_t k = 0; k < touched_.size() && touched_[k] < n; ++k) {
        const std::size_t i = touched_[k];
        const double* s = gradientSums_.data() + gradientSums * i;
        for (std::size_t c = 0; c < 3; ++c) sums_[width * i + c] += s[c];
        const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> products(s + gradientAt);
        const Mat3 gradient = rateUnit_ / volume_[i] * (matrix(correction_[i]) * products);
        divergence_[i] += gradient.trace();
        if (isTwoFluids())
            stress_[k] = excess_.stress(i, gradient);
        else if (wall_[i])
            stress_[k].setZero();
        else
            stress_[k] = layerExcess(system, i) * gradient;
    }
}

template <class Real>
void Operators<Real>::applyViscosity(ParticleSystem& system, const Field& u) {
    force_.assign(width * shared_.entries(), 0.0);
    findRates(system, u, Known::ownVelocities, FieldOf::changes);
    if (isTwoFluids() || isLayered()) {
        for (std::size_t i = 0; i < volume_.size(); ++i) setPressure(i, 0);
        addStress(system, force_);
    } else
        for (std::size_t i = 0; i < volume_.size(); ++i) takeForces(i, i, force_);
}

// Pressure and stress are scaled so that the passes for viscosity and for stress can share one sum.
template <class Real>
void Operators<Real>::setPressure(std::size_t i, double pressure) {
    const double unit = rateUnit_ / viscousUnit_, p = pressure * unit;
    Real* stress = stressRecords_.data() + stressFields * i + stressAt;
    for (std::size_t k = 0; k < 6; ++k) stress[k] = static_cast<Real>(p * correction_[i][k]);
    const int place = place_[i];
    if (place < 0) return;
    const Mat3 T = (p * Mat3::Identity() - unit * stress_[static_cast<std::size_t>(place)]) * matrix(correction_[i]);
    Real* varying = varyingStressRecords_.data() + varyingStressFields * i + stressAt;
    for (int k = 0; k < 9; ++k) varying[k] = static_cast<Real>(T(k / 3, k % 3));
}

// Adds the forces of the stresses of own particles and their images alone; the stresses of ghosts owned by other ranks
// are 0 here, as their owners compute the forces of these.
template <class Real>
void Operators<Real>::addStress(ParticleSystem& system, particles::RealArray& force) {
    const std::size_t n = volume_.size(), ghosts = static_cast<std::size_t>(system.ghosts());
    if (isTwoFluids())
        excess_.addForces(
            shared_,
            [&](std::size_t record) -> Vec3 {
                const Real* u = rateRecords_.data() + rateFields * record + velocityPart.first;
                return {u[0], u[1], u[2]};
            },
            width, force);
    const auto copyToImages = [&](Field& records, std::size_t fields) {
        for (std::size_t g = 0; g < ghosts; ++g)
            if (const std::size_t own = shared_.entry(static_cast<int>(g)); own < n) {
                const Real* from = records.data() + fields * own;
                std::copy(from + stressAt, from + fields, records.data() + fields * (n + g) + stressAt);
            }
    };
    copyToImages(stressRecords_, stressFields);
    if (!touched_.empty()) copyToImages(varyingStressRecords_, varyingStressFields);
    // Removes what findRates has left in the sums of ghosts.
    std::fill(sums_.begin() + static_cast<std::ptrdiff_t>(width * n), sums_.end(), 0.0);
    const auto work = [&](const BlocksByWall& blocks) {
        const particles::PairList& list = system.list();
        particles::addPairs(uniform_.stress, noSlip_, list, blocks.away.uniform, stressRecords_, sums_);
        particles::addPairs(uniform_.stressAtWall, noSlip_, list, blocks.atWall.uniform, stressRecords_, sums_);
        particles::addPairs(varying_.stress, noSlip_, list, blocks.away.varying, varyingStressRecords_, sums_);
        particles::addPairs(varying_.stressAtWall, noSlip_, list, blocks.atWall.varying, varyingStressRecords_, sums_);
        system.halo().foldImages(sums_.data(), system.owned(), width);
    };
    work(reaching_);
    for (const std::size_t e : shared_.shared())
        if (e < n) takeForces(e, e, force);
    for (std::size_t g = 0; g < ghosts; ++g)
        if (const std::size_t e = shared_.entry(static_cast<int>(g)); e >= n) takeForces(n + g, e, force);
    shared_.beginSum(force.data(), {width, 3});
    work(rest_);
    for (std::size_t i = 0; i < n; ++i) takeForces(i, i, force);
    shared_.finishSum(force.data(), {width, 3});
}

template class Operators<double>;
template class Operators<float>;

}  // namespace corpuscle::sph
