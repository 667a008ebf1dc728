// Whether cells, rigid bodies and walls are clear of each other at the start. A body may lie inside a cell.
//
// what                                            | how it is found
// surfaces that touch or cross, images included   | triangles of neighbours (geometry/crossings.hpp)
// one surface inside another                      | a node of it, by the inside test
// surfaces closer than 0.1 spacings               | nodes against the triangles of neighbours: no particle between them
//                                                 | could stay on its side
// a surface across a wall, or longer than a periodic box | its bounds
// Particles are filled in and runs begin from what passes; during a run StateCheck looks at the same (stateCheck.hpp).
#pragma once
#include <functional>

#include "core/error.hpp"
#include "coupling/scene.hpp"
#include "geometry/crossings.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

struct Placed {
    std::string name;             // "cell 'a'"
    std::string shapeKey, place;  // "cells[0].shape"; of what says where it is, "cells[0].centre"
    bool isBody;
    geometry::SurfaceView surface;
};

// Everything that is wrong, with the keys of system/mesh.yaml; empty: nothing. isMine(i, j): whether to look at these
// two, or at one with itself and the walls.
std::vector<Problem> misplaced(const Case& input, const std::vector<Placed>& all,
                               const std::function<bool(std::size_t, std::size_t)>& isMine = {});

// All cells and bodies of a case in its order, from their meshes, which must stay where they are.
std::vector<Placed> placedOf(const Case& input, const std::vector<geometry::TriangleMesh>& cells,
                             const std::vector<geometry::TriangleMesh>& bodies);

// Throws CaseError, on all ranks, where cells, bodies or walls of a scene at t = 0 are not clear of each other. Each
// rank looks at what it holds. Collective.
void requireClear(const Case& input, const coupling::Scene& scene);

}  // namespace corpuscle::simulation
