// Displacement of particles in one step in addition to that by their velocity: shifting, which keeps their distribution
// even, less the part that would cross a membrane.
//
//     s_i = min(C H^2 gammadot dt, 0.3/sum_j V_j F) R_i,  |s_i| <= q gammadot dt dx,
//         R_i = sum_j V_j F (1 + 0.2 (W/W(dx))^4) x_ij
//     near a membrane: s_i - chi [(dt (u_i - u_m) + s_i^-).n] n,    s_i^-: s_i if it goes towards the membrane, else 0
//
// symbol   | meaning
// C        | coefficient of the case: strength per unit of strain. The second bound in min() prevents a shift from
//          | overshooting
// R        | disorder (sph/momentPair.hpp); its second term separates pairs that are nearer than a spacing, which
//          | the gradient of a smooth kernel alone would let close up: Monaghan, J. Comput. Phys. 159 (2000) 290;
//          | Lind et al., ibid. 231 (2012) 1499
// q        | 1; 4 where cells may touch: between cells, the fluid parts at several times the rate of the flow, and
//          | particles that follow no faster leave a void, which grows, as its surface exerts no pressure
// chi, u_m | noFlux.hpp. Shifts away from the membrane are not reduced: else particles near it could never leave
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "coupling/noFlux.hpp"
#include "coupling/scene.hpp"
#include "sph/operators.hpp"

namespace corpuscle::coupling {

class Transport {
  public:
    Transport(const Scene& scene, std::optional<double> coefficient) : scene_(scene), coefficient_(coefficient) {}

    template <class Real>
    void shift(const sph::Operators<Real>& operators, double dt) {
        const particles::ParticleStore& s = scene_.store();
        moves_.assign(s.size(), Vec3::Zero());
        if (!coefficient_) return;
        const double largest = scene_.contacts ? largestBetweenCells : largestInSpacings;
        const double H = scene_.system->support(), strain = scene_.flow.rate * dt;
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (s.kindOf(i) != particles::Kind::fluid) continue;
            const double strength = std::min(*coefficient_ * H * H * strain, largestShare / operators.crowding(i));
            const Vec3 along = strength * operators.disorder(i);
            const double length = along.norm(), bound = largest * strain * scene_.spacing;
            moves_[i] = length > bound ? Vec3(bound / length * along) : along;
        }
    }

    // velocity(i): of particle i, constant over the step.
    template <class Velocity>
    void holdAtMembranes(const NoFlux& noFlux, double dt, Velocity&& velocity) {
        noFlux.forNear([&](int particle, double side, double chi, const Vec3& normal, const Vec3& membrane) {
            const auto i = static_cast<std::size_t>(particle);
            const double through = dt * (velocity(i) - membrane).dot(normal), shift = moves_[i].dot(normal);
            moves_[i] -= chi * (through + (side * shift < 0 ? shift : 0)) * normal;
        });
    }

    const Vec3& operator[](std::size_t i) const { return moves_[i]; }

  private:
    static constexpr double largestShare = 0.3, largestInSpacings = 1, largestBetweenCells = 4;

    const Scene& scene_;
    std::optional<double> coefficient_;
    std::vector<Vec3> moves_;
};

}  // namespace corpuscle::coupling
