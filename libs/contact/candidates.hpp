// Which pieces of surfaces may touch: every node and triangle, and every two edges, of surfaces that are near each
// other, or of one surface, whose distance is at most `within`, a length of each pair.
//
// 1. Of two surfaces only what lies in the bounds of both, grown by `within`, is looked at.
// 2. There, triangles (or edges) of one surface are listed in a grid of cubes about as large as they are, and each
//    node (or edge) of the other asks the cubes around it. The grid is coarsened until its lists are short, so that
//    memory goes with the number of pieces whatever their sizes.
// 3. What is found is kept if its distance, as it stands, is at most `within`.
// The order of the result depends on the input alone: pairs of surfaces as they are given, then the numbers of nodes
// and edges, ascending.
//
// All surfaces are numbered through: node n of surface s is node start[s] + n of the array of all places x [m].
#pragma once
#include <span>
#include <vector>

#include "contact/surface.hpp"
#include "geometry/crossings.hpp"

namespace corpuscle::contact {

// A node and the pieces of one surface (triangles, and the edges and nodes of these) that are near it.
struct NodeRow {
    int node;                                    // among all nodes
    int own, target;                             // surfaces: of the node, of the pieces
    Vec3 offset;                                 // takes the node to its image beside the other surface [m]
    Vec3 slide;                                  // by which this image is faster than the node [m/s]
    std::array<int, 2> triangles, edges, nodes;  // begin and end in the lists of Candidates
};

struct EdgePair {
    int pair;           // of surfaces, in Candidates::pairs
    int first, second;  // edges of its first and its second surface
};

struct Candidates {
    std::vector<double> within;  // of each pair of surfaces [m]
    std::vector<geometry::ImagePair> pairs;
    std::vector<NodeRow> rows;
    std::vector<int> triangles, edges, nodes;  // numbers in the surface `target` of their row, ascending in each row
    std::vector<EdgePair> edgePairs;
};

// The first node of each surface, and behind the last their sum.
std::vector<int> firstNodes(std::span<const Surface* const> surfaces);

// pairs: of geometry::neighbours; (s, s, 0) is a surface and itself, of which pieces that share a node are left out.
// within: of each pair [m].
Candidates findCandidates(std::span<const Surface* const> surfaces, std::span<const Vec3> x,
                          std::span<const geometry::ImagePair> pairs, std::span<const double> within);

}  // namespace corpuscle::contact
