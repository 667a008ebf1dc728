// Family of flows. A flow, read from constant/flow.yaml, is what drives the fluid: the velocities of walls (whose
// places come from boundary/wallShape.hpp) or of the periodic images of the box, and a body force. Walls and body force
// may change with time (drive.hpp).
//
// For a shear flow a case gives exactly one of Ca and shearRate; Ca uses the closed-form shear modulus of the
// membrane's bond law,
//     Ca = mu gammadot a/Gs.
// `inertia: physical` keeps the density as given; `inertia: {Re: 0.1}` sets it, rho = Re mu/(gammadot a^2), and it is
// reported as derived from Re.
#pragma once
#include <functional>
#include <optional>

#include "boundary/wallShape.hpp"
#include "sph/drive.hpp"

namespace corpuscle::sph {

// Quantities of the case on which a flow may depend.
struct FlowContext {
    particles::Box box;         // the box of the fluid, without the layers of wall particles
    double viscosity = 0;       // mu, outer [Pa s]
    double density = 0;         // as given in fluid.yaml [kg/m^3]
    double radius = 0;          // a of the first cell, else of the first rigid body [m]; 0: neither
    double shearModulus = 0;    // Gs [N/m]; 0: no cells
    bool layered = false;       // the viscosity differs from layer to layer between the walls
    double leastViscosity = 0;  // lowest viscosity of the layers; mu without layers [Pa s]
};

// A flow in numbers, SI, as computed from its keys and the context.
struct FlowState {
    double density = 0;  // [kg/m^3]
    bool densityFromRe = false;
    double shearRate = 0;  // gammadot; 0: none [1/s]
    int gradient = 2;      // axis along which a sheared flow changes
    double speed = 0;      // largest speed that walls or body force give, at any time [m/s]
    double length = 0;     // length over which velocity changes: gap, or wavelength/(2 pi) [m]
    double rate = 0;       // largest rate: shearRate, or speed/length [1/s]
    double transient = 0;  // time in which an unsteady flow changes by a factor e [s]; 0: fully developed at t = 0
    bool settles = false;  // true: the flow approaches a steady one; false: it decays
    Vec3 bodyForce = Vec3::Zero();                // per unit mass, for the factor 1 of the drive [m/s^2]
    Vec3 slide = Vec3::Zero();                    // of the next image along axis `gradient` [m/s]; 0: no sliding
    boundary::Walls walls;                        // with their present velocities
    std::vector<Vec3> wallVelocities;             // by number, for the factor 1; empty: walls at rest [m/s]
    std::function<Vec3(const Vec3&)> velocity;    // at t = 0, for the factor 1
    std::function<double(const Vec3&)> pressure;  // at t = 0 [Pa]

    bool varies = false;  // the cross-section between the walls varies along the flow
    double section = 0;   // mean cross-section of the fluid between walls along x [m^2]; 0: no such flow
    double confinement =
        0;  // rate at which the slowest velocity between these walls decays, over nu [1/m^2]; 0: not known
    std::optional<double> conductance;  // flow rate x nu/body force along x [m^4], of a uniform fluid; empty: not known

    std::shared_ptr<const Drive> drive;  // null: steady
    double factor = 1;                   // of the drive at the present time
    double flowRate = 0;  // which the body force follows, for the factor 1 [m^3/s]; 0: the body force is given

    bool slides() const { return !slide.isZero(0); }
    // Velocity without cells and bodies at the present factor [m/s]; that of the fluid at t = 0.
    Vec3 undisturbed(const Vec3& x) const { return factor * velocity(x); }
    // Largest body force at any time [m/s^2].
    double largestForce() const { return (drive ? drive->largest() : 1) * bodyForce.norm(); }
    // Takes over a drive: the factor at t = 0, and speed and rate at its largest. To be called at the end of `resolve`.
    void setDrive(const Choice<Drive>& choice);
    // Sets the velocities of walls to those at this factor.
    static void moveWalls(const std::vector<Vec3>& velocities, double factor, boundary::Walls& walls);
};

class Flow {
  public:
    static constexpr const char* familyName = "flow";
    virtual ~Flow() = default;
    // The shape of the walls, null if there are none: known before `resolve`, since filling needs it.
    virtual const boundary::WallShape* walls() const { return nullptr; }
    // How the drive changes with time, null if it cannot.
    virtual const Drive* drive() const { return nullptr; }
    // Whether the flow carries particles along all axes: a perfect lattice then does not last.
    virtual bool isThreeDimensional() const { return false; }
    // Whether images of the box slide: known before `resolve`.
    virtual bool slides() const { return false; }
    // Turns keys and context into numbers. Adds to `problems` what does not fit the rest of the case; mark: that of the
    // file.
    virtual FlowState resolve(const FlowContext& context, const Mark& mark, Problems& problems) const = 0;
};

// Whether the box is equally long along these axes ("xz"); if not, adds a problem of the key `type`.
bool equallyLong(const std::string& flow, const particles::Box& box, const std::string& axes, const Mark& mark,
                 Problems& problems);

// Adds problems of the key `walls` if walls bound the fluid along x, the direction of the flow; with `planes`, also if
// they are not two parallel planes.
void checkWalls(const boundary::WallShape& walls, bool planes, const Mark& mark, Problems& problems);

// inertia: {Re: 0.1}
struct InertiaSettings {
    double Re = 0;
    static const Schema<InertiaSettings>& schema();
};

}  // namespace corpuscle::sph
