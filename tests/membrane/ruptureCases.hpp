// Membranes for the tests of rupture.
#pragma once
#include "core/registry.hpp"
#include "membrane/bondStretch.hpp"
#include "membrane/dihedralBending.hpp"
#include "membrane/harmonicAngle.hpp"
#include "membrane/harmonicBond.hpp"
#include "membrane/membrane.hpp"
#include "meshes.hpp"

namespace corpuscle::membrane::testing {

inline MembraneSettings allLaws() {
    auto bonds = std::make_shared<HarmonicBond>();
    bonds->k = 2;
    auto angles = std::make_shared<HarmonicAngle>();
    angles->k = 0.3;
    auto bending = std::make_shared<DihedralBending>();
    bending->Eb = 0.05;
    auto rupture = std::make_shared<BondStretch>();
    rupture->limit = 1.05;
    MembraneSettings settings;
    settings.bonds = {"harmonic", bonds};
    settings.angles = {"harmonic", angles};
    settings.bending = {"dihedral", bending};
    settings.rupture = {"bondStretch", rupture};
    return settings;
}

inline Membrane membraneOf(const Mesh& mesh, const MembraneSettings& settings) {
    return Membrane("cell", 1, mesh.nodes, mesh.triangles, settings, 1.0);
}

inline std::vector<BrokenBond> breakNow(Membrane&& membrane, double dt = 0) {
    return membrane.breakBonds(membrane.findBroken(dt));
}
inline std::vector<BrokenBond> breakNow(Membrane& membrane, double dt = 0) { return breakNow(std::move(membrane), dt); }

// A lattice strained by (a, b) along x and y: every triangle has the areal strain a b - 1 and the same tension.
inline Membrane strainedSheet(const std::string& laws, double a, double b) {
    Problems problems;
    const auto settings = read<MembraneSettings>(parseValue(laws, "test", problems), problems);
    problems.throwIfAny();
    Membrane sheet = membraneOf(hexagonalPatch(4), settings);
    for (Vec3& x : sheet.position) {
        x = Vec3(a * x.x(), b * x.y(), 0);
    }
    return sheet;
}

}  // namespace corpuscle::membrane::testing
