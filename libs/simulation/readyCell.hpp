// Ready cells: `cell: NAME` in an entry of `cells` in system/mesh.yaml stands for a shape and the laws of a membrane.
//
//     cells: [{name: rbc, cell: whiteCell, edge: 0.5 um}]
//
// NAME.yaml has the keys `shape`, as in system/mesh.yaml, and `membrane`, an entry of constant/membranes.yaml. It is
// looked for, in this order, in constant/cells of the case, in the folders of the environment variable CORPUSCLE_CELLS
// (separated by ':'), in share/corpuscle/cells beside the folder of the programs, and in etc/cells of the sources from
// which the programs were built.
//
// The cell's membrane is then the entry NAME of constant/membranes.yaml. If the case has such an entry, its keys
// override those of the ready cell; a model of another type replaces the ready cell's model as a whole. No later code
// knows of ready cells: used.yaml contains the values.
#pragma once
#include "core/application.hpp"
#include "core/registry.hpp"
#include "geometry/shape.hpp"
#include "membrane/membraneSettings.hpp"

namespace corpuscle::simulation {

// The keys of NAME.yaml, for its JSON schema.
struct ReadyCell {
    Choice<geometry::Shape> shape;
    membrane::MembraneSettings membrane;
    static const Schema<ReadyCell>& schema();
};

// Replaces the names of ready cells by their values, in both dictionaries. membranes: an empty table if the case has no
// constant/membranes.yaml. Collective.
void insertReadyCells(const Application& app, Node& mesh, Node& membranes, Problems& problems);
// Whether an entry of `cells` in system/mesh.yaml names a ready cell.
bool namesReadyCells(const Node& mesh);

}  // namespace corpuscle::simulation
