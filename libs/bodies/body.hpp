// A rigid body of the scene: a closed mesh filled with particles.
//
// Every rank knows every body whole and integrates its motion: the sums of forces are the same bits on all ranks. Its
// particles belong to whoever owns their place; where they stand follows from the body's state alone.
#pragma once
#include <memory>
#include <string>

#include "bodies/bodyMotion.hpp"
#include "geometry/distanceField.hpp"
#include "sph/kernel.hpp"

namespace corpuscle::bodies {

// Of a particle, in the body frame.
struct BodyParticle {
    Vec3 place, foot;  // itself, and the point of the surface nearest to it [m]
    double depth;      // below the surface as it counts in continuing the velocity (extrapolation.hpp), at least 0 [m]
};

struct Body {
    std::string name, type;  // type: entry of constant/bodies.yaml
    Solid solid;
    std::shared_ptr<const BodyMotion> behaviour;
    Vec3 axis = Vec3::UnitZ();  // of its shape, at t = 0
    int cell = 0;               // number of the cell that it is inside, 0: none
    double viscosity = 0;       // of the fluid around it [Pa s]
    RigidState state;
    RigidMotion acceleration;      // of the last step, where it is implicit (implicit/rigidUnknowns.hpp)
    Wrench wrench;                 // of the fluid, about the centre of mass, at the last evaluation
    std::int64_t firstMember = 0;  // number of its first particle: field `member` of the store
    std::vector<BodyParticle> particles;
    // Sum over pairs of the torque that fluid turning with the body as one piece would exert: T = D Omega, in the body
    // frame (sph/rigidGroups.hpp). What the fluid's particles around contribute is the opposite of what the body's own
    // do, since both together are even.
    Mat3 rotationalDrag = Mat3::Zero();
    geometry::DistanceField distance;  // from the surface, in the body frame

    // mesh: where the body stands at t = 0. reach: of the kernel; spacing of the particles [m].
    Body(std::string name, std::string type, const geometry::TriangleMesh& mesh, double density,
         std::shared_ptr<const BodyMotion> behaviour, double reach, double spacing);

    // Takes up its particles where they stand at t = 0, the images inside its surface; volume: of one of them.
    void fill(const std::vector<Vec3>& places, double particleVolume, const sph::Kernel& kernel, double reach);

    Vec3 inBody(const Vec3& fromCentre) const { return state.orientation.conjugate() * fromCentre; }
    // From t = 0 to now.
    Eigen::Quaterniond turned() const { return state.orientation * solid.startOrientation().conjugate(); }
    std::vector<Vec3> nodes() const;  // of its surface, now

    // What a restart needs beside the particles.
    static constexpr std::size_t stateLength = 25;
    std::vector<double> saved() const;
    void restore(const std::vector<double>& saved);

  private:
    void sumRotationalDrag(double particleVolume, const sph::Kernel& kernel, double reach);
};

}  // namespace corpuscle::bodies
