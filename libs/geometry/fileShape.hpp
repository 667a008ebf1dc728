// Closed surface from a file, moved so that the centroid of its volume lies at the origin; z of the file stays the
// axis.
//
// symbol | meaning                                                       | unit | default
// file   | STL, OFF, PLY or VTP, relative to the case                    |      | required
// scale  | length of one unit of the file                                | m    | 1 um
// A longest side below 50 nm or above 1 cm is rejected: the file's unit is then not what `scale` says.
//
// F is the signed distance; the surface is the file's own triangulation, so that its nodes, after remeshing, lie on its
// triangles.
#pragma once
#include <memory>
#include <string>

#include "core/registry.hpp"
#include "geometry/insideTest.hpp"
#include "geometry/shape.hpp"
#include "geometry/surfaceTree.hpp"

namespace corpuscle::geometry {

struct FileShape : Shape {
    std::string file;
    double scale = 1e-6;  // m

    static const Schema<FileShape>& schema();
    void prepare(const std::filesystem::path& caseDirectory) const override;
    double implicit(const Vec3& x) const override;  // m
    Vec3 gradient(const Vec3& x) const override;
    Vec3 project(const Vec3& x) const override;
    Eigen::AlignedBox3d box() const override;
    double radius() const override;
    double area() const override { return surface().mesh.area(); }
    double volume() const override { return surface().mesh.volume(); }
    const TriangleMesh* triangulation() const override { return &surface().mesh; }
    std::vector<std::string> remarks() const override { return surface().remarks; }
    std::string cureForSize(double least, double most) const override;

  private:
    struct Surface {
        TriangleMesh mesh;
        SurfaceTree tree;
        InsideTest test;
        double size;  // longest side [units of the file]
        std::vector<std::string> remarks;
        Surface(const TriangleMesh& m, double s, std::vector<std::string> r)
            : mesh(m), tree(m), test(m), size(s), remarks(std::move(r)) {}
    };
    const Surface& surface() const;
    mutable std::shared_ptr<const Surface> surface_;  // read by prepare()
};

}  // namespace corpuscle::geometry
