// What observers and writers read off a membrane. Nothing here is computed unless it is asked for.
//
// areaStrain         | A/A0 - 1 of each triangle
// tension1, tension2 | principal values of the triangle's tension, tension1 >= tension2, N/m: the virial of its bonds,
//                    | T = 1/A sum over its three bonds of (1/2) E'(l) l e e^T; the other half is the next triangle's,
//                    | or the hole's; plus that of the triangle law, T = A0/A sum of t_ij over edge pairs
//                    | (triangleTerm.hpp); angle, area and bending laws are not in it
// stretch            | mean l/l0 of the living bonds of each node
// hole               | number of the rim, from 1 in the order of Network::rims(), that each node stands on; 0: none
// Arrays have one value per triangle or node of the mesh as made; broken triangles and nodes without bonds have 0.
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

// Of one triangle, broken or not: (tension1, tension2), (0, 0) when it has no area.
double arealStrain(const Network& network, int triangle, std::span<const Vec3> x);
std::pair<double, double> principalTensions(const Network& network, const MembraneSettings& laws, int triangle,
                                            std::span<const Vec3> x);

std::vector<double> areaStrain(const Network& network, std::span<const Vec3> x);
PrincipalTensions principalTensions(const Network& network, const MembraneSettings& laws, std::span<const Vec3> x);
std::vector<double> nodeStretch(const Network& network, std::span<const Vec3> x);
std::vector<double> vertexAreas(const Network& network,
                                std::span<const Vec3> x);  // a third of each whole triangle, m^2
std::vector<std::int64_t> holeOfNodes(const Network& network);
double maxBondStrain(const Network& network, std::span<const Vec3> x);   // largest l/l0 - 1; 0 without bonds
double maxArealStrain(const Network& network, std::span<const Vec3> x);  // of the whole triangles; 0 without any
double maxTension(const Network& network, const MembraneSettings& laws, std::span<const Vec3> x);  // N/m, as these

}  // namespace corpuscle::membrane
