#include "coupling/immersed.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "coupling/sphereScene.hpp"
#include "membrane/surface.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

constexpr double reach = Immersed::radiusInSpacings;
using Vec6 = Eigen::Matrix<double, 6, 1>;
const Index3 size{14, 12, 12};

// Two stretched cells: the first across a periodic edge of the box, the second some periods outside the box.
struct InFluid : SphereScene {
    std::vector<sph::testing::Particle> all = sph::testing::lattice(size, 0.1);
    std::vector<double> volumes;  // of the particles, by id
    Immersed immersed;

    InFluid()
        : SphereScene(size, {Vec3(3.5, 0.2, 9.5), Vec3(10.5, 5, 5)}, true),
          immersed(cells, sph::testing::model("wendlandC2"), *system) {
        for (Cell& cell : cells) {
            const Vec3 middle = middleOf(cell), away = cell.membrane.cell == 2 ? Vec3(-28, 10, 0) : Vec3(0, 0, 0);
            for (Vec3& x : cell.membrane.position) {
                const Vec3 d = x - middle;
                x += away + Vec3(0.05 * d[0], -0.04 * d[1], 0.03 * std::sin(d[0]));
            }
            cell.initialVolume = cell.membrane.volume();
        }
        for (std::size_t j = 0; j < all.size(); ++j) volumes.push_back(1 + 0.1 * std::sin(static_cast<double>(j)));
        build();
    }
    void build() {
        std::vector<double> own;
        for (const std::int64_t id : system->store().id) own.push_back(volumes[static_cast<std::size_t>(id)]);
        immersed.build(*system, own);
    }
    void open(std::size_t cell) {
        membrane::Membrane& m = cells[cell].membrane;
        std::vector<char> alive(m.network().allBonds().size(), 1);
        alive[3] = 0;
        m.restore(alive);
    }
    // Removes the triangles around a node.
    void tearAround(std::size_t cell, int node) {
        membrane::Membrane& m = cells[cell].membrane;
        std::vector<char> alive(m.network().allBonds().size(), 1);
        for (const membrane::Bond& bond : m.network().allBonds())
            if (bond.node[0] == node || bond.node[1] == node) alive[static_cast<std::size_t>(bond.number)] = 0;
        m.restore(alive);
    }
    std::size_t nodes() const { return start[0].size() + start[1].size(); }
    std::vector<Vec3> elastic() const {  // elastic forces of the membranes alone, on all nodes
        std::vector<Vec3> all;
        for (const Cell& cell : cells) {
            std::vector<Vec3> f(cell.membrane.position.size(), Vec3::Zero());
            cell.membrane.addElasticForces(cell.membrane.position, f);
            all.insert(all.end(), f.begin(), f.end());
        }
        return all;
    }
    std::vector<Vec3> positions() const {
        std::vector<Vec3> x;
        for (const Cell& cell : cells) x.insert(x.end(), cell.membrane.position.begin(), cell.membrane.position.end());
        return x;
    }

    // Velocities f(id, position) of the particles, four numbers each, as in the fields of the implicit step.
    template <class Real, class F>
    std::vector<Real> field(F&& f) const {
        const ParticleStore& s = system->store();
        std::vector<Real> u(4 * s.size(), Real(0));
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec3 v = f(static_cast<std::size_t>(s.id[i]), s.position(i));
            for (std::size_t k = 0; k < 3; ++k) u[4 * i + k] = static_cast<Real>(v[static_cast<int>(k)]);
        }
        return u;
    }
    std::vector<Vec3> random(std::size_t n, unsigned seed) const {
        std::vector<Vec3> v(n, Vec3::Zero());
        membrane::testing::jitter(v, 1, seed);
        return v;
    }

    // Weights w, w' and grad of coupling/nodeFluidMap.hpp for each node, from all particles and their images; particles
    // by id.
    struct Weight {
        std::size_t particle;
        double along, across;
        Vec3 slope;  // of the gradient
    };
    // The mean M along the membrane (coupling/nodeFluidMap.hpp) at a node, over all nodes of its cell.
    struct Mean {
        std::vector<std::pair<std::size_t, double>> of;
        Vec3 shift = Vec3::Zero();
        double square = 0;
    };
    std::vector<Mean> means() const;
    // Both cells after `open`: g of the whole triangles, and the flux H u through the hole (coupling/holeFlux.hpp) from
    // all particles and their images. The edges are shorter than a spacing, so that a cap has one point a triangle.
    std::vector<Vec3> gradient(const Cell& cell) const;
    double flux(const Cell& cell, const std::vector<Vec3>& u) const;
    // v - g (g.v + H u)/(g.g) for each cell.
    std::vector<Vec3> withVolume(std::vector<Vec3> v, const std::vector<Vec3>& u) const;
    std::vector<Vec3> expected(const std::vector<std::vector<Weight>>& weights, const std::vector<Vec3>& u) const;
    // mixed: number of nodes with a share of the plain mean.
    std::vector<std::vector<Weight>> weights(long& mixed) const;
    // Velocity at a node by its weights; u: velocities of the particles, by id.
    static Vec3 mean(const std::vector<Weight>& weights, const Vec3& normal, const std::vector<Vec3>& u) {
        Vec3 along = Vec3::Zero(), across = Vec3::Zero();
        for (const Weight& w : weights) along += w.along * u[w.particle], across += w.across * u[w.particle];
        return along + normal.dot(across - along) * normal;
    }
    std::vector<Vec3> normals() const {
        std::vector<Vec3> all;
        for (const Cell& cell : cells)
            for (const Vec3& g : membrane::volumeGradient(cell.membrane.position, cell.membrane.network().triangles()))
                all.push_back(g.normalized());
        return all;
    }
};

// Integral over low < x < high by Gauss's rule of ten points: exact for polynomials below degree 20.
template <class F>
double integral(double low, double high, F&& f) {
    constexpr double at[] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                             0.9739065285171717};
    constexpr double weight[] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820, 0.1494513491505806,
                                 0.0666713443086881};
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    double sum = 0;
    for (std::size_t k = 0; k < 5; ++k) sum += half * weight[k] * (f(middle + half * at[k]) + f(middle - half * at[k]));
    return sum;
}

// E|z - y| of coupling/nodeBasis.hpp.
double kink(double z) {
    const auto W = [](double q) { return std::pow(1 - q, 4) * (1 + 4 * q); };
    const auto moment = [&](int p) { return integral(0, 1, [&](double q) { return std::pow(q, p) * W(q); }); };
    static const double c2 = (0.1 * moment(2) - moment(4)) / (moment(6) - 0.1 * moment(4));  // c0 = 1
    const auto density = [&](double y) {
        return integral(y, 1, [&](double q) { return q * W(q) * (1 + c2 * q * q); });
    };
    const double at = std::abs(z);
    const auto distance = [&](double y) { return 0.5 * density(y) * (std::abs(at - y) + at + y); };
    static const double sum = integral(0, 1, density);
    return (integral(0, at, distance) + integral(at, 1, distance)) / sum;
}

std::vector<std::vector<InFluid::Weight>> InFluid::weights(long& mixed) const {
    const double v =
        FlatMembrane(*sph::testing::model("wendlandC2").kernel, system->support(), reach, 1).conditions().kink;
    const std::vector<Vec3> normal = normals();
    const std::vector<Mean> mean = means();
    std::vector<std::vector<Weight>> result;
    mixed = 0;
    for (const Vec3& node : positions()) {
        const Vec3& n = normal[result.size()];
        std::vector<Weight>& own = result.emplace_back();
        std::vector<Vec6> of;
        Eigen::Matrix<double, 6, 6> moments = Eigen::Matrix<double, 6, 6>::Zero();
        const Vec3 x = system->periodicity().wrap(node);
        for (std::size_t j = 0; j < all.size(); ++j)
            for (int image = 0; image < 27; ++image) {
                const int along[] = {image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1};
                const Vec3 shift(size[0] * along[0], size[1] * along[1], size[2] * along[2]);
                const Vec3 at = (all[j].x + shift - x) / reach;
                const double q = at.norm(), z = n.dot(at);
                if (q >= 1) continue;
                const double w = volumes[j] * std::pow(1 - q, 4) * (1 + 4 * q);
                of.push_back((Vec6() << 1, at, kink(z), (at - z * n).squaredNorm()).finished());
                moments += w * of.back() * of.back().transpose();
                own.push_back({j, w, w, Vec3::Constant(w)});
            }
        const auto solver = moments.fullPivLu();
        const double less = -mean[result.size() - 1].square / (reach * reach);
        const Vec6 along = solver.solve((Vec6() << 1, 0, 0, 0, v, less - 0.07).finished()),
                   across = solver.solve((Vec6() << 1, 0, 0, 0, 0.23, less + 0.02).finished());
        double sumAlong = 0, sumAcross = 0;
        for (std::size_t k = 0; k < own.size(); ++k) {
            sumAlong += std::abs(own[k].along * along.dot(of[k]));
            sumAcross += std::abs(own[k].across * across.dot(of[k]));
        }
        const double excess = std::clamp((std::max(sumAlong, sumAcross) - 4) / 4, 0.0, 1.0);
        const double exact = own.size() < 6 ? 0 : 1 - excess * excess * (3 - 2 * excess);
        mixed += exact < 1;
        for (std::size_t k = 0; k < own.size(); ++k) {
            const auto mix = [&](double weight) { return exact > 0 ? exact * weight : 0; };
            const double mean = (1 - exact) / moments(0, 0);
            own[k].along *= mix(along.dot(of[k])) + mean;
            own[k].across *= mix(across.dot(of[k])) + mean;
            for (int a = 0; a < 3; ++a)
                own[k].slope[a] *= mix(Vec6(solver.solve(Vec6::Unit(a + 1))).dot(of[k]) / reach);
        }
    }
    return result;
}

// For spheres, on which nodes within 1.2 spacings are joined by edges.
std::vector<InFluid::Mean> InFluid::means() const {
    std::vector<Mean> all;
    std::size_t first = 0;
    for (const Cell& cell : cells) {
        const std::vector<Vec3>& x = cell.membrane.position;
        const auto area = membrane::volumeGradient(x, cell.membrane.network().triangles());
        for (const Vec3& at : x) {
            Mean& mean = all.emplace_back();
            double sum = 0;
            for (std::size_t n = 0; n < x.size(); ++n)
                if (const double r = (x[n] - at).norm() / MembraneSmoothing::reachInSpacings; r < 1) {
                    const double w = area[n].norm() * std::pow(1 - r, 2) * (1 + 2 * r);
                    mean.of.emplace_back(first + n, w), sum += w;
                    mean.shift -= w * (x[n] - at), mean.square += w * (x[n] - at).squaredNorm();
                }
            for (auto& [n, w] : mean.of) w /= sum;
            mean.shift /= sum, mean.square /= sum;
        }
        first += x.size();
    }
    return all;
}

// Velocities of the nodes, from these weights and means.
std::vector<Vec3> InFluid::expected(const std::vector<std::vector<Weight>>& weights, const std::vector<Vec3>& u) const {
    const std::vector<Vec3> at = normals();
    const std::vector<Mean> mean = means();
    std::vector<Vec3> all(weights.size(), Vec3::Zero());
    for (std::size_t m = 0; m < all.size(); ++m) {
        EXPECT_GT(mean[m].of.size(), 3);
        for (const auto& [n, w] : mean[m].of) all[m] += w * InFluid::mean(weights[n], at[n], u);
        for (const Weight& w : weights[m]) all[m] += w.slope.dot(mean[m].shift) * u[w.particle];
    }
    return all;
}

double dot(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
                              [](const Vec3& x, const Vec3& y) { return x.dot(y); });
}

std::vector<Vec3> InFluid::gradient(const Cell& cell) const {
    const membrane::Network& network = cell.membrane.network();
    std::vector<Index3> whole;
    for (const int t : network.wholeTriangles()) whole.push_back(network.triangles()[static_cast<std::size_t>(t)]);
    return membrane::volumeGradient(cell.membrane.position, whole);
}

double InFluid::flux(const Cell& cell, const std::vector<Vec3>& u) const {
    const std::vector<Vec3>& x = cell.membrane.position;
    const auto rims = cell.membrane.network().rims();
    EXPECT_EQ(rims.size(), 1u);
    const Vec3 middle = membrane::meanPoint(x, rims[0]);
    double sum = 0;
    for (std::size_t k = 0; k < rims[0].size(); ++k) {
        const Vec3 &a = x[static_cast<std::size_t>(rims[0][k])],
                   &b = x[static_cast<std::size_t>(rims[0][(k + 1) % rims[0].size()])];
        EXPECT_LT((a - middle).norm() + (b - a).norm(), 2);
        const Vec3 at = (a + b + middle) / 3, area = membrane::areaVector(middle, b, a);
        Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
        std::vector<std::tuple<std::size_t, double, Eigen::Vector4d>> near;
        for (std::size_t j = 0; j < all.size(); ++j) {
            const Vec3 q = system->periodicity().shortest(all[j].x - at) / reach;
            if (q.norm() >= 1) continue;
            const Eigen::Vector4d of(1, q[0], q[1], q[2]);
            near.emplace_back(j, volumes[j] * std::pow(1 - q.norm(), 4) * (1 + 4 * q.norm()), of);
            moments += std::get<1>(near.back()) * of * of.transpose();
        }
        const Eigen::Vector4d c = moments.fullPivLu().solve(Eigen::Vector4d::Unit(0));
        for (const auto& [j, weight, of] : near) sum += weight * c.dot(of) * area.dot(u[j]);
    }
    return sum;
}

std::vector<Vec3> InFluid::withVolume(std::vector<Vec3> v, const std::vector<Vec3>& u) const {
    for (const Cell& cell : cells) {
        const std::vector<Vec3> g = gradient(cell);
        Vec3* const own = v.data() + cell.firstNode;
        double sum = flux(cell, u);
        for (std::size_t n = 0; n < g.size(); ++n) sum += g[n].dot(own[n]);
        for (std::size_t n = 0; n < g.size(); ++n) own[n] -= sum / dot(g, g) * g[n];
    }
    return v;
}

}  // namespace

// Both cells are torn; across images and ranks.
TEST(Immersed, weightsAreThoseOfTheMomentMatrix) {
    InFluid scene;
    scene.open(0), scene.open(1);
    scene.build();
    long mixed = 0;
    const auto weights = scene.weights(mixed);
    EXPECT_EQ(mixed, 0);
    EXPECT_EQ(scene.immersed.fallbacks(), 0);
    const std::vector<Vec3> u = scene.random(scene.all.size(), 2);
    const auto of = [&](std::size_t id, const Vec3&) { return u[id]; };
    const auto found = scene.immersed.interpolate(scene.field<double>(of).data());
    const auto rounded = scene.immersed.interpolate(scene.field<float>(of).data());
    const std::vector<Vec3> expected = scene.withVolume(scene.expected(weights, u), u);
    for (std::size_t m = 0; m < weights.size(); ++m) {
        EXPECT_LT((found[m] - expected[m]).norm(), 1e-11);
        EXPECT_LT((rounded[m] - expected[m]).norm(), 5e-7);
    }
}

// Sheet and caps close a surface, through which a linear field has the flux trace x volume; without it, the nodes of a
// torn cell move with the field.
TEST(Immersed, tornCellsMoveWithALinearFieldWithoutDivergence) {
    InFluid scene;
    scene.tearAround(0, 5), scene.open(1);
    scene.build();
    Mat3 G;
    G << 0.5, -1, 0.3, 0.2, -0.8, 0.7, 1.2, 0.1, 0.3;
    ASSERT_NEAR(G.trace(), 0, 1e-15);
    const Vec3 a(1, -2, 0.5);
    const particles::Box& box = scene.system->box();
    for (const Cell& cell : scene.cells) {
        const Vec3 middle = middleOf(cell);
        const auto u = scene.field<double>(
            [&](std::size_t, const Vec3& x) -> Vec3 { return a + G * box.periodicity().shortest(x - middle); });
        const auto v = scene.immersed.interpolate(u.data());
        const auto& x = cell.membrane.position;
        for (std::size_t n = 0; n < x.size(); ++n)
            EXPECT_LT((v[static_cast<std::size_t>(cell.firstNode) + n] - (a + G * (x[n] - middle))).norm(), 1e-12) << n;
    }
}

TEST(Immersed, constantAndLinearFieldsAreFoundExactly) {
    InFluid scene;
    Mat3 G;
    G << 0.5, -1, 0.3, 0.2, -0.8, 0.7, 1.2, 0.1, 0.6;  // its trace, 0.3, would change the volume
    const Vec3 a(1, -2, 0.5);
    const particles::Box& box = scene.system->box();
    for (std::size_t c = 0; c < 2; ++c) {
        const Cell& cell = scene.cells[c];
        const Vec3 middle = middleOf(cell);
        const auto u = scene.field<double>(
            [&](std::size_t, const Vec3& x) -> Vec3 { return a + G * box.periodicity().shortest(x - middle); });
        const auto v = scene.immersed.interpolate(u.data());
        const auto& x = cell.membrane.position;
        const auto g = membrane::volumeGradient(x, cell.membrane.network().triangles());
        const double grows = G.trace() * cell.membrane.volume() / dot(g, g);
        for (std::size_t n = 0; n < x.size(); ++n)
            EXPECT_LT(
                (v[static_cast<std::size_t>(cell.firstNode) + n] - (a + G * (x[n] - middle) - grows * g[n])).norm(),
                1e-12);
    }
}

TEST(Immersed, whatNodesFindDoesNotChangeTheVolume) {
    InFluid scene;
    const std::vector<Vec3> u = scene.random(scene.all.size(), 3);
    const auto v =
        scene.immersed.interpolate(scene.field<double>([&](std::size_t id, const Vec3&) { return u[id]; }).data());
    scene.immersed.setVelocities(v);
    EXPECT_EQ(scene.immersed.velocities(), v);
    double change[2];
    for (int k = 0; k < 2; ++k) {
        const double h = k == 0 ? 1e-2 : 1e-3;
        scene.immersed.move(h);
        const Cell& cell = scene.cells[0];
        change[k] = std::abs(cell.membrane.volume() / cell.initialVolume - 1);
        scene.immersed.move(-h);
    }
    EXPECT_LT(change[0], 1e-3);
    EXPECT_NEAR(change[1] / change[0], 0.01, 0.002) << "of second order";
}

class Transpose : public ::testing::TestWithParam<bool> {};  // whether the cells are torn
INSTANTIATE_TEST_SUITE_P(WholeAndTorn, Transpose, ::testing::Bool());

TEST_P(Transpose, isWhatSpreadIsOfInterpolate) {
    InFluid scene;
    if (GetParam()) {
        scene.tearAround(0, 7), scene.open(1);
        scene.build();
    }
    const std::vector<Vec3> u = scene.random(scene.all.size(), 4), f = scene.random(scene.nodes(), 5);
    const auto field = scene.field<double>([&](std::size_t id, const Vec3&) { return u[id]; });
    const double atNodes = dot(f, scene.immersed.interpolate(field.data()));
    particles::RealArray force(field.size(), 0.0);
    scene.immersed.spread(f, force);
    double power = 0, magnitude = 0;
    Vec3 total = Vec3::Zero();
    for (std::size_t k = 0; k < field.size(); ++k) {
        power += field[k] * force[k], magnitude += std::abs(field[k] * force[k]);
        if (k % 4 < 3) total[static_cast<int>(k % 4)] += force[k];
    }
    MPI_Allreduce(MPI_IN_PLACE, total.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_NEAR(sph::testing::sumOverRanks(power), atNodes, 1e-14 * sph::testing::sumOverRanks(magnitude));
    EXPECT_GT(std::abs(atNodes), 0.01);
    // The projection keeps the sum of forces, as the gradient of a closed cell's volume sums to zero over its nodes,
    // and that of a torn one with the area vectors of its caps.
    EXPECT_LT((total - std::accumulate(f.begin(), f.end(), Vec3(Vec3::Zero()))).norm(), 1e-12 * std::sqrt(dot(f, f)));
}

// Forces against differences of the energy; stiffness against differences of forces, for membranes at rest, where no
// part of the stiffness is left out.
TEST(Immersed, forcesAndStiffnessAreThoseOfTheMembranes) {
    InFluid scene;
    const std::vector<Vec3> u = scene.random(scene.nodes(), 6);
    const double step = 1e-5;
    const auto moved = [&](double along, auto&& f) {  // calls f with the nodes moved by `along` times u
        std::vector<std::vector<Vec3>> before;
        for (Cell& cell : scene.cells) {
            before.push_back(cell.membrane.position);
            for (std::size_t k = 0; k < cell.membrane.position.size(); ++k)
                cell.membrane.position[k] += along * u[static_cast<std::size_t>(cell.firstNode) + k];
        }
        f();
        for (std::size_t c = 0; c < scene.cells.heldCount(); ++c) scene.cells[c].membrane.position = before[c];
    };
    const auto energyAt = [&](double along) {
        double energy = 0;
        moved(along, [&] {
            for (const Cell& cell : scene.cells) energy += cell.membrane.energy();
        });
        return energy;
    };
    const double power = dot(u, scene.immersed.force()), byEnergy = -(energyAt(step) - energyAt(-step)) / (2 * step);
    EXPECT_NEAR(power, byEnergy, 1e-6 * std::abs(byEnergy));
    EXPECT_GT(std::abs(byEnergy), 0.01);

    for (std::size_t c = 0; c < scene.cells.heldCount(); ++c) {
        scene.cells[c].membrane.position = scene.start[c];
        scene.cells[c].initialVolume = scene.cells[c].membrane.volume();
    }
    scene.build();
    std::vector<Vec3> f(u.size(), Vec3::Zero());
    scene.immersed.addStiffness(0.7, u, f);
    std::vector<Vec3> ahead, behind;
    moved(step, [&] { ahead = scene.elastic(); });
    moved(-step, [&] { behind = scene.elastic(); });
    double largest = 0, worst = 0;
    for (std::size_t m = 0; m < f.size(); ++m) {
        const Vec3 expected = -0.7 / (2 * step) * (ahead[m] - behind[m]);
        largest = std::max(largest, expected.norm()), worst = std::max(worst, (f[m] - expected).norm());
    }
    EXPECT_LT(worst, 1e-5 * largest);
    EXPECT_GT(largest, 0.1);
}

TEST(Immersed, touchesWhatHasAWeight) {
    InFluid scene;
    long mixed = 0;
    std::vector<char> expected(scene.all.size(), 0);
    for (const auto& ofNode : scene.weights(mixed))
        for (const InFluid::Weight& w : ofNode) expected[w.particle] |= w.along != 0;
    for (const int i : scene.immersed.touched())
        EXPECT_TRUE(expected[static_cast<std::size_t>(scene.system->store().id[static_cast<std::size_t>(i)])]);
    EXPECT_EQ(sph::testing::sumOverRanks(static_cast<double>(scene.immersed.touched().size())),
              std::count(expected.begin(), expected.end(), 1));
}

TEST(Immersed, volumeIsRestoredAlongItsGradient) {
    InFluid scene;
    for (Cell& cell : scene.cells) cell.initialVolume *= 1.001;
    const auto before = scene.positions();
    scene.open(1);
    scene.immersed.restoreVolume();
    const Cell& cell = scene.cells[0];
    EXPECT_NEAR(cell.membrane.volume() / cell.initialVolume, 1, 1e-6);
    const std::size_t n = cell.membrane.position.size();
    const auto g = membrane::volumeGradient({before.data(), n}, cell.membrane.network().triangles());
    std::vector<Vec3> moved(n);
    for (std::size_t k = 0; k < n; ++k) moved[k] = cell.membrane.position[k] - before[k];
    EXPECT_NEAR(dot(moved, g) / std::sqrt(dot(moved, moved) * dot(g, g)), 1, 1e-12);
    EXPECT_TRUE(std::equal(before.begin() + static_cast<std::ptrdiff_t>(n), before.end(),
                           scene.cells[1].membrane.position.begin()))
        << "an opened cell has no volume to keep";
}

// With fluid only well outside the first cell, the full weights would extrapolate, and are mixed with the plain mean.
TEST(Immersed, plainMeanWhereWeightsAreLarge) {
    InFluid scene;
    const particles::Box& box = scene.system->box();
    const Vec3 middle = middleOf(scene.cells[0]);
    for (std::size_t j = 0; j < scene.all.size(); ++j)
        if (box.periodicity().shortest(scene.all[j].x - middle).norm() < radius + 0.6) scene.volumes[j] = 0;
    scene.open(0), scene.open(1);
    scene.build();
    long mixed = 0;
    const auto weights = scene.weights(mixed);
    EXPECT_EQ(scene.immersed.fallbacks(), mixed);
    EXPECT_GT(mixed, 20);
    const std::vector<Vec3> u = scene.random(scene.all.size(), 7);
    const auto found =
        scene.immersed.interpolate(scene.field<double>([&](std::size_t id, const Vec3&) { return u[id]; }).data());
    const std::vector<Vec3> expected = scene.expected(weights, u);
    // The first cell has no fluid at its hole for moving least squares: compared is what the projection leaves alone.
    for (const Cell& cell : scene.cells) {
        const std::vector<Vec3> g = scene.gradient(cell);
        std::vector<Vec3> error;
        for (std::size_t n = 0; n < g.size(); ++n) {
            const std::size_t m = static_cast<std::size_t>(cell.firstNode) + n;
            error.push_back(found[m] - expected[m]);
        }
        const double along = dot(g, error) / dot(g, g);
        for (std::size_t n = 0; n < g.size(); ++n) EXPECT_LT((error[n] - along * g[n]).norm(), 1e-10);
    }
}

// The share of the plain mean changes gradually: a membrane that grows towards fluid around it, with none inside,
// does not change its velocity by a jump.
TEST(Immersed, velocitiesAreContinuousWherePlainMeanSetsIn) {
    InFluid scene;
    const particles::Box& box = scene.system->box();
    const Vec3 middle = middleOf(scene.cells[0]);
    for (std::size_t j = 0; j < scene.all.size(); ++j)
        if (box.periodicity().shortest(scene.all[j].x - middle).norm() < radius + 0.3) scene.volumes[j] = 0;
    const std::vector<Vec3> u = scene.random(scene.all.size(), 7);
    const auto field = scene.field<double>([&](std::size_t id, const Vec3&) { return u[id]; });
    constexpr int positions = 200;
    const std::vector<Vec3> start = scene.cells[0].membrane.position;
    std::vector<Vec3> before;
    double largest = 0;
    long fewest = std::numeric_limits<long>::max(), most = 0;
    for (int k = 0; k < positions; ++k) {
        for (std::size_t n = 0; n < start.size(); ++n)
            scene.cells[0].membrane.position[n] = middle + (0.9 + 0.2 * k / positions) * (start[n] - middle);
        scene.build();
        fewest = std::min(fewest, scene.immersed.fallbacks()), most = std::max(most, scene.immersed.fallbacks());
        const std::vector<Vec3> v = scene.immersed.interpolate(field.data());
        for (std::size_t m = 0; m < before.size(); ++m) largest = std::max(largest, (v[m] - before[m]).norm());
        before = v;
    }
    EXPECT_GT(most, fewest + 50) << "the membrane does not pass from one to the other";
    EXPECT_LT(largest, 0.1);
}

// Weights that reproduce linear fields exactly pass a force to the fluid with its torque; the forces of a membrane have
// no net torque.
TEST(Immersed, spreadForcesKeepTheirTorque) {
    InFluid scene;
    ASSERT_EQ(scene.immersed.fallbacks(), 0) << "the plain mean keeps the force alone";
    const std::vector<Vec3> forces = scene.immersed.force();
    std::size_t first = 0;
    for (const Cell& cell : scene.cells) {
        const auto count = static_cast<std::size_t>(cell.nodeCount());
        std::vector<Vec3> own(forces.size(), Vec3::Zero());
        std::copy_n(forces.begin() + static_cast<std::ptrdiff_t>(first), count,
                    own.begin() + static_cast<std::ptrdiff_t>(first));
        first += count;
        const ParticleStore& s = scene.system->store();
        particles::RealArray spread(4 * s.size(), 0.0);
        scene.immersed.spread(own, spread);
        const Vec3 middle = middleOf(cell);
        Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
        double scale = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec3 f = Vec3::Map(spread.data() + 4 * i),
                       arm = scene.system->periodicity().shortest(s.position(i) - middle);
            force += f, torque += arm.cross(f), scale += arm.norm() * f.norm();
        }
        scale = sph::testing::sumOverRanks(scale);
        EXPECT_GT(scale, 1e-3);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(sph::testing::sumOverRanks(force[k]), 0, 1e-12 * scale);
            EXPECT_NEAR(sph::testing::sumOverRanks(torque[k]), 0, 1e-12 * scale);
        }
    }
}

// Where a rank holds only the cells near its brick, sums are exchanged among holders: weights, velocities and forces
// are the same as where every rank holds every cell, up to rounding, and the same bits on all holders.
class Holders : public ::testing::TestWithParam<bool> {};  // whether the cells are torn
INSTANTIATE_TEST_SUITE_P(WholeAndTorn, Holders, ::testing::Bool());

TEST_P(Holders, ofWhatIsNearFindTheSame) {
    const auto scene = [](double margin) {
        SphereScene s({14, 12, 12}, {Vec3(3.5, 0.2, 9.5), Vec3(10.5, 5, 5)}, true, margin);
        for (Cell& cell : s.cells) {
            for (Vec3& x : cell.membrane.position) x[0] += 0.04 * std::sin(x[1]);
            std::vector<char> alive(cell.membrane.network().allBonds().size(), 1);
            for (std::size_t k = 40; k < 70; ++k) alive[k] = 0;
            if (GetParam()) cell.membrane.restore(alive);
        }
        return s;
    };
    SphereScene all = scene(Cells::everywhere), some = scene(Immersed::margin(1, 2.3, skin));
    const ParticleStore& s = some.system->store();
    ASSERT_EQ(s.id, all.system->store().id);
    const std::vector<double> volumes(s.size(), 1.0);
    std::vector<double> u(4 * s.size(), 0.0);
    for (std::size_t i = 0; i < s.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            u[4 * i + k] = std::sin(static_cast<double>(3 * s.id[i]) + static_cast<double>(k));
    const sph::FluidModel model = sph::testing::model("wendlandC2");
    Immersed one(all.cells, model, *all.system), other(some.cells, model, *some.system);
    one.build(*all.system, volumes), other.build(*some.system, volumes);
    EXPECT_EQ(one.fallbacks(), other.fallbacks());
    const Immersed::Vectors v = one.interpolate(u.data()), w = other.interpolate(u.data());
    Immersed::Vectors f = v, g = w;
    one.addResistance(0.1, v, f), other.addResistance(0.1, w, g);
    // Least and greatest value over the ranks; a rank without the cell leaves both at their bounds.
    std::vector<double> bits(6 * 2 * all.start[0].size(), 0.0), least = bits;
    std::fill(least.begin(), least.end(), 1e300);
    auto most = bits;
    std::fill(most.begin(), most.end(), -1e300);
    for (std::size_t c = 0; c < some.cells.heldCount(); ++c) {
        const auto cell = static_cast<std::size_t>(some.cells[c].membrane.cell) - 1;
        for (std::size_t m = other.layout().first(c); m < other.layout().last(c); ++m) {
            const std::size_t there = all.start[0].size() * cell + m - other.layout().first(c);
            EXPECT_LT((w[m] - v[there]).norm(), 1e-13);
            EXPECT_LT((g[m] - f[there]).norm(), 1e-12);
            for (std::size_t k = 0; k < 3; ++k) {
                least[6 * there + k] = most[6 * there + k] = w[m][static_cast<int>(k)];
                least[6 * there + 3 + k] = most[6 * there + 3 + k] = g[m][static_cast<int>(k)];
            }
        }
    }
    const int count = static_cast<int>(bits.size());
    MPI_Allreduce(MPI_IN_PLACE, least.data(), count, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, most.data(), count, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_EQ(least, most) << "holders differ, or nobody holds a cell";
    particles::RealArray force(4 * s.size(), 0.0), same = force;
    one.spread(f, force), other.spread(g, same);
    for (std::size_t k = 0; k < force.size(); ++k) EXPECT_NEAR(force[k], same[k], 1e-12);
    EXPECT_NEAR(sph::testing::sumOverRanks(other.ownDot(w, g)), sph::testing::sumOverRanks(one.ownDot(v, f)), 1e-11);
    EXPECT_NEAR(one.meanResistance(0.3), other.meanResistance(0.3), 1e-13);
}
