// Tears that run through a flat sheet: the energy that a tear takes as it runs, and Griffith's tension of a slit. Each
// case loads the sheet step by step and looks for equilibrium and damage in turns (tearCases.hpp).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/settings.hpp"
#include "membrane/gradientDamage.hpp"
#include "tearCases.hpp"

namespace corpuscle::membrane {
namespace {

using namespace testing;

constexpr double fractureEnergy = 1e-5;

// A sheet with a tear along y = 0 from its left side, whose torn nodes end at x = tip.
class TornSheet {
  public:
    TornSheet(const Mesh& mesh, double edge, double tip)
        : mesh(mesh),
          sheet("sheet", 1, mesh.nodes, mesh.triangles, settingsOf(tearingSheet(fractureEnergy)), 1.0),
          edge_(edge) {
        const double h = std::sqrt(0.75) * edge;
        std::vector<double> damage(mesh.nodes.size(), 0.0);
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
            const Vec3& x = mesh.nodes[n];
            if (x.x() > tip + 1e-9 || x.y() < -0.5 * h || x.y() > 1.5 * h) continue;
            damage[n] = 1;
            length = std::max(length, x.x());
        }
        sheet.restore(sheet.network().aliveBonds(), damage);
        sheet.breakBonds(sheet.findBroken(0));
        start_ = sheet.tearLength();
        loads.held.assign(mesh.nodes.size(), {false, false, true});
        loads.force.assign(mesh.nodes.size(), Vec3::Zero());
    }

    // Length by which the tear grows under the present loads; more than `enough`: it runs.
    double grow(double tension, double enough) {
        const auto grown = [&] { return sheet.tearLength() - start_; };
        settle(sheet, loads, tension * edge_, 1e-4, 300, [&] { return grown() > enough; });
        return grown();
    }

    Mesh mesh;
    Membrane sheet;
    Loads loads;
    double length = 0;  // of the tear, to the last torn node

  private:
    double edge_, start_ = 0;
};

// A strip between clamped edges at y = +-H that move apart stores (Ks + Gs)/2 (u/H)^2 2 H ahead of a tear, for each
// length, and nothing behind it: a tear runs when this is what it costs.
TEST(Griffith, RunningTearTakesItsEnergy) {
    const double H = 8, L = 44, enough = 6;
    for (const auto& [edge, seed] : {std::pair{0.5, 1u}, {0.33, 2u}}) {
        TornSheet torn(
            rectangle(graded(0, L, edge, 0, 1e9, 1), graded(-H, H, std::sqrt(0.75) * edge, 0, 4, 1.08), 0.2, seed),
            edge, 20);
        for (std::size_t n = 0; n < torn.mesh.nodes.size(); ++n) {
            if (std::abs(torn.mesh.nodes[n].y()) > H - 1e-9) torn.loads.held[n] = {true, true, true};
            if (torn.mesh.nodes[n].x() > L - 1e-9) torn.loads.held[n][0] = true;
        }
        double level = 0.9, grown = 0;
        for (; grown <= enough && level < 1.1; level += 0.01) {
            const double strain = level * std::sqrt(fractureEnergy / (H * (0.4 + 0.66666666667)));
            for (std::size_t n = 0; n < torn.mesh.nodes.size(); ++n)
                if (torn.loads.held[n][1]) torn.sheet.position[n].y() = (1 + strain) * torn.mesh.nodes[n].y();
            grown = torn.grow(strain, enough);
        }
        level -= 0.01;
        fmt::print("edge {}: runs at {:.2f} of the opening at which it should\n", edge, level);
        EXPECT_NEAR(level, 1, 0.03) << edge;
    }
}

// A slit of half-length c in a square sheet of half-width w = 4 c under tension grows at sqrt(E G/(pi c))/F, with F for
// the finite width: 1.085 (Isida, Int. J. Fract. Mech. 7:301, 1971; interpolated between 1.055 at c/w = 0.2 and 1.123
// at 0.3). The sheet weakens ahead of the slit over some lengths l, so that Griffith's tension is reached from below as
// c/l grows. Half of the sheet is computed.
TEST(Griffith, SlitGrowsAtGriffithsTension) {
    const double edge = 0.5, enough = 6;
    double before = 0;
    for (const double c : {7.0, 25.0, 100.0, 400.0}) {
        const double w = 4 * c;
        TornSheet torn(
            rectangle(graded(0, w, edge, c + 2, 8, 1.06), graded(-w, w, std::sqrt(0.75) * edge, 0, 5, 1.06), 0.2, 1),
            edge, c);
        std::vector<double> share(torn.mesh.nodes.size(), 0.0);  // of the loaded border's length, with the sign of y
        for (const Bond& bond : torn.sheet.network().allBonds()) {
            const auto [left, right] = torn.sheet.network().bondTriangles(bond.number);
            const Vec3 &a = torn.mesh.nodes[bond.node[0]], &b = torn.mesh.nodes[bond.node[1]];
            if ((left >= 0 && right >= 0) || std::abs(a.y() - b.y()) > 1e-9) continue;
            for (const int n : bond.node) share[n] += 0.5 * std::abs(b.x() - a.x()) * (a.y() > 0 ? 1 : -1);
        }
        // The plane of symmetry x = 0, and against motion along y the middle of the other side.
        std::size_t middle = 0;
        const auto fromMiddle = [&](std::size_t n) { return (torn.mesh.nodes[n] - Vec3(w, 0, 0)).norm(); };
        for (std::size_t n = 0; n < torn.mesh.nodes.size(); ++n) {
            if (torn.mesh.nodes[n].x() < 1e-9) torn.loads.held[n][0] = true;
            if (fromMiddle(n) < fromMiddle(middle)) middle = n;
        }
        torn.loads.held[middle][1] = true;

        const double griffith = std::sqrt(fractureEnergy / (std::numbers::pi * torn.length)) / 1.085;
        double level = c < 20 ? 0.8 : c < 50 ? 0.9 : 0.95, grown = 0;
        const double step = 0.005;
        for (; grown <= enough && level < 1.1; level += step) {
            for (std::size_t n = 0; n < share.size(); ++n) torn.loads.force[n].y() = level * griffith * share[n];
            grown = torn.grow(griffith, enough);
        }
        level -= step;
        fmt::print("c = {:.1f} l: grows at {:.3f} of Griffith's tension\n", torn.length, level);
        std::fflush(stdout);
        EXPECT_GT(level, before) << "it comes nearer to Griffith's tension as the slit becomes longer";
        before = level;
    }
    EXPECT_NEAR(before, 1, 0.03);
}

}  // namespace
}  // namespace corpuscle::membrane
