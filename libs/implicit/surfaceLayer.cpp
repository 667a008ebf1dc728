#include "implicit/surfaceLayer.hpp"

#include <algorithm>
#include <cmath>

#include "bodies/extrapolation.hpp"
#include "sph/noSlip.hpp"

namespace corpuscle::implicit {

using particles::ParticleStore;
using particles::ParticleSystem;

namespace {

constexpr double ofMeans = 0.5;        // share of T in 1 + gamma = 1/(1 - T/2)
constexpr double mostOfMean = 0.6;     // upper bound of T/2, which is 0.25 at most beside one surface
constexpr double leastStretch = 1e-3;  // smaller gammas are set to 0
constexpr double leastRatio = 0.25;    // lower bound of g: a stronger curvature is that of an edge
constexpr double normalByFoot = 0.2;   // distance above which the nearest point gives the normal [spacings]
// Largest number of bodies for which the gamma of a particle is known to other ranks.
constexpr std::size_t mostBodies = 4;

}  // namespace

// Records of own particles, then of ghosts. Those of bodies' particles also have the body, counted from 1, and the arm.
template <class Real>
struct SurfaceLayer<Real>::Records {
    static constexpr int fields = 11;
    enum Field { volume = 3, scale, viscosity, gap, body, arm };

    ParticleSystem& system;
    const sph::FluidModel& model;
    sph::NoSlip noSlip;
    std::size_t owned;
    double H, unit;
    particles::RealArray values;

    Records(const coupling::Scene& scene, const sph::Operators<Real>& operators)
        : system(*scene.system),
          model(scene.model()),
          noSlip(sph::NoSlip::of(scene.spacing, scene.system->support())),
          owned(scene.store().size()),
          H(system.support()),
          unit(model.kernel->gradientNormalisation(H)),
          values(fields * (owned + static_cast<std::size_t>(system.ghosts())), 0.0) {
        const ParticleStore& store = system.store();
        for (std::size_t i = 0; i < owned; ++i) {
            double* r = values.data() + fields * i;
            Vec3::Map(r) = store.position(i);
            r[volume] = operators.volume(i), r[scale] = operators.viscousScale(i);
            r[viscosity] = model.lowestLayer > 0 ? store.viscosity[i] : model.viscosity;
            r[gap] = operators.wallGap(i) / H;
        }
        for (const auto& m : scene.bodies->groups().members) {
            double* r = values.data() + fields * static_cast<std::size_t>(m.particle);
            r[body] = m.group + 1;
            Vec3::Map(r + arm) = m.arm;
        }
        system.halo().exchange(values.data(), system.owned(), fields);
    }
    const double* of(std::size_t k) const { return values.data() + fields * k; }
    Vec3 position(std::size_t k) const { return Vec3::Map(of(k)); }
    // f(index of the record, d, l) for the particles within the support of own particle i.
    template <class F>
    void forNear(std::size_t i, F&& f) const {
        const double* a = of(i);
        const auto each = [&](std::size_t k) {
            const Vec3 d = position(k) - position(i);
            const double q = d.norm() / H;
            if (k == i || q >= 1) return;
            const double *b = of(k), mu = 2 * a[viscosity] * b[viscosity] / (a[viscosity] + b[viscosity]);
            f(k, d,
              mu * beta(a[gap], b[gap]) * unit * model.kernel->slope(q) * a[volume] * b[volume] *
                  (a[scale] + b[scale]));
        };
        const double reach = H + 0.5 * system.skin();  // particles are found by their positions when lists were built
        system.forOwnedNear(position(i), reach, [&](int k) { each(static_cast<std::size_t>(k)); });
        system.forGhostsNear(position(i), reach, [&](int g) { each(owned + static_cast<std::size_t>(g)); });
    }
    double beta(double gapI, double gapJ) const {  // Morris's factor at walls
        const double far = std::max(gapI, gapJ), depth = std::max(-std::min(gapI, gapJ), 0.0);
        return std::min(1 + depth / std::max(far, noSlip.smallestDistance), noSlip.betaMax);
    }
};

// The surface of a body as seen from a fluid particle beside it.
template <class Real>
struct SurfaceLayer<Real>::Side {
    double distance, curvature;  // s, q
    Vec3 normal;                 // n
    struct Depth {
        double z, counted;  // counted: z/g
    };
    Depth depth(const Vec3& d) const {
        const double along = 2 * normal.dot(d) + curvature * d.squaredNorm(),
                     g = std::sqrt(std::max(1 + curvature * along, 0.0)),
                     z = std::max(-distance - along / (1 + g), 0.0);
        return {z, z / std::max(g, leastRatio)};
    }
};

template <class Real>
SurfaceLayer<Real>::SurfaceLayer(coupling::Scene& scene, sph::Operators<Real>& operators)
    : scene_(scene), operators_(operators) {
    for (const bodies::Body& body : scene.bodies->all())
        surfaces_.push_back(
            std::make_unique<geometry::TriangleTree>(body.solid.surface, scene.system->support() + scene.spacing));
}

template <class Real>
void SurfaceLayer<Real>::prepare() {
    const Records records(scene_, operators_);
    std::vector<std::vector<Share>> shares = sharesOfAll(records);
    findStretches(shares);
    findRows(records, shares);
}

template <class Real>
auto SurfaceLayer<Real>::sideOf(std::size_t b, const Vec3& arm) const -> Side {
    const bodies::Body& body = scene_.bodies->all()[b];
    const double dx = scene_.spacing;
    const Vec3 x = body.inBody(arm);
    const double known = std::abs(body.distance.at(x)) + body.distance.margin();
    geometry::SurfacePoint at = surfaces_[b]->nearest(x, known);
    if (!at) at = surfaces_[b]->nearest(x);  // the distance grid has no values beyond its reach
    Side side{at ? at.distance : body.distance.at(x), 0.5 * bodies::curvature(body.distance, x, dx), Vec3::Zero()};
    if (at && at.distance > normalByFoot * dx)
        side.normal = x - at.point;
    else
        for (int k = 0; k < 3; ++k)
            side.normal[k] =
                body.distance.at(x + 0.5 * dx * Vec3::Unit(k)) - body.distance.at(x - 0.5 * dx * Vec3::Unit(k));
    side.normal = body.state.orientation * side.normal.normalized();
    side.distance = std::max(side.distance, bodies::Bodies::Medium::unlimited * dx);
    return side;
}

template <class Real>
auto SurfaceLayer<Real>::sharesOfAll(const Records& records) const -> std::vector<std::vector<Share>> {
    std::vector<std::vector<Share>> shares(records.owned);
    const auto& near = scene_.bodies->groups().near;
    const double apart = 0.5 * scene_.spacing;  // [m]; images of a body are further apart
    std::vector<Side> sides;
    std::vector<double> T;
    for (std::size_t first = 0, end = 0; first < near.size(); first = end) {
        const auto i = static_cast<std::size_t>(near[first].particle);
        std::vector<Share>& found = shares[i];
        sides.clear();
        for (end = first; end < near.size() && near[end].particle == near[first].particle; ++end) {
            const auto b = static_cast<std::size_t>(near[end].group);
            sides.push_back(sideOf(b, near[end].arm));
            const Vec3 image = scene_.bodies->all()[b].state.centre + near[end].arm;
            found.push_back({b, 0, 0, near[end].arm, scene_.system->periodicity().periods(records.position(i), image)});
        }
        T.assign(found.size(), 0.0);
        records.forNear(i, [&](std::size_t k, const Vec3& d, double l) {
            const double* r = records.of(k);
            if (r[Records::body] == 0) return;
            const auto body = static_cast<std::size_t>(r[Records::body]) - 1;
            const Vec3 arm = Vec3::Map(r + Records::arm);
            for (std::size_t s = 0; s < found.size(); ++s) {
                if (found[s].body != body || (found[s].arm + d - arm).squaredNorm() > apart * apart) continue;
                const auto [z, counted] = sides[s].depth(d);
                found[s].resistance += l * counted / sides[s].distance;
                T[s] += l * counted * (sides[s].distance + counted);
            }
        });
        const double unit = 2 * records.of(i)[Records::viscosity] * operators_.volume(i);
        double total = 0;
        for (double& part : T) total += part *= ofMeans / unit;
        if (!(total > 0)) continue;
        const double stretch = 1 / (1 - std::min(total, mostOfMean)) - 1;
        if (stretch < leastStretch) continue;
        for (std::size_t s = 0; s < found.size(); ++s) found[s].stretch = stretch * T[s] / total;
    }
    return shares;
}

// Finds the gammas of all entries. Own particles have the same gamma here as on other ranks.
template <class Real>
void SurfaceLayer<Real>::findStretches(std::vector<std::vector<Share>>& shares) {
    particles::SharedParticles& shared = operators_.shared();
    constexpr std::size_t numbers = 6, perEntry = mostBodies * numbers;  // body, counted from 1; gamma; arm; periods
    particles::RealArray rows(perEntry * shared.entries(), 0.0);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        double* r = rows.data() + perEntry * i;
        for (std::size_t s = 0; s < shares[i].size(); ++s, r += numbers) {
            if (s >= mostBodies) {
                shares[i][s].stretch = 0;
                continue;
            }
            r[0] = static_cast<double>(shares[i][s].body + 1), r[1] = shares[i][s].stretch;
            Vec3::Map(r + 2) = shares[i][s].arm, r[5] = shares[i][s].periods;
        }
    }
    shared.distribute(rows.data(), static_cast<int>(perEntry));
    stretches_.clear();
    excess_.assign(width * shared.entries(), 0.0);
    for (std::size_t e = 0; e < shared.entries(); ++e)
        for (std::size_t s = 0; s < mostBodies; ++s)
            if (const double* r = rows.data() + perEntry * e + numbers * s; r[1] > 0)
                stretches_.emplace_back(e, Share{static_cast<std::size_t>(r[0]) - 1, r[1], 0, Vec3::Map(r + 2), r[5]});
}

template <class Real>
void SurfaceLayer<Real>::findRows(const Records& records, const std::vector<std::vector<Share>>& shares) {
    const particles::SharedParticles& shared = operators_.shared();
    const std::size_t n = records.owned, all = n + static_cast<std::size_t>(records.system.ghosts());
    const auto entryOf = [&](std::size_t k) { return k < n ? k : shared.entry(static_cast<int>(k - n)); };
    std::vector<char> isStretched(shared.entries(), 0), hasRow(n, 0);
    for (const auto& [entry, share] : stretches_) isStretched[entry] = 1;
    for (std::size_t i = 0; i < n; ++i) hasRow[i] = !shares[i].empty();
    for (std::size_t k = 0; k < all; ++k)
        if (isStretched[entryOf(k)])
            records.system.forOwnedNear(records.position(k), records.H + 0.5 * records.system.skin(),
                                        [&](int i) { hasRow[static_cast<std::size_t>(i)] = 1; });
    const Vec3& slide = records.system.periodicity().slide();
    const std::vector<Vec3>& slides = operators_.slides();
    rows_.clear(), pairs_.clear(), periods_.clear(), shares_.clear();
    firstPair_.assign(1, 0), firstShare_.assign(1, 0), diagonal_.assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        if (!hasRow[i] || operators_.isWall(i)) continue;
        double stretch = 1, resistance = 0;
        for (const Share& share : shares[i]) stretch += share.stretch, resistance += share.resistance;
        records.forNear(i, [&](std::size_t k, const Vec3&, double l) {
            const std::size_t e = entryOf(k);
            if (!isStretched[i] && !isStretched[e]) return;
            pairs_.push_back({e, l});
            if (records.system.periodicity().slides())
                periods_.push_back(k < n ? 0 : std::round(slides[k - n].dot(slide) / slide.squaredNorm()));
            diagonal_[i] += l * (stretch * stretch - 1);
        });
        diagonal_[i] += resistance * stretch * stretch;
        shares_.insert(shares_.end(), shares[i].begin(), shares[i].end());
        rows_.push_back(i), firstPair_.push_back(pairs_.size()), firstShare_.push_back(shares_.size());
    }
}

template class SurfaceLayer<double>;
template class SurfaceLayer<float>;

}  // namespace corpuscle::implicit
