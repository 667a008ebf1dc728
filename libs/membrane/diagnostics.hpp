// What observers and writers read off a membrane. Nothing here is computed unless it is asked for.
//
// areaStrain         | A/A0 - 1 of each triangle
// tension1, tension2 | principal values of the triangle's tension, tension1 >= tension2, N/m: the virial of its bonds,
//                    | T = 1/A sum over its three bonds of (1/2) E'(l) l e e^T; the other half is the next triangle's,
//                    | or the hole's; plus that of the triangle law, T = A0/A sum of t_ij over edge pairs
//                    | (triangleTerm.hpp); angle, area and bending laws are not in it
// stretch            | mean l/l0 of the living bonds of each node
// Arrays have one value per triangle or node of the mesh as made; broken triangles and nodes without bonds have 0.
#pragma once
#include <span>
#include <vector>

#include "membrane/membraneSettings.hpp"

namespace corpuscle::membrane {

struct PrincipalTensions {
    std::vector<double> tension1, tension2;  // N/m
};

std::vector<double> areaStrain(const Network& network, std::span<const Vec3> x);
PrincipalTensions principalTensions(const Network& network, const MembraneSettings& laws, std::span<const Vec3> x);
std::vector<double> nodeStretch(const Network& network, std::span<const Vec3> x);
std::vector<double> vertexAreas(const Network& network,
                                std::span<const Vec3> x);               // a third of each whole triangle, m^2
double maxBondStrain(const Network& network, std::span<const Vec3> x);  // largest l/l0 - 1; 0 without bonds

}  // namespace corpuscle::membrane
