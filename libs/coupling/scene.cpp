#include "coupling/scene.hpp"

namespace corpuscle::coupling {

void Scene::driveAt(double t) {
    if (!flow.drive && !control) return;
    if (flow.drive) flow.factor = flow.drive->factor(t);
    const Vec3 force = control ? control->force() : Vec3(flow.factor * flow.bodyForce);
    sph::FlowState::moveWalls(flow.wallVelocities, flow.factor, flow.walls);
    forces->setDrive(force, flow.walls);
    if (bodies) bodies->setBodyForce(force);
    if (flow.wallVelocities.empty()) return;
    particles::ParticleStore& s = store();
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.kindOf(i) == particles::Kind::wall) s.setVelocity(i, flow.walls.nearest(s.position(i)).velocity);
}

}  // namespace corpuscle::coupling
