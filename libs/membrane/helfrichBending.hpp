// Bending energy of Helfrich on a triangle mesh, node by node (Juelicher 1996), with the area difference of the layers
// (ADE)
//     E = kappa/2 sum_v (2 M_v/A_v - c0)^2 A_v  +  pi alpha kappa/(2 A0 D^2) (DeltaA - DeltaA0)^2
//     M_v = 1/4 sum over the edges at v of l theta,    DeltaA = 2 D sum_v M_v
// symbol  | meaning                                                                                    | unit
// kappa   | bending modulus, of kappa/2 Int (c1 + c2 - c0)^2 dA                                        | J
// Eb      | kappa/(Gs a^2); exactly one of Eb and kappa is given                                       | -
// c0      | spontaneous curvature, of c1 + c2: a sphere of radius 2/c0 has no energy; positive bulges  | 1/m
//         | outwards                                                                                   |
// l,theta | length of an edge, its dihedral angle (coordinates.hpp)                                    | m, rad
// M_v     | Int H dA over the node's share of the surface, H = (c1 + c2)/2 = 1/R on a sphere           | m
// A_v     | Voronoi area of the node (helfrichTerm.hpp); the sum is the mesh's area                    | m^2
// alpha   | ratio: modulus of the area difference over kappa; 2/pi in Lim et al. 2002 (from memory)    | -
// D       | distance of the layers' neutral surfaces (key thickness; only where DeltaA0 is absolute:   | m
//         | else it cancels)                                                                           |
// DeltaA0 | rest area difference, outer minus inner layer. absolute: DeltaA0 itself.                   | m^2
//         | reduced: DeltaA0/(8 pi D R0), relative to the sphere of the stress-free mesh's area        | -
//         | A0 = 4 pi R0^2; the term is then 8 pi^2 alpha kappa (m - m0)^2, m = sum M_v/(4 pi R0)      |
// This energy contains no rest state of the mesh: without c0 a flat sheet is at rest, and every closed cell is driven
// towards a sphere. The Gaussian part is a constant of the topology and is left out.
//
// Sources: Juelicher, J. Phys. II France 6, 1797 (1996) (energy from edges); Meyer, Desbrun, Schroeder, Barr, VisMath
// 2002 (Voronoi areas); Seifert, Adv. Phys. 46, 13 (1997) and Lim, Wortis, Mukhopadhyay, PNAS 99, 16766 (2002) (ADE).
//
// Reason for Voronoi areas instead of a third of each triangle: with the nodes on a sphere, M_v = (Voronoi area of v)/R
// up to the square of the edge length, on every Delaunay mesh, so that 2 M_v/A_v is correct at each node; with thirds,
// an error remains that does not shrink where triangles are unequal. In obtuse triangles the Voronoi shares are
// limited, smoothly. Where c1 != c2, the ring of neighbours of a node on a disordered mesh also contributes (c1 - c2)
// times its asymmetry; this does not shrink with the edge, and its square adds to the energy. docs/theory/membrane.md
// has the errors: below 0.2 % on meshes of membraneMesh, 2 % in the limit on a mesh in which two triangles in five are
// obtuse.
//
// Open cells: a node contributes if each of its edges has two whole triangles. Nodes of a rim (border of the mesh,
// hole) have no energy of their own, since a rim bears no moment. Lipids cross from layer to layer over a rim;
// therefore the area difference is rejected on a mesh with a border and switched off permanently when the cell
// ruptures.
#pragma once
#include <optional>

#include "core/settings.hpp"
#include "membrane/bendingLaw.hpp"

namespace corpuscle::membrane {

struct AreaDifference {
    double ratio = 0;                   // alpha
    std::optional<double> reduced{};    // m0
    std::optional<double> absolute{};   // DeltaA0, m^2
    std::optional<double> thickness{};  // D, m
    static const Schema<AreaDifference>& schema();
};

struct HelfrichBending : BendingLaw {
    std::optional<double> Eb;         // -
    std::optional<double> kappa;      // J
    double spontaneousCurvature = 0;  // c0, 1/m
    std::optional<AreaDifference> areaDifference;

    double bendingModulus(const MembraneScale& scale) const override {
        return Eb ? *Eb * scale.shearModulus * scale.radius * scale.radius : *kappa;
    }
    // Throws Failure(invalidCase) for an area difference on a mesh with a border.
    std::unique_ptr<Term> makeTerm(Network& network, const MembraneScale& scale) const override;
    static const Schema<HelfrichBending>& schema();
};

}  // namespace corpuscle::membrane
