// Pieces of surfaces that may touch: every pair of a node and a triangle, and of two edges, whose distance is at most
// `within`, a length given for each pair of surfaces. A pair consists of two surfaces, or of a surface and itself.
//
// 1. Of two surfaces, only the pieces in the intersection of their bounds, grown by `within`, are considered.
// 2. The triangles (or edges) of one surface there are listed in a grid of cubes about as large as they are, and each
//    node (or edge) of the other surface searches the cubes around it. The grid is coarsened until its lists are short,
//    so that memory is proportional to the number of pieces, whatever their sizes.
// 3. Pieces found in this way are kept if their present distance is at most `within`.
// The order of the result depends on the input alone: pairs of surfaces as given, then numbers of nodes and edges,
// ascending.
//
// Nodes are numbered surface by surface: node n of surface s is node start[s] + n of the array x of all positions [m].
#pragma once
#include <span>
#include <vector>

#include "contact/surface.hpp"
#include "geometry/crossings.hpp"

namespace corpuscle::contact {

// A node and the pieces of one surface (triangles, and the edges and nodes of these triangles) that are near it.
struct NodeRow {
    int node;                                    // its number among all nodes
    int own, target;                             // surface of the node, surface of the pieces
    Vec3 offset;                                 // shift from the node to its image beside the other surface [m]
    Vec3 slide;                                  // velocity of this image less that of the node [m/s]
    std::array<int, 2> triangles, edges, nodes;  // begin and end in the lists of Candidates
};

struct EdgePair {
    int pair;           // index of the pair of surfaces in Candidates::pairs
    int first, second;  // edge of the first surface, edge of the second
};

struct Candidates {
    std::vector<double> within;  // of each pair of surfaces [m]
    std::vector<geometry::ImagePair> pairs;
    std::vector<NodeRow> rows;
    std::vector<int> triangles, edges, nodes;  // numbers in the surface `target` of the row, ascending in each row
    std::vector<EdgePair> edgePairs;
};

// Number of the first node of each surface, and at the end the number of all nodes.
std::vector<int> firstNodes(std::span<const Surface* const> surfaces);

// pairs: from geometry::neighbours; (s, s, 0) pairs a surface with itself, where pieces that share a node are left out.
// within: for each pair [m].
Candidates findCandidates(std::span<const Surface* const> surfaces, std::span<const Vec3> x,
                          std::span<const geometry::ImagePair> pairs, std::span<const double> within);

}  // namespace corpuscle::contact
