// Pores by areal strain: the bilayer bears a strain e0, and a part of the area beyond it is pores,
//     phi_eq = s max(0, A - (1 + e0) A0)/A
// symbol | meaning                                                    | unit
// A, A0  | present and stress-free area of the triangles of a node    | m^2
// e0     | areal strain that the bilayer bears (key onset)            | -
// s      | part of the area beyond it that is pores (key share), to 1 | -
// With s = 1 the bilayer between the pores stays at the strain e0. Red cells lyse at 2 to 4 % of areal strain (Evans,
// Waugh and Melnik, Biophys. J. 16 (1976) 585); models of haemolysis by pores use 3 to 6 %.
#pragma once
#include "membrane/poreLaw.hpp"

namespace corpuscle::membrane {

struct ExcessArea : PoreLaw {
    double onset = 0, share = 1;

    std::vector<double> atRest(const Network& network, const MembraneSettings& laws,
                               std::span<const Vec3> x) const override;
    static const Schema<ExcessArea>& schema();
};

}  // namespace corpuscle::membrane
