// A sphere in a periodic box of fluid as a scene of the implicit step.
#pragma once
#include "bodies/sphereInFluid.hpp"
#include "core/communicator.hpp"
#include "implicit/implicitStep.hpp"

namespace corpuscle::implicit::testing {

struct RigidSphereScene {
    coupling::Scene scene;
    Vec3 centre;

    RigidSphereScene(bodies::testing::SphereInFluid&& f, double rate) : centre(f.centre) {
        scene.system = std::move(f.system);
        scene.bodies = std::move(f.bodies);
        scene.forces = std::move(f.forces);
        scene.fluidBox = scene.system->box();
        scene.fluidVolume = scene.fluidBox.volume();
        scene.spacing = 1;
        scene.flow.rate = rate;
        scene.flow.length = scene.fluidBox.size()[2];
        scene.system->pairWithinBodies();
        scene.system->rebuild();
    }
    bodies::Body& body() { return scene.bodies->all()[0]; }

    std::unique_ptr<ImplicitStep> step(double tolerance, const std::string& method = "midpoint",
                                       sph::OperatorForm form = sph::OperatorForm::corrected,
                                       double error = ImplicitSettings{}.error) {
        ImplicitStep::Options options;
        options.form = form;
        options.settings = {.step = 0.1, .tolerance = tolerance, .error = error, .method = method};
        return ImplicitStep::make(scene, options);
    }

    // sum of f(index in the store) over the fluid particles of all ranks
    template <class F>
    double ofFluid(F&& f) const {
        double total = 0;
        for (std::size_t i = 0; i < scene.store().size(); ++i)
            if (scene.store().kindOf(i) == particles::Kind::fluid) total += f(i);
        return Communicator(scene.system->comm()).sum(total);
    }
    Vec3 fluidMomentum() const {
        Vec3 sum;
        for (int k = 0; k < 3; ++k)
            sum[k] = ofFluid([&](std::size_t i) { return scene.mass(i) * scene.store().velocity(i)[k]; });
        return sum;
    }
};

}  // namespace corpuscle::implicit::testing
