// Area and volume of triangles and fans. A volume is the signed sum of tetrahedra with their apex at a reference point.
// For a closed surface with outward normals it does not depend on that point; take one near the surface to limit
// rounding errors.
#pragma once
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::membrane {

// Area times unit normal, m^2.
inline Vec3 areaVector(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * (b - a).cross(c - a); }
inline Vec3 areaVector(std::span<const Vec3> x, const Index3& t) { return areaVector(x[t[0]], x[t[1]], x[t[2]]); }

inline double tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& origin) {
    return (a - origin).dot((b - origin).cross(c - origin)) / 6;
}

// Volume of a closed surface, m^3.
inline double enclosedVolume(std::span<const Vec3> x, std::span<const Index3> triangles) {
    double sum = 0;
    for (const Index3& t : triangles) {
        sum += tetrahedron(x[t[0]], x[t[1]], x[t[2]], x.front());
    }
    return sum;
}

// Derivative of the volume with respect to the node positions: a third of the area vectors of a node's triangles. They
// are computed from edges, so that the distance to the origin costs no accuracy.
inline std::vector<Vec3> volumeGradient(std::span<const Vec3> x, std::span<const Index3> triangles) {
    std::vector<Vec3> sum(x.size(), Vec3::Zero());
    for (const Index3& t : triangles) {
        const Vec3 third = areaVector(x, t) / 3;
        for (const int node : t) {
            sum[node] += third;
        }
    }
    return sum;
}

inline Vec3 meanPoint(std::span<const Vec3> x, std::span<const int> loop) {
    Vec3 mean = Vec3::Zero();
    for (const int node : loop) {
        mean += x[node];
    }
    return mean / static_cast<double>(loop.size());
}

inline double loopLength(std::span<const Vec3> x, std::span<const int> loop) {
    double length = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        length += (x[loop[(k + 1) % loop.size()]] - x[loop[k]]).norm();
    }
    return length;
}

// Area of the triangles between the mean point of a loop and its edges.
inline double fanArea(std::span<const Vec3> x, std::span<const int> loop) {
    const Vec3 mean = meanPoint(x, loop);
    double area = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        area += areaVector(mean, x[loop[k]], x[loop[(k + 1) % loop.size()]]).norm();
    }
    return area;
}

// Volume that this fan adds, if the loop has the orientation of the surface that the fan closes.
inline double fanVolume(std::span<const Vec3> x, std::span<const int> loop, const Vec3& origin) {
    const Vec3 mean = meanPoint(x, loop);
    double volume = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        volume += tetrahedron(mean, x[loop[(k + 1) % loop.size()]], x[loop[k]], origin);
    }
    return volume;
}

}  // namespace corpuscle::membrane
