// Rigid bodies in the implicit step (implicitStep.hpp): U and Omega of a body are unknowns in place of its particles'
// velocities.
//
//     u_j = U + Omega x r_j                                    P, for the body's particles, r_j from its centre of mass
//     F = sum_j f_j,   T = sum_j r_j x f_j                     P^T, of the forces f_j of the system on particles
//     m (c1 (U - U') - c2 A') = F + rho0 b V
//     I (c1 (Omega - Omega') - c2 alpha') = T - Omega* x I Omega*
//
// symbol     | meaning                                                                                    | unit
// U', Omega' | at the midpoint of the last step; A', alpha': rates between the last two midpoints         | m/s, 1/s
// m, I, V    | mass, inertia (of the body as it stands at x*) and volume of the solid, not of its         | kg, kg m^2,
//            | particles                                                                                  | m^3
// rho0 b     | uniform body force: a pressure gradient (bodies/bodies.hpp)                                | N/m^3
// Omega*     | extrapolated Omega                                                                         | 1/s
//
// Particles of bodies take part in D, D^T V and L like those of the fluid, pairs within a body included. L represents
// mu grad u, whereas the true stress is mu (grad u + grad u^T). Over fluid and body together the two have the same
// energy as long as the velocity is continuous and free of divergence, since then
// int grad u : grad u^T = int (div u)^2 = 0. The torque 2 mu V Omega, which the traction mu du/dn lacks
// (sph/rigidGroups.hpp adds it as D Omega), is therefore that of the pairs within the body, and lever arms are those of
// the particles.
//
// The surface lies somewhere between the particles of the body and those of the fluid. SurfaceLayer (surfaceLayer.hpp)
// adds what L lacks there; it is what this class contributes as a term of the system.
//
// In a field (four numbers per entry of the shared particles) the unknowns of the bodies follow the particles: U, 0,
// Omega, 0 for each body. In a field of velocities every rank has the unknowns of all bodies, and particles of bodies
// have their velocities. In a field of forces every rank has its part of the force on each body, and particles of
// bodies have none. The scalar product is therefore the sum over all numbers that a rank counts (Copies of
// conjugateGradients.hpp) and over the ranks, and only the preconditioner needs a reduction. Held and driven bodies
// keep their velocity: their rows are removed, like those of walls.
#pragma once
#include <Eigen/Cholesky>

#include "coupling/scene.hpp"
#include "implicit/surfaceLayer.hpp"
#include "implicit/term.hpp"
#include "particles/vectorField.hpp"
#include "sph/budget.hpp"
#include "sph/operators.hpp"

namespace corpuscle::implicit {

template <class Real>
class RigidUnknowns final : public Term<Real> {
  public:
    using typename Term<Real>::Field;
    using typename Term<Real>::Forces;

    // operators: built at x* before prepare. onGrid: the preconditioner has a part that acts on particles of bodies
    // (coarseGrid.hpp).
    RigidUnknowns(coupling::Scene& scene, sph::Operators<Real>& operators, bool onGrid)
        : scene_(scene), operators_(operators), onGrid_(onGrid), layer_(scene, operators) {}

    std::size_t length() const { return perBody * bodies().size(); }  // numbers behind the particles

    void moveVelocities(double seconds);  // advances those of bodies by their accelerations
    void stopAccelerating();              // sets the accelerations of bodies to zero
    // Moves bodies and their particles to `seconds` after the beginning of the step; back to the beginning.
    void depart(double seconds);
    void takeBack();

    // As a term: the forces of the surface layer. Those on bodies are added with the rows below.
    void prepare(const Reach& reach) override;
    void addForces(const Field& u, Forces& forces) override { addLayer(u, sph::FieldOf::velocities, forces); }
    void addProduct(const Field& u, Forces& forces) override { addLayer(u, sph::FieldOf::changes, forces); }
    double slidingPower(const Field& v, const std::vector<double>& divergence, const Field& w) override;
    double diagonal(std::size_t i) const override { return layer_.diagonal(i); }

    // First guess: the velocity extrapolated over h [s].
    void extrapolate(double h, Field& u) const;
    // Largest difference of a free body between the velocity u and the extrapolated one: (|dU| + a |dOmega|)/a, with a
    // the radius of the sphere of its volume [1/s].
    double largestDifference(double h, const Field& u) const;
    bool areSomeFree() const;
    // Rows of bodies in A u, and in the residual of u.
    void putProduct(double c1, const Field& u, const particles::RealArray& force, Field& product) const;
    void putResidual(double c1, double c2, const Field& u, const particles::RealArray& force, Field& residual);
    // Rows of bodies: P^T of forces alone.
    void putForces(const particles::RealArray& force, Field& rows) const;

    // Preconditioner: z = Pi (D^-1 + G) Pi^T r. Pi makes the velocities of a body's particles rigid by least squares,
    // and G is the part on the grid. D of a body is its inertia and the part of its particles' diagonal that is due to
    // pairs with particles outside bodies. diagonal(i): that of particle i without its inertia. Sets `inverse` to 0 at
    // particles of bodies. Collective.
    template <class Diagonal>
    void factorise(double c1, Diagonal&& diagonal, Field& inverse) {
        std::vector<Matrix6> blocks = continuationBlocks();
        for (std::size_t k = 0; k < members().size(); ++k) {
            const auto i = static_cast<std::size_t>(members()[k].particle);
            blocks[static_cast<std::size_t>(members()[k].group)] +=
                outward_[k] * diagonal(i) * square(members()[k].arm);
            inverse[i] = Real(0);
        }
        invert(c1, blocks);
    }
    const Field& distribute(const Field& r);  // Pi^T r
    void project(Field& z);                   // completes z for the last r. Collective

    // At the end of a step with the velocity u: motion and places of bodies, force and torque on them. Collective.
    void arrive(double dt, double h, const Field& u);
    // Force and torque of the fluid on bodies, from the forces at the computed velocity. Collective.
    void findWrenches(const particles::RealArray& force);

    // Adds what bodies contribute to the budget at the computed velocity u, after findWrenches. Returns the power of
    // the continuation (surfaceLayer.hpp) on them. This rank's part.
    double addRates(double c1, double c2, const Field& u, sph::Budget::Values& rates) const;

    // For a flow w whose images slide: sets the velocity of each body to w at its centre, and those of its particles.
    template <class W>
    void setMotions(W&& w, Field& u) const {
        for (std::size_t b = 0; b < bodies().size(); ++b) put(u, b, w(bodies()[b].state.centre), Vec3::Zero());
        spread(u, sph::FieldOf::velocities);
    }
    // Power, in the flow u, of the reaction of the surface layer on bodies as last computed; this rank's part [W].
    double reactionPower(const Field& u) const;
    // Power of these forces on particles of bodies due to the slide alone: that of particles in another image than the
    // centre of their body; this rank's part [W].
    double powerOfSlides(const particles::RealArray& force) const;

    bool isMember(std::size_t i) const { return scene_.store().kindOf(i) == particles::Kind::body; }

  private:
    using Matrix6 = Eigen::Matrix<double, 6, 6>;
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    static constexpr std::size_t width = 4, perBody = 8;

    std::vector<bodies::Body>& bodies() const { return scene_.bodies->all(); }
    const std::vector<sph::RigidGroups::Member>& members() const { return scene_.bodies->groups().members; }
    std::size_t behind() const { return width * operators_.shared().entries(); }
    void findOthers();
    bool isRoot() const { return scene_.system->decomposition().rank() == 0; }
    bool isFree(std::size_t b) const { return bodies()[b].behaviour->yields(); }

    static Matrix6 square(const Vec3& arm);  // P^T P of one particle
    std::vector<Matrix6> continuationBlocks() const;
    void invert(double c1, std::vector<Matrix6>& blocks);
    sph::RigidMotion motion(const Field& u, std::size_t body) const;
    sph::RigidMotion extrapolated(double h, std::size_t body) const;
    void put(Field& f, std::size_t body, const Vec3& linear, const Vec3& angular) const;
    void addLayer(const Field& u, sph::FieldOf of, Forces& forces);
    void spread(Field& u, sph::FieldOf of) const;  // P
    template <class Row>
    void putRows(const particles::RealArray& force, Field& rows, Row&& row) const;
    std::vector<sph::Wrench> gather(const particles::RealArray& force) const;
    void addUp(std::vector<sph::Wrench>& wrenches) const;

    coupling::Scene& scene_;
    sph::Operators<Real>& operators_;
    bool onGrid_;
    struct OtherMember {
        std::size_t entry, group;
        Vec3 arm;
        double periods;
    };
    std::vector<OtherMember> others_;        // particles of bodies owned by other ranks
    std::vector<double> periods_;            // of members: periods from their place on the body to the particle
    std::vector<bodies::RigidState> saved_;  // at the beginning of the step
    SurfaceLayer<Real> layer_;               // beside the surfaces
    std::vector<double> outward_;   // for each member, share of its pairs, by l_ij, with particles outside bodies
    std::vector<Vec3> gyroscopic_;  // gyroscopic torque on each body in the system, on the root
    // Of the continuation, this rank's part; of the last r, of all ranks.
    std::vector<sph::Wrench> reaction_, residual_;
    std::vector<Eigen::LLT<Matrix6>> inertia_, particles_;  // D, and P^T P
    Field shared_;
};

extern template class RigidUnknowns<double>;
extern template class RigidUnknowns<float>;

}  // namespace corpuscle::implicit
