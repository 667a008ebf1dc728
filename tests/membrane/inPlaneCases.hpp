// In-plane laws, patches and helper functions shared by the tests of moduli, of finite strain and of costs.
#pragma once
#include "cases.hpp"
#include "membrane/fenePow.hpp"
#include "membrane/harmonicBond.hpp"
#include "membrane/latticeSheet.hpp"
#include "membrane/linearElastic.hpp"
#include "membrane/membrane.hpp"
#include "membrane/neoHookean.hpp"
#include "membrane/skalak.hpp"
#include "membrane/wlcPow.hpp"
#include "meshes.hpp"

namespace corpuscle::membrane::testing {

using Mat2 = Eigen::Matrix2d;

inline constexpr double G = 1.1, K = 1.7, C = 3;

inline HarmonicBond harmonic(double k, bool scaled = false) {
    HarmonicBond law;
    law.k = k;
    law.scaled = scaled;
    return law;
}
template <class Law>
inline Law contour(double x0, double m, bool scaled = false) {
    Law law;
    law.Gs = G;
    law.x0 = x0;
    law.m = m;
    law.scaled = scaled;
    return law;
}
inline NeoHookean neoHookean() {
    NeoHookean law;
    law.Gs = G;
    return law;
}
inline Skalak skalak() {
    Skalak law;
    law.Gs = G;
    law.C = C;
    return law;
}
inline LinearElastic linear() {
    LinearElastic law;
    law.Gs = G;
    law.Ks = K;
    return law;
}
inline LatticeSheet lattice() {
    LatticeSheet law;
    law.Gs = G;
    return law;
}

// A hexagonal patch with nodes displaced in its plane; the valence stays six.
inline Mesh jitteredPatch(int n) {
    Mesh mesh = hexagonalPatch(n);
    jitter(mesh.nodes, 0.2, 5);
    for (Vec3& x : mesh.nodes) {
        x.z() = 0;
    }
    return mesh;
}

inline double areaOf(const Mesh& mesh) {
    double area = 0;
    for (const Index3& t : mesh.triangles) {
        area += areaVector(mesh.nodes, t).norm();
    }
    return area;
}

inline std::vector<Vec3> mapped(const Mesh& mesh, const Mat2& F) {
    std::vector<Vec3> x = mesh.nodes;
    for (Vec3& p : x) {
        p.head<2>() = F * p.head<2>();
    }
    return x;
}

inline std::unique_ptr<Membrane> makeMembrane(const Mesh& mesh, const MembraneSettings& laws) {
    return std::make_unique<Membrane>("cell", 1, mesh.nodes, mesh.triangles, laws, 1.0);
}

inline double energyOf(const Mesh& mesh, const MembraneSettings& laws, const Mat2& F) {
    const auto membrane = makeMembrane(mesh, laws);
    membrane->position = mapped(mesh, F);
    return membrane->energy();
}

struct ModuliCase {
    const char* name;
    MembraneSettings laws;
    double Gs, Ks;
    bool anyMesh;  // triangle laws and scaled bonds
};

// Bonds with their own constants: the formulas of the reference data (spring_network, analytic, checked numerically
// there).
inline double wlcShear(double kBT, double p, double x0, double m, double l0) {
    const double lm = l0 / x0, force = kBT / p * (0.25 / ((1 - x0) * (1 - x0)) - 0.25 + x0);
    const double kp = force * std::pow(l0, m);
    return std::sqrt(3.0) * kBT / (4 * p * lm * x0) *
               (x0 / (2 * std::pow(1 - x0, 3)) - 1 / (4 * std::pow(1 - x0, 2)) + 0.25) +
           std::sqrt(3.0) * kp * (m + 1) / (4 * std::pow(l0, m + 1));
}
inline double feneShear(double ks, double x0, double m, double l0) {
    const double kp = ks * l0 / (1 - x0 * x0) * std::pow(l0, m);
    return std::sqrt(3.0) / 4 * (2 * ks * x0 * x0 / std::pow(1 - x0 * x0, 2) + kp * (m + 1) / std::pow(l0, m + 1));
}

inline WlcPow wlcByLength() {
    WlcPow law = contour<WlcPow>(0.4545, 2);
    law.Gs.reset();
    law.kBT = 1.3;
    law.persistenceLength = 0.9;
    return law;
}
inline FenePow feneBySpring() {
    FenePow law = contour<FenePow>(0.45, 2.5);
    law.Gs.reset();
    law.ks = 0.8;
    return law;
}

inline std::vector<ModuliCase> moduliCases() {
    const double wlc = wlcShear(1.3, 0.9, 0.4545, 2, 1), fene = feneShear(0.8, 0.45, 2.5, 1);
    return {{"harmonic", only(harmonic(2)), 0.8660254037844386, 1.7320508075688772, false},
            {"harmonic scaled", only(harmonic(2, true)), 0.8660254037844386, 1.7320508075688772, true},
            {"wlcPow p", only(wlcByLength()), wlc, 2 * wlc, false},
            {"wlcPow Gs", only(contour<WlcPow>(0.4, 2)), G, 2 * G, false},
            {"wlcPow Gs scaled", only(contour<WlcPow>(0.4, 1.5, true)), G, 2 * G, true},
            {"fenePow ks", only(feneBySpring()), fene, 2 * fene, false},
            {"fenePow Gs", only(contour<FenePow>(0.5, 2)), G, 2 * G, false},
            {"fenePow Gs scaled", only(contour<FenePow>(0.5, 3, true)), G, 2 * G, true},
            {"neoHookean", only(neoHookean()), G, 3 * G, true},
            {"skalak", only(skalak()), G, (1 + 2 * C) * G, true},
            {"linear", only(linear()), G, K, true},
            {"lattice", only(lattice()), G, 2 * G, true}};
}

}  // namespace corpuscle::membrane::testing
