#include "implicit/disturbance.hpp"

#include <cmath>

#include "core/communicator.hpp"

namespace corpuscle::implicit {

using particles::setVector;
using particles::vectorAt;

template <class Real>
double disturbanceOf(System<Real>& system, const typename System<Real>::Field& v,
                     const std::vector<double>& divergence) {
    const coupling::Scene& scene = system.scene();
    const TimeDifference& time = system.time();
    const particles::ParticleStore& s = scene.store();
    const auto affine = [&](const Vec3& x) {
        return scene.flow.shearRate > 0 ? scene.flow.undisturbed(x) : Vec3(Vec3::Zero());
    };
    double sum = 0;
    const Vec3& g = scene.model().bodyForce;
    typename System<Real>::Field disturbance(system.length(), Real(0)), undisturbed(system.length(), Real(0));
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 flow = affine(s.position(i)),
                   w = system.isPrescribed(i) ? Vec3::Zero() : Vec3(vectorAt(v, i) - flow);
        const Vec3 a(s.fx[i], s.fy[i], s.fz[i]);
        if (system.isOfBody(i))  // stress within the body resists what is not rigid
            sum -= w.dot(system.force(i));
        else
            sum += system.mass(i) * w.dot(time.c1 * (s.velocity(i) - flow) + time.c2 * a + g);
        sum += system.operators().volume(i) * system.fluid().pressure(i) * divergence[i];
        setVector(disturbance, i, w);
        setVector(undisturbed, i, flow);
    }
    sum += system.power(undisturbed, disturbance);
    return std::abs(Communicator(scene.system->comm()).sum(sum));
}

double leastDisturbance(const coupling::Scene& scene) {
    const double rate = scene.flow.rate;
    return 1e-10 * scene.model().viscosity * rate * rate * scene.fluidBox.volume();
}

template double disturbanceOf(System<double>&, const System<double>::Field&, const std::vector<double>&);
template double disturbanceOf(System<float>&, const System<float>::Field&, const std::vector<double>&);

}  // namespace corpuscle::implicit
