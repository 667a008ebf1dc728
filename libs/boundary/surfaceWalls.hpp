// `surface`: a wall from a surface file (geometry/readSurface). Two kinds:
//
// fluid: inside   a vessel along x. Its surface is closed but for plane openings at the two ends of the box, through
//                 which it continues in its periodic images. Closed surfaces within it are obstacles.
// fluid: outside  obstacles in a box that is periodic along all axes; closed surfaces.
#pragma once
#include <memory>
#include <string>

#include "boundary/triangleSurface.hpp"
#include "boundary/wallShape.hpp"

namespace corpuscle::boundary {

struct SurfaceWalls : WallShape {
    std::string file;     // STL, OFF, PLY or VTP, relative to the case
    double scale = 1e-6;  // length of one unit of the file [m]
    std::string fluid = "inside";
    std::string at = "middle";  // middle: that of the surface's box lies in the middle of the box of the fluid
    static const Schema<SurfaceWalls>& schema();

    void prepare(const std::filesystem::path& caseDirectory) const override;
    std::vector<std::string> remarks() const override { return remarks_; }
    void check(const particles::Box& box, const Mark& mark, Problems& problems) const override;
    bool isAcross(int axis) const override { return isInside() && axis != 0; }
    bool isStraight() const override { return false; }
    Walls place(const particles::Box& box) const override;
    double volume(const particles::Box& box) const override;
    double volumeBehind(const particles::Box& box, const Vec3& depth) const override;
    // By cross-sections, each with the flow of a round tube of the same ratio of area and perimeter.
    Hydraulics hydraulics(const particles::Box& box) const override;

  private:
    bool isInside() const { return fluid == "inside"; }
    geometry::TriangleMesh in(const particles::Box& box) const;  // the mesh in the coordinates of the box

    mutable std::shared_ptr<const geometry::TriangleMesh> mesh_;  // read by prepare(), in metres
    mutable std::vector<std::string> remarks_;
};

}  // namespace corpuscle::boundary
