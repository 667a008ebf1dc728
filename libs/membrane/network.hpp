// Topology and reference state of one membrane: an oriented triangle mesh (normals outward) seen as a network.
//
// element  | made from                    | nodes                                  | number   | rest value
// Bond     | each edge                    | a < b                                  | its own  | length [m]
// Corner   | each corner of each triangle | apex, next, previous                   | triangle | angle [rad]
// Hinge    | each edge with two triangles | edge a < b, c left and d right of a->b | bond     | dihedral angle [rad]
// Bonds are ordered by (a, b); corners by triangle; hinges by bond. Rest values are those of the stress-free mesh.
// Corners, hinges and the bonds of rims are stored only after useCorners(), useHinges() and useRims(), which the terms
// that need them call.
//
// Rupture: an element is removed, until a rupture law reseals it, when a bond that is part of it breaks. A broken bond
// therefore removes: itself; its two triangles, which become a hole; the corners of which it is a side; and the hinges
// of both triangles (a broken triangle has no normal, and the rim of a hole bears no moment). The other bonds of a
// broken triangle stay. The lists below hold the remaining ("living") elements only, in order, so that loops over them
// need no test.
//
// Weakening: a membrane that tears gradually keeps, of its energy in tension, a share for each triangle (cohesive.hpp).
// A bond has the mean share of its triangles.
//
// Each rank that holds a cell holds its whole network, and every function here gives bitwise the same result on all of
// these ranks.
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
    // Throws Failure(invalidCase) where two triangles run in the same direction along an edge (inverted triangle, more
    // than two triangles at an edge), or where a triangle has no area or refers to a node that does not exist; the
    // message names them.
    Network(std::vector<Vec3> stressFree, std::vector<Index3> triangles);
    void useCorners();
    void useHinges();
    void useRims();

    // Living elements, for the loops of the laws.
    const std::vector<Bond>& bonds() const { return bonds_; }
    const std::vector<Corner>& corners() const { return corners_; }
    const std::vector<Hinge>& hinges() const { return hinges_; }
    const std::vector<Bond>& rimBonds() const { return rimBonds_; }  // those between a whole and a broken triangle
    const std::vector<int>& wholeTriangles() const { return wholeTriangles_; }  // numbers, ascending

    // The original network, including broken elements.
    std::size_t nodeCount() const { return stressFree_.size(); }
    const std::vector<Vec3>& stressFree() const { return stressFree_; }
    const std::vector<Index3>& triangles() const { return triangles_; }
    const std::vector<Bond>& allBonds() const { return allBonds_; }
    const std::vector<double>& restAreas() const { return restAreas_; }  // m^2, per triangle
    // Bonds of a triangle; bond k is the edge from corner k to corner k + 1.
    const Index3& triangleBonds(int triangle) const { return triangleBonds_[triangle]; }
    // Triangles left and right of a->b; -1: none (border of the mesh).
    const std::array<int, 2>& bondTriangles(int bond) const { return bondTriangles_[bond]; }
    double meanBondLength() const;  // at rest, m

    void breakBonds(std::span<const int> numbers);   // bonds already broken are ignored
    void resealBonds(std::span<const int> numbers);  // makes them living bonds again; the cell stays open
    // Sets the share of every triangle, broken or not; empty: all are 1.
    void weaken(std::vector<double> shares) { shares_ = std::move(shares); }
    bool isWeakened() const { return !shares_.empty(); }
    const std::vector<double>& shares() const { return shares_; }
    double shareOfTriangle(int triangle) const { return isWeakened() ? shares_[triangle] : 1; }
    double shareOfBond(int bond) const;
    bool isBroken(int triangle) const { return brokenTriangle_[triangle] != 0; }
    int brokenBonds() const { return static_cast<int>(allBonds_.size() - bonds_.size()); }
    int brokenTriangles() const { return static_cast<int>(triangles_.size() - wholeTriangles_.size()); }
    // Whether a triangle is broken, or was: what has left through a hole does not come back when it closes, so that
    // nothing may hold a cell that was open at its initial volume or area, or particles on the side where they started.
    bool wasOpen() const { return wasOpen_; }
    bool isOpen() const { return hasBorder_ || wasOpen_; }
    // Whether it was closed before it broke: with caps over its holes it encloses a volume.
    bool isTorn() const { return wasOpen_ && !hasBorder_; }
    long changes() const { return changes_; }  // of the lists, so far

    // Rims of the holes: closed loops of nodes along edges of whole triangles, in the orientation of these triangles.
    // Each loop begins at its bond of lowest number, so that the order is fixed. Borders of the original mesh are not
    // rims.
    std::vector<std::vector<int>> rims() const;
    // The connected sheets that the whole triangles form: a number for each node, from 0 in the order of the
    // nodes, -1 for nodes without whole triangles. Triangles that share a node belong to one sheet.
    std::vector<int> sheetOfNodes() const;
    double holeRestArea() const;                     // stress-free area of the broken triangles, m^2
    double holeArea(std::span<const Vec3> x) const;  // present area of fans about the rims' mean points, m^2

    // State for a checkpoint, one value per bond: 1 living, 0 broken, 2 resealed. restore() gives the same lists as in
    // the run that wrote it, and so bitwise the same results.
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
    bool hasBorder_ = false, wasOpen_ = false;
    long changes_ = 0;
    bool useCorners_ = false, useHinges_ = false, useRims_ = false;

    std::vector<char> alive_, brokenTriangle_;
    std::vector<Bond> bonds_;
    std::vector<Corner> corners_;
    std::vector<Hinge> hinges_;
    std::vector<Bond> rimBonds_;
    std::vector<int> wholeTriangles_;
    std::vector<double> shares_;
};

}  // namespace corpuscle::membrane
