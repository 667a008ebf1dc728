// A rigid body of the scene: a closed mesh filled with particles.
//
// Every rank stores all bodies completely and integrates their motion; the sums of forces are bitwise identical on all
// ranks. Each particle of a body is owned by the rank of its position, which follows from the state of the body alone.
#pragma once
#include <memory>
#include <string>

#include "bodies/bodyMotion.hpp"
#include "geometry/distanceField.hpp"
#include "sph/kernel.hpp"

namespace corpuscle::bodies {

// A particle of a body, in the body frame.
struct BodyParticle {
    Vec3 place, foot;  // its position, and the nearest point of the surface [m]
    double depth;      // effective depth below the surface, to continue the velocity (extrapolation.hpp), >= 0 [m]
};

struct Body {
    std::string name, type;  // type: name of an entry of constant/bodies.yaml
    Solid solid;
    std::shared_ptr<const BodyMotion> behaviour;
    Vec3 axis = Vec3::UnitZ();  // axis of its shape at t = 0
    int cell = 0;               // number of the cell that it is inside; 0: none
    double viscosity = 0;       // of the fluid around it [Pa s]
    RigidState state;
    RigidMotion acceleration;      // in the last step; implicit step only (implicit/rigidUnknowns.hpp)
    Wrench wrench;                 // of the fluid, about the centre of mass, at the last evaluation
    std::int64_t firstMember = 0;  // number of its first particle, as in the field `member` of the store
    std::vector<BodyParticle> particles;
    // D of sph/rigidGroups.hpp, in the body frame: T = D Omega is the sum over pairs of the torque that fluid rotating
    // rigidly with the body would exert. It is computed from the body's own particles: their contribution is the
    // opposite of that of the fluid's particles, since both together surround each particle evenly.
    Mat3 rotationalDrag = Mat3::Zero();
    geometry::DistanceField distance;  // from the surface, in the body frame

    // mesh: the surface at its position at t = 0. reach: support of the kernel [m]. spacing: of the particles [m].
    Body(std::string name, std::string type, const geometry::TriangleMesh& mesh, double density,
         std::shared_ptr<const BodyMotion> behaviour, double reach, double spacing);

    // Sets its particles. places: positions at t = 0, at the images that are inside the surface [m]; particleVolume: of
    // one particle [m^3]; reach: support of the kernel [m].
    void fill(const std::vector<Vec3>& places, double particleVolume, const sph::Kernel& kernel, double reach);

    Vec3 inBody(const Vec3& fromCentre) const { return state.orientation.conjugate() * fromCentre; }
    // Rotation from t = 0 to now.
    Eigen::Quaterniond turned() const { return state.orientation * solid.startOrientation().conjugate(); }
    std::vector<Vec3> nodes() const;  // present positions of the nodes of its surface

    // State of the body that a restart needs in addition to the particles.
    static constexpr std::size_t stateLength = 25;
    std::vector<double> saved() const;
    void restore(const std::vector<double>& saved);

  private:
    void sumRotationalDrag(double particleVolume, const sph::Kernel& kernel, double reach);
};

}  // namespace corpuscle::bodies
