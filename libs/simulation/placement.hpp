// Checks that cells, rigid bodies and walls are clear of each other at the start. A body may lie inside a cell.
//
// problem                                         | how it is found
// surfaces touch or cross, images included        | triangles of neighbours are tested (geometry/crossings.hpp)
// one surface lies inside another                 | one of its nodes is tested (geometry/insideTest.hpp)
// surfaces are closer than 0.1 spacings           | nodes against the triangles of neighbours. No particle between such
//                                                 | surfaces could stay on its side
// a surface reaches across a wall, or is longer   | from its bounds
// than the periodic box                           |
// particleFill and runs accept only what passes; during a run StateCheck makes similar checks (stateCheck.hpp).
#pragma once
#include <functional>

#include "core/error.hpp"
#include "coupling/scene.hpp"
#include "geometry/crossings.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

struct Placed {
    std::string name;             // "cell 'a'"
    std::string shapeKey, place;  // keys of its shape, "cells[0].shape", and of its place, "cells[0].centre"
    bool isBody;
    geometry::SurfaceView surface;
};

// All problems, with the keys of system/mesh.yaml; empty if there are none. isMine(i, j): whether to check this pair;
// isMine(i, i): whether to check one surface against its own images and the walls.
std::vector<Problem> misplaced(const Case& input, const std::vector<Placed>& all,
                               const std::function<bool(std::size_t, std::size_t)>& isMine = {});

// All cells and bodies of a case in its order. The result refers to the meshes, which must outlive it.
std::vector<Placed> placedOf(const Case& input, const std::vector<geometry::TriangleMesh>& cells,
                             const std::vector<geometry::TriangleMesh>& bodies);

// Throws CaseError, on all ranks, if cells, bodies or walls of a scene at t = 0 are not clear of each other. Each rank
// checks the surfaces that it holds. Collective.
void requireClear(const Case& input, const coupling::Scene& scene);

}  // namespace corpuscle::simulation
