#include "membrane/excessArea.hpp"

#include <algorithm>

#include "core/registry.hpp"
#include "membrane/diagnostics.hpp"

namespace corpuscle::membrane {

std::vector<double> ExcessArea::atRest(const Network& network, const MembraneSettings& /*laws*/,
                                       std::span<const Vec3> x) const {
    std::vector<double> shares = vertexAreas(network, x);
    const std::vector<double> rest = vertexAreas(network, network.stressFree());
    for (std::size_t n = 0; n < shares.size(); ++n)
        shares[n] = shares[n] > 0 ? share * std::max(0.0, 1 - (1 + onset) * rest[n] / shares[n]) : 0;
    return shares;
}

const Schema<ExcessArea>& ExcessArea::schema() {
    static const Schema<ExcessArea> s =
        Schema<ExcessArea>("excess area", "area beyond a strain that the bilayer bears is pores")
            .quantity("onset", &ExcessArea::onset, unit::none, "areal strain A/A0 - 1 from which pores open",
                      {.range = nonNegative})
            .quantity("share", &ExcessArea::share, unit::none, "part of the area beyond the onset that is pores",
                      {.fallback = "1", .range = {0, 1, true, false}})
            .include<PoreLaw>();
    return s;
}

CORPUSCLE_REGISTER(PoreLaw, ExcessArea, "excessArea", "pores by areal strain: the area beyond an onset");

}  // namespace corpuscle::membrane
