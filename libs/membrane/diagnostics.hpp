// Quantities of a membrane for observers and writers. Nothing here is computed unless it is requested.
//
// areaStrain         | A/A0 - 1 of each triangle
// tension1, tension2 | principal values of the triangle's tension, tension1 >= tension2, N/m: the virial of its bonds,
//                    | T = 1/A sum over its three bonds of (1/2) E'(l) l e e^T, where the other half belongs to the
//                    | adjacent triangle or to the hole; plus the tension of the triangle law, T = A0/A sum of t_ij
//                    | over edge pairs (triangleTerm.hpp); angle, area and bending laws are not included
// stretch            | mean l/l0 of the unbroken bonds of each node
// hole               | number of the rim on which each node lies, from 1 in the order of Network::rims(); 0: none
// isotropicTensions  | mean of tension1 and tension2 plus the tension of the area laws: k (A - A0)/A0 of the triangle
//                    | and, in a membrane that was never torn, of the whole (areaConstraint.hpp), N/m
// heldPressures      | pressure inside less that outside that these forces f of the membrane on the fluid hold, at each
//                    | node with its neighbours: - sum f.n/sum A, A n: a third of the area vectors of a node's whole
//                    | triangles, Pa
// Arrays have one value per triangle or node of the original mesh; broken triangles and nodes without bonds have 0.
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "membrane/membraneSettings.hpp"

namespace corpuscle::membrane {

struct PrincipalTensions {
    std::vector<double> tension1, tension2;  // N/m
};

// Values of one triangle, broken or not. principalTensions returns (tension1, tension2), or (0, 0) if the triangle has
// no area.
double arealStrain(const Network& network, int triangle, std::span<const Vec3> x);
std::pair<double, double> principalTensions(const Network& network, const MembraneSettings& laws, int triangle,
                                            std::span<const Vec3> x);

std::vector<double> areaStrain(const Network& network, std::span<const Vec3> x);
PrincipalTensions principalTensions(const Network& network, const MembraneSettings& laws, std::span<const Vec3> x);
std::vector<double> isotropicTensions(const Network& network, const MembraneSettings& laws, std::span<const Vec3> x);
std::vector<double> nodeStretch(const Network& network, std::span<const Vec3> x);
std::vector<double> vertexAreas(const Network& network,
                                std::span<const Vec3> x);  // a third of each whole triangle at the node, m^2
std::vector<std::int64_t> holeOfNodes(const Network& network);
std::vector<double> heldPressures(const Network& network, std::span<const Vec3> x, std::span<const Vec3> force);
double maxBondStrain(const Network& network, std::span<const Vec3> x);   // largest l/l0 - 1; 0 without bonds
double maxArealStrain(const Network& network, std::span<const Vec3> x);  // of the whole triangles; 0 if there are none
// Largest tension1 of the whole triangles, N/m; 0 if there are none.
double maxTension(const Network& network, const MembraneSettings& laws, std::span<const Vec3> x);

}  // namespace corpuscle::membrane
