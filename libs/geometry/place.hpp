// Where a surface is put that is made around the origin with its axis along z.
//
//     x -> centre + scale R x,    R: the shortest rotation from z to the axis
#pragma once
#include <vector>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

struct Place {
    Vec3 centre = Vec3::Zero();  // [m]
    Vec3 axis = Vec3::UnitZ();   // of any length above zero
    double scale = 1;

    std::vector<Vec3> of(std::vector<Vec3> nodes) const {
        const Mat3 turn = rotationFromZ(axis);
        for (Vec3& x : nodes) x = turn * x, x = scale * x + centre;
        return nodes;
    }
};

}  // namespace corpuscle::geometry
