// A rigid sphere in a periodic box of fluid. Unit of length: the particle spacing; densities are about 1.
#pragma once
#include "bodies/bodies.hpp"
#include "membrane/meshes.hpp"
#include "sph/samples.hpp"

namespace corpuscle::bodies::testing {

using namespace sph::testing;

inline constexpr double support = 2.4, skin = 0.3;

// A sphere of particles in a periodic lattice of fluid. Particles are numbered by their position relative to the
// sphere's centre, so that their initial state does not depend on where the sphere is.
struct SphereInFluid {
    Index3 size;
    Vec3 centre;
    MPI_Comm comm;
    sph::FluidModel fluid = model("wendlandC2");
    std::unique_ptr<ParticleSystem> system;
    std::unique_ptr<Bodies> bodies;
    std::unique_ptr<sph::FluidForces> forces;
    std::vector<Vec3> places;  // by id
    std::vector<bool> solid;

    SphereInFluid(const Index3& boxSize, const Vec3& place, const std::string& behaviour, double density = 1,
                  double disorder = 0, double radius = 3, const Vec3& bodyForce = Vec3::Zero(),
                  MPI_Comm among = MPI_COMM_WORLD, double leastDistance = Bodies::Medium{}.leastDistance)
        : size(boxSize), centre(place), comm(among) {
        fluid.bodyForce = bodyForce;
        const Box box = cube(size);
        system = std::make_unique<ParticleSystem>(comm, box, ParticleStore::Optional{.mass = true, .member = true},
                                                  support, skin, 1.0);
        auto mesh = membrane::testing::icosphere(3);
        for (Vec3& x : mesh.nodes) x = radius * x + centre;
        Body body("sphere", "sphere", {mesh.nodes, mesh.triangles}, density, choose<BodyMotion>(behaviour), support, 1);
        body.viscosity = fluid.viscosity;
        std::vector<Vec3> inside;
        for (const Particle& p : lattice(size, 0)) {
            const Vec3 relative = p.x - box.middle();
            solid.push_back(relative.norm() < radius);
            if (solid.back()) inside.push_back(centre + relative);
        }
        const std::vector<Particle> moved = lattice(size, disorder, 3);
        for (std::size_t i = 0; i < moved.size(); ++i) {
            const Vec3 off = solid[i] ? lattice(size, 0)[i].x : moved[i].x;
            places.push_back(centre + off - box.middle());
        }
        body.fill(inside, 1, *fluid.kernel, support);
        std::vector<Body> all;
        all.push_back(std::move(body));
        bodies = std::make_unique<Bodies>(std::move(all), Bodies::Medium{1, bodyForce, 1, leastDistance});
        forces = std::make_unique<sph::FluidForces>(fluid, *system, &bodies->groups());
        int rank = 0;
        MPI_Comm_rank(comm, &rank);
        if (rank == 0) addParticles();
        system->start();
        bodies->moved(*system, 0, true);
    }

    void addParticles() {
        ParticleStore& s = system->store();
        s.resize(places.size());
        std::int64_t member = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            s.setPosition(i, places[i]);
            s.density[i] = s.mass[i] = 1;
            s.id[i] = static_cast<std::int64_t>(i);
            s.kind[i] = static_cast<std::int64_t>(solid[i] ? Kind::body : Kind::fluid);
            s.member[i] = solid[i] ? member++ : -1;
        }
    }

    Body& body() { return bodies->all()[0]; }

    // Sets the velocity of each fluid particle by its position relative to the centre, and that of the body from its
    // motion.
    template <class F>
    void setVelocities(F&& velocity, const RigidMotion& rigid) {
        body().state.motion = rigid;
        bodies->groups().motion[0] = rigid;
        ParticleStore& s = system->store();
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec3 arm = system->periodicity().shortest(s.position(i) - centre);
            const auto id = static_cast<std::size_t>(s.id[i]);
            s.setVelocity(i, solid[id] ? rigid.at(arm) : velocity(id, arm));
            s.density[i] = 1 + 0.02 * std::sin(static_cast<double>(id));
        }
    }

    Vec3 momentum() const {
        const ParticleStore& s = system->store();
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.kindOf(i) == Kind::fluid) sum += s.mass[i] * s.velocity(i);
        MPI_Allreduce(MPI_IN_PLACE, sum.data(), 3, MPI_DOUBLE, MPI_SUM, comm);
        return sum;
    }
};

}  // namespace corpuscle::bodies::testing
