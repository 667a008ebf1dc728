#include "coupling/holeFlux.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "coupling/nodeImages.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::coupling {

using particles::ParticleSystem;

namespace {

constexpr double fewest = 4;         // with fewer particles a point has the plain mean
constexpr double largestStep = 1.0;  // between the points of a cap, in spacings
// Sums of each point: the upper triangle of sum V W (1, q) (1, q)^T, and the number of particles.
constexpr std::size_t moments = 11;

}  // namespace

void HoleFlux::place(const Cells& cells, const std::vector<TornSheet>& sheets, const ParticleSystem& system,
                     const std::vector<double>& volume) {
    own_.clear(), others_.clear(), slides_.clear();
    sheets_ = sheets.size();
    if (!exist()) return;
    findPoints(cells, sheets);
    findNear(system, volume);
    findWeights(cells, system.comm());
    std::vector<char> isMine(sheets_, 0);
    for (const Entry& e : own_) isMine[e.sheet] = 1;
    ofSheets_.plan(
        cells, system.comm(), [&, c = std::size_t(0)](const Cell&) mutable { return sheetsOfCell_[c++]; }, isMine);
    if (system.periodicity().slides()) findSlides(system);
}

void HoleFlux::findPoints(const Cells& cells, const std::vector<TornSheet>& sheets) {
    points_.clear();
    sheetsOfCell_.assign(cells.heldCount(), 0), pointsOfCell_.assign(cells.heldCount(), 0);
    for (std::size_t k = 0; k < sheets.size(); ++k) {
        const std::size_t before = points_.size();
        for (const std::vector<int>& rim : sheets[k].rims) addCap(k, cells[sheets[k].cell].membrane.position, rim);
        ++sheetsOfCell_[sheets[k].cell];
        pointsOfCell_[sheets[k].cell] += points_.size() - before;
    }
}

// Divides each triangle between the mean point c and an edge a b of the rim into strips along the edge, and these into
// pieces; the point of a piece is its centroid. With c + t ((1 - s) a + s b - c), dA is proportional to t dt ds.
void HoleFlux::addCap(std::size_t sheet, const std::vector<Vec3>& x, const std::vector<int>& rim) {
    const Vec3 c = membrane::meanPoint(x, rim);
    const double step = largestStep * spacing_;
    for (std::size_t k = 0; k < rim.size(); ++k) {
        const Vec3 a = x[static_cast<std::size_t>(rim[(k + 1) % rim.size()])] - c,
                   b = x[static_cast<std::size_t>(rim[k])] - c, area = 0.5 * a.cross(b);
        const double strips = std::max(1.0, std::ceil(std::max(a.norm(), b.norm()) / step));
        for (double strip = 0; strip < strips; ++strip) {
            const double t0 = strip / strips, t1 = (strip + 1) / strips, share = t1 * t1 - t0 * t0;
            const double t = 2 * (t1 * t1 * t1 - t0 * t0 * t0) / (3 * share);
            const double pieces = std::max(1.0, std::ceil(t1 * (b - a).norm() / step));
            for (double piece = 0; piece < pieces; ++piece) {
                const double s = (piece + 0.5) / pieces;
                points_.push_back({sheet, c + t * ((1 - s) * a + s * b), share / pieces * area});
            }
        }
    }
}

void HoleFlux::findNear(const ParticleSystem& system, const std::vector<double>& volume) {
    const particles::ParticleStore& s = system.store();
    const double reach = radius_ + 0.5 * system.skin();  // the search uses positions at the time of the last list build
    firstNear_.assign(1, 0), near_.clear();
    for (const Point& point : points_) {
        forImages(system, point.x, reach, [&](const Vec3& image) {
            system.forOwnedNear(image, reach, [&](int i) {
                const Vec3 q = (s.position(static_cast<std::size_t>(i)) - image) / radius_;
                if (q.squaredNorm() < 1)
                    near_.push_back({i, volume[static_cast<std::size_t>(i)] * NodeBasis::weight(q.norm()), q});
            });
        });
        firstNear_.push_back(near_.size());
    }
}

void HoleFlux::findWeights(const Cells& cells, MPI_Comm comm) {
    std::vector<double> sums(moments * points_.size(), 0.0);
    std::vector<char> isMine(points_.size());
    for (std::size_t p = 0; p < points_.size(); ++p) {
        isMine[p] = firstNear_[p + 1] > firstNear_[p];
        for (std::size_t k = firstNear_[p]; k < firstNear_[p + 1]; ++k) {
            const Eigen::Vector4d b(1, near_[k].q[0], near_[k].q[1], near_[k].q[2]);
            double* sum = &sums[moments * p];
            for (int i = 0; i < 4; ++i)
                for (int j = i; j < 4; ++j) *sum++ += near_[k].weight * b[i] * b[j];
            *sum += 1;
        }
    }
    atPoints_.plan(
        cells, comm, [&, c = std::size_t(0)](const Cell&) mutable { return pointsOfCell_[c++]; }, isMine);
    atPoints_.addUp(sums, moments);
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const double* sum = &sums[moments * p];
        const double all = sum[0];
        if (!(all > 0)) continue;
        points_[p].constant = 1 / all;
        if (sum[moments - 1] < fewest) continue;
        Eigen::Matrix4d A;
        for (int i = 0; i < 4; ++i)
            for (int j = i; j < 4; ++j) A(i, j) = A(j, i) = *sum++;
        const Eigen::Vector4d c = A.ldlt().solve(Eigen::Vector4d::Unit(0));
        const double share = NodeBasis::shareOfMean(all * (std::abs(c[0]) + c.tail<3>().norm()));
        if (share == 1) continue;
        points_[p].constant = share / all + (1 - share) * c[0], points_[p].slope = (1 - share) * c.tail<3>();
    }
    // Entries of one sheet and particle are one; the last of each particle, if it is of the same sheet, takes the rest.
    std::vector<std::size_t> entryOf;
    for (std::size_t p = 0; p < points_.size(); ++p)
        for (std::size_t k = firstNear_[p]; k < firstNear_[p + 1]; ++k) {
            const auto i = static_cast<std::size_t>(near_[k].particle);
            if (i >= entryOf.size()) entryOf.resize(i + 1, static_cast<std::size_t>(-1));
            if (entryOf[i] >= own_.size() || own_[entryOf[i]].sheet != points_[p].sheet) {
                entryOf[i] = own_.size();
                own_.push_back({points_[p].sheet, near_[k].particle, Vec3::Zero()});
            }
            own_[entryOf[i]].area += weightOf(near_[k], points_[p]) * points_[p].area;
        }
}

void HoleFlux::findSlides(const ParticleSystem& system) {
    slides_.assign(sheets_, 0.0);
    for (std::size_t p = 0; p < points_.size(); ++p)
        for (std::size_t k = firstNear_[p]; k < firstNear_[p + 1]; ++k) {
            const Vec3 at = system.store().position(static_cast<std::size_t>(near_[k].particle));
            const Vec3 slide = system.periodicity().slideOf(at, points_[p].x + radius_ * near_[k].q);
            slides_[points_[p].sheet] += weightOf(near_[k], points_[p]) * points_[p].area.dot(slide);
        }
    ofSheets_.addUp(slides_, 1);
}

void HoleFlux::placeOthers(const ParticleSystem& system, const particles::SharedParticles& shared,
                           const GhostRecords& ghosts) {
    others_.clear();
    if (!exist()) return;
    const double reach = radius_ + 0.5 * system.skin(), ofHalo = system.support() + system.skin();
    for (const Point& point : points_)
        forImages(system, point.x, reach + ofHalo, [&](const Vec3& image) {
            system.forGhostsNear(image, reach, [&](int ghost) {
                const std::size_t entry = shared.entry(ghost);
                if (entry < shared.owned() || shared.ghostOf()[entry - shared.owned()] != ghost) return;
                const Vec3 q = (ghosts.position(ghost) - image) / radius_;
                if (q.squaredNorm() >= 1) return;
                const Near near{static_cast<int>(entry), ghosts.volume(ghost) * NodeBasis::weight(q.norm()), q};
                others_.push_back({point.sheet, near.particle, weightOf(near, point) * point.area});
            });
        });
}

template <class Real>
std::vector<double> HoleFlux::of(const Real* v) {
    std::vector<double> flux(sheets_, 0.0);
    for (const Entry& e : own_) {
        const Real* const u = v + 4 * static_cast<std::size_t>(e.particle);
        for (int k = 0; k < 3; ++k) flux[e.sheet] += e.area[k] * static_cast<double>(u[k]);
    }
    ofSheets_.addUp(flux, 1);
    return flux;
}
template std::vector<double> HoleFlux::of(const double*);
template std::vector<double> HoleFlux::of(const float*);

void HoleFlux::spreadBy(const std::vector<Entry>& entries, const std::vector<double>& pressures,
                        particles::RealArray& force) const {
    for (const Entry& e : entries)
        for (int k = 0; k < 3; ++k)
            force[4 * static_cast<std::size_t>(e.particle) + static_cast<std::size_t>(k)] +=
                pressures[e.sheet] * e.area[k];
}

}  // namespace corpuscle::coupling
