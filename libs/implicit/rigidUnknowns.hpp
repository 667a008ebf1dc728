// Rigid bodies in the implicit step (implicitStep.hpp): U and Omega of a body are unknowns in place of its particles'
// velocities.
//
//     u_j = U + Omega x r_j                                    P, for the body's particles, r_j from its centre of mass
//     F = sum_j f_j,   T = sum_j r_j x f_j                     P^T, of what the system has as forces on particles
//     m (c1 (U - U') - c2 A') = F + rho0 b V
//     I (c1 (Omega - Omega') - c2 alpha') = T - Omega* x I Omega*
//
// symbol        | meaning                                                                                       | unit
// U', Omega'    | of the middle of the last step; A', alpha': rates between the middles of the last two           |
//               | m/s, 1/s
// m, I, V       | mass, inertia where the body stands at x*, and volume: of the solid, not of its particles       | kg,
//               | kg m^2, m^3
// rho0 b        | uniform body force: a pressure gradient (bodies/bodies.hpp)                                     |
//               | N/m^3
// Omega*        | extrapolated                                                                                   | 1/s
//
// Particles of bodies are in D, D^T V and L as those of the fluid, pairs within a body included. L carries mu grad u
// where the true stress is mu (grad u + grad u^T). Over fluid and body together both have the same energy as long as
// the velocity is continuous and without divergence, since then int grad u : grad u^T = int (div u)^2 = 0. So the
// torque 2 mu V Omega, which the traction mu du/dn lacks (sph/rigidGroups.hpp adds it as D Omega), is that of the pairs
// within the body, and arms are those of the particles.
//
// The surface lies somewhere between its particles and those of the fluid: what L lacks there is SurfaceLayer
// (surfaceLayer.hpp), and this term of the system is it.
//
// In a field (four numbers an entry of the shared particles) a body's unknowns stand behind the particles: U, 0, Omega,
// 0. Of a velocity every rank has all of them, and the particles of bodies have theirs; of forces every rank has its
// part, and particles of bodies have none. So the sum over all numbers that a rank counts (Copies of
// conjugateGradients.hpp) and over the ranks is the scalar product, and nothing but the preconditioner needs a
// reduction. Held and driven bodies keep their velocity: their rows are taken out, as those of walls.
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

    std::size_t length() const { return perBody * bodies().size(); }  // what stands behind the particles

    void moveVelocities(double seconds);  // along their accelerations
    // Places of bodies and of their particles: `seconds` on from the beginning of the step; back to it.
    void depart(double seconds);
    void takeBack();

    // As a term: what the surfaces add. Bodies get theirs in the next rows.
    void prepare(const Reach& reach) override;
    void addForces(const Field& u, Forces& forces) override { addLayer(u, sph::FieldOf::velocities, forces); }
    void addProduct(const Field& u, Forces& forces) override { addLayer(u, sph::FieldOf::changes, forces); }
    double slidingPower(const Field& v, const std::vector<double>& divergence, const Field& w) override;
    double diagonal(std::size_t i) const override { return layer_.diagonal(i); }

    // First guess: the velocity extrapolated over h.
    void extrapolate(double h, Field& u) const;
    // By which the velocity u differs from it: the largest |dU| + a |dOmega| of free bodies, over a, the radius of the
    // sphere of their volume [1/s].
    double largestDifference(double h, const Field& u) const;
    bool areSomeFree() const;
    // Rows of bodies in A u, and in the residual of u.
    void putProduct(double c1, const Field& u, const particles::RealArray& force, Field& product) const;
    void putResidual(double c1, double c2, const Field& u, const particles::RealArray& force, Field& residual);
    // P^T of forces alone.
    void putForces(const particles::RealArray& force, Field& rows) const;

    // Preconditioner: z = Pi (D^-1 + G) Pi^T r, where Pi makes the velocities of a body's particles rigid by least
    // squares, G is the part on the grid, and D of a body is inertia and what its particles have of the diagonal with
    // others. diagonal(i): of particle i without its mass. Takes the particles of bodies out of `inverse`. Collective.
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
    void project(Field& z);                   // of the last r. Collective

    // At the end of a step with the velocity u: motion and places of bodies, force and torque on them. Collective.
    void arrive(double dt, double h, const Field& u);
    // Force and torque of the fluid, from the forces at the velocity found. Collective.
    void findWrenches(const particles::RealArray& force);

    // What bodies do for the budget at the velocity u found, after findWrenches; the power of the continuation on them
    // is returned. This rank's part.
    double addRates(double c1, double c2, const Field& u, sph::Budget::Values& rates) const;

    // In a flow w whose images slide: sets the velocities of bodies to w at their centres, and of their particles.
    template <class W>
    void setMotions(W&& w, Field& u) const {
        for (std::size_t b = 0; b < bodies().size(); ++b) put(u, b, w(bodies()[b].state.centre), Vec3::Zero());
        spread(u, sph::FieldOf::velocities);
    }
    // Power in the flow u of the surface layer's reaction on bodies, as found last; this rank's part [W].
    double reactionPower(const Field& u) const;
    // Power of these forces on bodies' particles by the slide alone of those that are in another image than their
    // body's centre; this rank's part [W].
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
    std::vector<OtherMember> others_;               // particles of bodies that other ranks have
    std::vector<double> periods_;                   // of members, from where their body has them
    std::vector<bodies::RigidState> saved_;         // at the beginning of the step
    SurfaceLayer<Real> layer_;                      // beside the surfaces
    std::vector<double> outward_;                   // share of the members' pairs, by l_ij, that are not with bodies
    std::vector<Vec3> gyroscopic_;                  // torque that the system has of each body, on the root
    std::vector<sph::Wrench> reaction_, residual_;  // of the continuation, this rank's part; of the last r, whole
    std::vector<Eigen::LLT<Matrix6>> inertia_, particles_;  // D, and P^T P
    Field shared_;
};

extern template class RigidUnknowns<double>;
extern template class RigidUnknowns<float>;

}  // namespace corpuscle::implicit
