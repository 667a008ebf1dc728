// Topology and reference state of one membrane: an oriented triangle mesh (normals outward) seen as a network.
//
// element  | made from                    | nodes                                  | number   | rest value
// Bond     | each edge                    | a < b                                  | its own  | length [m]
// Corner   | each corner of each triangle | apex, next, previous                   | triangle | angle [rad]
// Hinge    | each edge with two triangles | edge a < b, c left and d right of a->b | bond     | dihedral angle [rad]
// Bonds are ordered by (a, b); corners by triangle; hinges by bond. Rest values are those of the stress-free mesh.
// Corners and hinges are stored only after useCorners() and useHinges(), which the terms that need them call.
//
// Rupture: an element ends when a bond that it is made of breaks, and for good. A broken bond therefore takes with
// it: itself; its two triangles, which become a hole; the corners that it is a side of; and the hinges of both
// triangles (a triangle that is gone has no normal, and the rim of a hole bears no moment). The other bonds of a
// broken triangle go on. The lists below hold the living elements only, in order, so that loops over them test
// nothing.
//
// The network of one cell is held whole by each rank that the cell touches, and every function here gives the same
// bits on all.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::membrane {

template <int N>
struct Element {
    std::array<int, N> node;
    int number;
    double rest;
};
using Bond = Element<2>;
using Corner = Element<3>;
using Hinge = Element<4>;

class Network {
  public:
    // Throws Failure(invalidCase) where two triangles run the same way along an edge (turned triangle, more than two at
    // an edge), or where a triangle has no area or names no node; the message says which.
    Network(std::vector<Vec3> stressFree, std::vector<Index3> triangles);
    void useCorners();
    void useHinges();

    // Living elements, for the loops of the laws.
    const std::vector<Bond>& bonds() const { return bonds_; }
    const std::vector<Corner>& corners() const { return corners_; }
    const std::vector<Hinge>& hinges() const { return hinges_; }
    const std::vector<int>& wholeTriangles() const { return wholeTriangles_; }  // numbers, ascending

    // The network as made, broken elements included.
    std::size_t nodeCount() const { return stressFree_.size(); }
    const std::vector<Vec3>& stressFree() const { return stressFree_; }
    const std::vector<Index3>& triangles() const { return triangles_; }
    const std::vector<Bond>& allBonds() const { return allBonds_; }
    const std::vector<double>& restAreas() const { return restAreas_; }  // m^2, per triangle
    // Edge k goes from corner k to k + 1.
    const Index3& triangleBonds(int triangle) const { return triangleBonds_[triangle]; }
    // Left and right of a->b; -1: the mesh's border.
    const std::array<int, 2>& bondTriangles(int bond) const { return bondTriangles_[bond]; }
    double meanBondLength() const;  // at rest, m

    void breakBonds(std::span<const int> numbers);  // those broken already are passed over
    bool isBroken(int triangle) const { return brokenTriangle_[triangle] != 0; }
    int brokenBonds() const { return static_cast<int>(allBonds_.size() - bonds_.size()); }
    int brokenTriangles() const { return static_cast<int>(triangles_.size() - wholeTriangles_.size()); }
    bool isOpen() const { return hasBorder_ || brokenTriangles() > 0; }

    // Rims of the holes: closed loops of nodes along the whole triangles' edges, in those triangles' sense. Each loop
    // begins at its lowest bond, so their order is fixed. Borders of the mesh as made are not rims.
    std::vector<std::vector<int>> rims() const;
    double holeRestArea() const;                     // stress-free area of the broken triangles, m^2
    double holeArea(std::span<const Vec3> x) const;  // fans about the rims' mean points now, m^2

    // State for a checkpoint, one per bond; restore() gives the same lists, and so the same bits, as the run that
    // wrote it.
    const std::vector<char>& aliveBonds() const { return alive_; }
    void restore(std::vector<char> alive);

  private:
    void findBonds();
    void compact();
    int across(int triangle, int edge) const;

    std::vector<Vec3> stressFree_;
    std::vector<Index3> triangles_;
    std::vector<double> restAreas_;
    std::vector<Bond> allBonds_;
    std::vector<Index3> triangleBonds_;
    std::vector<std::array<int, 2>> bondTriangles_;
    bool hasBorder_ = false;
    bool useCorners_ = false, useHinges_ = false;

    std::vector<char> alive_, brokenTriangle_;
    std::vector<Bond> bonds_;
    std::vector<Corner> corners_;
    std::vector<Hinge> hinges_;
    std::vector<int> wholeTriangles_;
};

}  // namespace corpuscle::membrane
