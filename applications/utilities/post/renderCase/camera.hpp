// The camera: its directions, perspective or parallel projection, and where a point appears in the picture.
//
// A point appears at (u, v) metres from the focus along the picture's right and up directions. In perspective these are
// metres at the distance of the focus, the middle of what is shown: a scale bar is valid only there.
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle {

struct ValueRange {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    void add(double value);  // non-finite values are ignored
    bool empty() const { return low > high; }
    double middle() const { return 0.5 * (low + high); }
    double length() const { return high - low; }
};

struct View {
    std::string name;
    Vec3 right, up;  // unit vectors of the picture
    bool perspective = false;
    int sliceAxis = 1;  // normal of the plane in which the fluid is shown, unless the user chooses another
    Vec3 ahead() const { return up.cross(right); }
};

// tilted: from the front, above and slightly upstream, in perspective; iso: a similar view without perspective; xz, xy,
// yz: along an axis.
const std::vector<View>& views();
// If there are walls across y, the tilted view is turned so that y points upwards.
View turnedForWalls(View view, const std::array<bool, 3>& periodic);

class Camera {
  public:
    // Looks at the middle of the points `shown`, from so far that all of them are visible.
    Camera(const View& view, const std::vector<Vec3>& shown);

    Vec3 focus() const { return focus_; }
    Vec3 eye() const { return focus_ - distance_ * view_.ahead(); }
    double distance() const { return distance_; }
    const View& view() const { return view_; }
    bool seesFromSide(const Vec3& place,
                      const Vec3& normal) const;         // whether the eye is on the side that the normal points to
    std::array<double, 2> project(const Vec3& x) const;  // u, v [m]
    const ValueRange& u() const { return u_; }           // range over the points shown
    const ValueRange& v() const { return v_; }

  private:
    View view_;
    Vec3 focus_ = Vec3::Zero();
    double distance_ = 1;
    ValueRange u_, v_;
};

}  // namespace corpuscle
