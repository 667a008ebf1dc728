// Strain of one triangle, constant over the triangle, relative to its stress-free shape.
//
// With the edges a = x1 - x0, b = x2 - x0, their products g = (a.a, a.b, b.b) [m^2], and G the products of the
// stress-free shape, the Cauchy-Green tensor in an orthonormal frame of the stress-free triangle (first axis along its
// edge a) is
//     C = 1 + e,   (e11, e12, e22) = L (g - G),   L = | p^2    0     0   |
//                                                    | p q    p r   0   |
//                                                    | q^2    2 q r r^2 |
//     p = 1/|A|,  q = -(A.B)/(2 A0 |A|),  r = |A|/(2 A0),       A, B the stress-free edges, A0 its area
// e is twice Green's strain; at rest it is exactly zero. Symmetric tensors of the plane are triples (11, 12, 22); a
// derivative with respect to e12 counts both off-diagonal entries.
#pragma once
#include <cmath>

#include "membrane/surface.hpp"

namespace corpuscle::membrane {

inline Vec3 edgeProducts(const Vec3& a, const Vec3& b) { return {a.squaredNorm(), a.dot(b), b.squaredNorm()}; }

struct RestTriangle {
    Index3 node;
    double area;     // A0, m^2
    Vec3 products;   // G, m^2
    double p, q, r;  // 1/m

    RestTriangle(std::span<const Vec3> stressFree, const Index3& nodes) : node(nodes) {
        const Vec3 a = stressFree[node[1]] - stressFree[node[0]], b = stressFree[node[2]] - stressFree[node[0]];
        area = 0.5 * a.cross(b).norm();
        products = edgeProducts(a, b);
        const double length = std::sqrt(products[0]);
        p = 1 / length;
        q = -products[1] / (2 * area * length);
        r = length / (2 * area);
    }

    Vec3 strain(const Vec3& g) const {  // e
        const Vec3 h = g - products;
        return {p * p * h[0], p * (q * h[0] + r * h[1]), q * q * h[0] + 2 * q * r * h[1] + r * r * h[2]};
    }
    Vec3 pullBack(const Vec3& slope) const {  // dW/dg = L^T dW/de
        return {p * (p * slope[0] + q * slope[1]) + q * q * slope[2], r * (p * slope[1] + 2 * q * slope[2]),
                r * r * slope[2]};
    }
    Mat3 strainByProducts() const {  // L
        return (Mat3() << p * p, 0, 0, p * q, p * r, 0, q * q, 2 * q * r, r * r).finished();
    }
};

}  // namespace corpuscle::membrane
