// Records of the laws that couple fluid particles on one side of a membrane only (meanPair.hpp, diffusionPair.hpp):
// x y z in supports (pairLoop.hpp) | a volume, in units of dx^3 | a quantity | side, a whole number
#pragma once
#include <cmath>

#include "particles/sumOverPairs.hpp"

namespace corpuscle::sph {

struct SidedRecord {
    static constexpr int volume = 3, quantity = 4, side = 5, fields = 6;
    static constexpr double noSide = -1;  // of particles that are not fluid
};

// volume(i) [m^3] and quantity(i) of the owned particle i; room for ghosts follows. Sides are 0 outside and n inside
// cell n.
template <class Volume, class QuantityOf>
particles::RealArray sidedRecords(const particles::ParticleSystem& system, Volume&& volume, QuantityOf&& quantity) {
    using Record = SidedRecord;
    const particles::ParticleStore& s = system.store();
    const auto n = static_cast<std::size_t>(system.owned());
    particles::RealArray records((n + static_cast<std::size_t>(system.ghosts())) * Record::fields);
    const particles::RecordFrame frame(system);
    const double unitVolume = std::pow(system.spacing(), -3);
    for (std::size_t i = 0; i < n; ++i) {
        double* r = records.data() + Record::fields * i;
        frame.position(i, r);
        if (system.periodicity().slides()) {  // particles may have been wrapped since the lists were built
            const Vec3 x = s.position(i), built(s.xBuilt[i], s.yBuilt[i], s.zBuilt[i]);
            Vec3::Map(r) += (system.periodicity().nearest(x, built) - x) / system.support();
        }
        const bool fluid = s.kindOf(i) == particles::Kind::fluid;
        r[Record::volume] = volume(i) * unitVolume;
        r[Record::quantity] = quantity(i);
        r[Record::side] = !fluid ? Record::noSide : s.optional().side ? static_cast<double>(s.side[i]) : 0;
    }
    return records;
}

}  // namespace corpuscle::sph
