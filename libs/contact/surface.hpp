// A triangulated surface for contact: its pieces (triangles, edges, nodes), the areas that they represent, and the
// coefficients by which pieces that overlap are counted once.
//
// Energies of contact are sums over pieces, weighted by areas of the reference state, so that contact does not become
// weaker where a surface is compressed:
//     area of a node = third of its triangles' area              sum: area of the surface
//     width of an edge = third of its triangles' area/length     sum of length x width: area of the surface
// Triangles, edges and nodes of a surface overlap: a point above an edge is equally near to the edge, to its two
// triangles, and perhaps to more. By inclusion and exclusion, with n_T(F) the number of triangles at F,
//     c_T = 1,   c_E = 1 - n_T(E),   c_V = 1 - n_T(V) - sum of c_E over the edges at V
// the sum of c_F over all pieces F within a distance r of a point is the Euler characteristic of the part of the
// surface that lies in the ball of radius r around it: 1 where this part is a disc, 2 where it is two of them.
//
// Open borders are allowed, and edges with any number of triangles. Nodes that belong to no triangle have no contact.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::contact {

using Edge = std::array<int, 2>;  // its nodes, the lower number first

class Surface {
  public:
    // reference: positions of the nodes in the reference state, from which areas and lengths are computed [m].
    Surface(std::span<const Vec3> reference, std::span<const Index3> triangles);

    std::size_t nodes() const { return nodeArea_.size(); }
    const std::vector<Index3>& triangles() const { return triangles_; }
    const std::vector<Edge>& edges() const { return edges_; }            // sorted
    const std::vector<Index3>& sides() const { return sides_; }          // side k of a triangle: its nodes k and k + 1
    const std::vector<double>& nodeArea() const { return nodeArea_; }    // m^2
    const std::vector<double>& edgeWidth() const { return edgeWidth_; }  // m
    const std::vector<int>& edgeCoefficient() const { return edgeCoefficient_; }  // c_E
    const std::vector<int>& nodeCoefficient() const { return nodeCoefficient_; }  // c_V
    double meanNodeArea() const { return meanNodeArea_; }                         // m^2, over nodes with triangles

  private:
    void findEdges();
    void setAreas(std::span<const Vec3> reference);
    void setCoefficients();

    std::vector<Index3> triangles_, sides_;
    std::vector<Edge> edges_;
    std::vector<double> nodeArea_, edgeWidth_;
    std::vector<int> edgeCoefficient_, nodeCoefficient_;
    double meanNodeArea_ = 0;
};

// Largest reach + thickness [m] of a law for contact of this surface with itself,
//     min(0.4 x shortest edge, 0.8 x least height of a triangle)
// It is below the distance of pieces of the undeformed mesh that have no node in common, which is about 0.47 of an edge
// in meshes with angles above 30 degrees. With a larger range, pieces that are merely neighbours in the mesh would
// count as contacts.
double largestReach(std::span<const Vec3> nodes, std::span<const Index3> triangles);

}  // namespace corpuscle::contact
