// Family of laws of an elastic sheet on triangles of constant strain: the energy W(e) per stress-free area. e = C - 1
// is twice Green's strain, a triple (11, 12, 22) in a frame of the stress-free triangle (restTriangle.hpp).
//
// A law is a struct that derives from TriangleLawOf<itself> and has its coefficients, schema(), constants(), and
//     energy(e) [J/m^2], slope(e) = dW/de [N/m], curvature(e) = d2W/de2 [N/m].
// A law of the invariants alone derives from InvariantLawOf<itself> (invariantLaw.hpp) and gives W(I1, I2) instead.
// Everything else (loop, moduli, tensions for output) follows; neoHookean.hpp is the pattern.
//
// Moduli at small strain eps, e = 2 eps, with M = W''(0):  Gs = M_1111 - 2 M_1122 + M_2222, averaged with the other
// shear modulus, M_1212;  Ks = M_1111 + 2 M_1122 + M_2222. Homogeneous strain is exact on any mesh, so that the sheet
// has the moduli of the law.
#pragma once
#include <memory>
#include <string>

#include "membrane/surfaceModuli.hpp"
#include "membrane/triangleTerm.hpp"

namespace corpuscle::membrane {

class TriangleLaw {
  public:
    static constexpr const char* familyName = "triangle law";
    virtual ~TriangleLaw() = default;
    virtual std::unique_ptr<Term> makeTerm(const Network& network) const = 0;
    virtual double energy(const Vec3& e) const = 0;
    virtual Vec3 slope(const Vec3& e) const = 0;
    virtual Mat3 curvature(const Vec3& e) const = 0;
    virtual std::string constants() const = 0;  // as text for the user

    SurfaceModuli moduli() const {
        const Mat3 m = curvature(Vec3::Zero());
        const double trace = m(0, 0) + m(2, 2), cross = 2 * m(0, 2);
        return {0.5 * (trace - cross + m(1, 1)), trace + cross};
    }
};

template <class Law>
class TriangleLawOf : public TriangleLaw {
  public:
    std::unique_ptr<Term> makeTerm(const Network& network) const override {
        return std::make_unique<TriangleTerm<Law>>(network, static_cast<const Law&>(*this));
    }
};

}  // namespace corpuscle::membrane
