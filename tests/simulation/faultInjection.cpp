// dmpFlow with a fault injected into its state between two steps, which Rollback must correct (simulation/run.hpp).
//
//     faultInjection -case DIR -kind speed -at 12 -seed 3
//
// kind      | fault of one fluid particle, of one node of one cell, or of the first cell
// nan       | one component of the particle's position or velocity, or its density, is set to NaN
// speed     | the velocity of the particle is multiplied by a thousand
// density   | the density of the particle is halved
// node      | the node is moved across the cell, to the other side of the cell's middle
// triangle  | the node is moved to the other side of the opposite edge of one of its triangles, which turns that over
// cells     | the first cell of two is moved half of the way to the second, with all of its nodes
// wall      | the first cell is moved to the upper wall along z
// image     | the first cell is stretched to 1.3 of its length along x, and made thinner
// The seed selects particle and node, the same on any number of ranks. -always: each time that the run comes to this
// step.
#include <Eigen/Geometry>
#include <random>

#include "simulation/run.hpp"

using namespace corpuscle;
using coupling::Scene;
using particles::Kind;
using particles::ParticleStore;

namespace {

class Injection {
  public:
    Injection(const Application& app)
        : kind_(app.value("kind").value_or("nan")),
          at_(app.integer("at", 0).value_or(1)),
          always_(app.has("always")),
          random_(static_cast<unsigned>(app.integer("seed").value_or(1))) {}

    void before(Scene& scene, long step) {
        if (step != at_ || (done_ && !always_)) return;
        done_ = true;
        std::mt19937_64 random = random_;  // a copy, so that the choice is the same each time
        if (kind_ == "cells" || kind_ == "wall" || kind_ == "image")
            moveCell(scene);
        else if (kind_ == "node" || kind_ == "triangle")
            moveNode(scene, random);
        else
            harmParticle(scene, random);
    }

  private:
    void harmParticle(Scene& scene, std::mt19937_64& random) const {
        ParticleStore& s = scene.store();
        long fluid = 0;
        for (std::size_t i = 0; i < s.size(); ++i) fluid += s.kindOf(i) == Kind::fluid;
        fluid = Communicator(scene.system->comm()).sum(fluid);  // their ids start at 0
        const auto id = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(fluid));
        const auto which = random() % 7;
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (s.id[i] != id) continue;
            double* const numbers[7] = {&s.x[i], &s.y[i], &s.z[i], &s.u[i], &s.v[i], &s.w[i], &s.density[i]};
            if (kind_ == "nan")
                *numbers[which] = std::numeric_limits<double>::quiet_NaN();
            else if (kind_ == "speed")
                s.setVelocity(i, 1000 * s.velocity(i));
            else if (kind_ == "density")
                s.density[i] *= 0.5;
            else
                throw Failure(ExitCode::usage,
                              "-kind " + kind_ + ": there are nan, speed, density, node, triangle, cells, wall, image");
        }
    }

    void moveCell(Scene& scene) const {
        coupling::Cell* const first = scene.cells.find(1);
        if (!first) return;
        const Vec3 middle = coupling::middleOf(*first);
        Vec3 way = Vec3::Zero(), stretch = Vec3::Ones();
        if (kind_ == "cells") way = 0.5 * (otherMiddle(scene) - middle);
        if (kind_ == "wall") way[2] = scene.fluidBox.high[2] - middle[2];
        if (kind_ == "image") stretch = Vec3(1.3, 0.88, 0.88);
        for (Vec3& x : first->membrane.position) x = middle + way + stretch.cwiseProduct(x - middle);
    }

    // Middle of the second cell at the start; it has hardly moved.
    static Vec3 otherMiddle(const Scene& scene) {
        geometry::Bounds bounds;
        for (const Vec3& x : scene.cells.startingNodes(2)) bounds.extend(x);
        return bounds.center();
    }

    void moveNode(Scene& scene, std::mt19937_64& random) const {
        const int number = static_cast<int>(random() % scene.cells.count()) + 1;
        const coupling::CellType& type = scene.cells.types()[scene.cells.typeOf(number)];
        const Index3& corners = type.triangles.at(random() % type.triangles.size());
        coupling::Cell* const cell = scene.cells.find(number);
        if (!cell) return;
        membrane::Membrane& m = cell->membrane;
        const auto place = [&](int k) -> Vec3& { return m.position[static_cast<std::size_t>(corners[k])]; };
        Vec3 to;
        if (kind_ == "node") {
            Vec3 middle = Vec3::Zero();
            for (const Vec3& x : m.position) middle += x / static_cast<double>(m.position.size());
            to = 2 * middle - place(0);
        } else {
            const Vec3 along = (place(2) - place(1)).normalized(), arm = place(0) - place(1);
            to = place(0) - 2 * (arm - arm.dot(along) * along);
        }
        place(0) = to;
        ParticleStore& s = scene.store();
        if (!s.optional().node) return;
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.node[i] == cell->firstNode + corners[0]) s.setPosition(i, to);
    }

    std::string kind_;
    long at_;
    bool always_, done_ = false;
    std::mt19937_64 random_;
};

}  // namespace

int main(int argc, char* argv[]) {
    std::vector<Option> options = solverOptions();
    options.push_back({"kind", "KIND", "nan, speed, density, node, triangle, cells, wall or image."});
    options.push_back({"at", "STEP", "Before the step after this one."});
    options.push_back({"seed", "N", "Picks the place."});
    options.push_back({"always", "", "Each time that the run comes to this step."});
    Application app("faultInjection", "A run with a fault in its state.", argc, argv, {.options = options});
    return app.run([&] {
        Injection fault(app);
        simulation::RunHooks hooks;
        hooks.beforeStep = [&](Scene& scene, Time& time, const simulation::Integrator&) {
            fault.before(scene, time.step);
        };
        return simulation::run(app, hooks);
    });
}
