// Cells that are ready to be used: `cell: NAME` of a cell of system/mesh.yaml stands for its shape and the laws of its
// membrane.
//
//     cells: [{name: rbc, cell: whiteCell, edge: 0.5 um}]
//
// NAME.yaml has the keys `shape`, as in system/mesh.yaml, and `membrane`, an entry of constant/membranes.yaml. It is
// looked for, in this order, in constant/cells of the case, in the folders of the environment variable CORPUSCLE_CELLS
// (with ':' between them), in share/corpuscle/cells beside the folder of the programs, and in etc/cells of the sources
// that they were built from.
//
// The cell's membrane is then the entry NAME of constant/membranes.yaml. Where the case has one, its keys are laid over
// those of the ready cell; a model of another type takes the place of the ready cell's. From here on nothing knows of
// ready cells: used.yaml has the values.
#pragma once
#include "core/application.hpp"
#include "core/registry.hpp"
#include "geometry/shape.hpp"
#include "membrane/membraneSettings.hpp"

namespace corpuscle::simulation {

// The keys of such a file, for its JSON schema.
struct ReadyCell {
    Choice<geometry::Shape> shape;
    membrane::MembraneSettings membrane;
    static const Schema<ReadyCell>& schema();
};

// Puts the values in place of the names in both dictionaries. membranes: an empty table where the case has no such
// file. Collective.
void insertReadyCells(const Application& app, Node& mesh, Node& membranes, Problems& problems);
// Whether a cell of the mesh names a ready one.
bool namesReadyCells(const Node& mesh);

}  // namespace corpuscle::simulation
