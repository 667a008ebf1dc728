// Family of flows: what drives the fluid, from constant/flow.yaml: how fast walls move (where they stand is up to
// boundary/wallShape.hpp) or the images of the box, and a body force.
//
// A case gives exactly one of Ca and shearRate; Ca uses the closed-form shear modulus of the membrane's bond law,
//     Ca = mu gammadot a/Gs.
// inertia: physical keeps the density as given; {Re: 0.1} sets it, rho = Re mu/(gammadot a^2), and is reported as such.
#pragma once
#include <functional>
#include <optional>

#include "boundary/wallShape.hpp"

namespace corpuscle::sph {

// What a flow may refer to.
struct FlowContext {
    particles::Box box;         // of the fluid, walls' layers not included
    double viscosity = 0;       // mu, outer [Pa s]
    double density = 0;         // as given in fluid.yaml [kg/m^3]
    double radius = 0;          // a of the first cell, else of the first rigid body [m]; 0: neither
    double shearModulus = 0;    // Gs [N/m]; 0: no cells
    bool layered = false;       // the viscosity differs from layer to layer between the walls
    double leastViscosity = 0;  // of the layers; mu where there are none [Pa s]
};

// What follows from it, SI.
struct FlowState {
    double density = 0;  // [kg/m^3]
    bool densityFromRe = false;
    double shearRate = 0;  // gammadot; 0: none [1/s]
    int gradient = 2;      // axis along which a sheared flow changes
    double speed = 0;      // largest speed that walls or body force give [m/s]
    double length = 0;     // of the gradient of velocity: gap, or wavelength/(2 pi) [m]
    double rate = 0;       // shearRate, or speed/length [1/s]
    double transient = 0;  // time in which the flow changes by a factor e by itself [s]; 0: it is developed at t = 0
    bool settles = false;  // towards a steady flow; else it decays
    Vec3 bodyForce = Vec3::Zero();                // [m/s^2]
    Vec3 slide = Vec3::Zero();                    // of images across the axis `gradient` [m/s]; 0: they do not
    boundary::Walls walls;                        // as they move
    std::function<Vec3(const Vec3&)> velocity;    // at t = 0
    std::function<double(const Vec3&)> pressure;  // at t = 0 [Pa]

    bool slides() const { return !slide.isZero(0); }
};

class Flow {
  public:
    static constexpr const char* familyName = "flow";
    virtual ~Flow() = default;
    // Where its walls are, null for none: known before anything else, since filling needs it.
    virtual const boundary::WallShape* walls() const { return nullptr; }
    // Whether it carries particles along all axes: a perfect lattice then does not last.
    virtual bool isThreeDimensional() const { return false; }
    // Whether images of the box slide: known before anything else.
    virtual bool slides() const { return false; }
    // Problems of the combination with the rest of the case (mark: of the file) go to `problems`.
    virtual FlowState resolve(const FlowContext& context, const Mark& mark, Problems& problems) const = 0;
};

// Whether the box is equally long along these axes ("xz"); a problem of the key `type` where it is not.
bool equallyLong(const std::string& flow, const particles::Box& box, const std::string& axes, const Mark& mark,
                 Problems& problems);

// Problems of the key `walls` where walls end the fluid along x, the direction of the flow; with `planes`, also where
// they are not two parallel planes.
void checkWalls(const boundary::WallShape& walls, bool planes, const Mark& mark, Problems& problems);

// inertia: {Re: 0.1}
struct InertiaSettings {
    double Re = 0;
    static const Schema<InertiaSettings>& schema();
};

}  // namespace corpuscle::sph
