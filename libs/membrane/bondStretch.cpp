#include "membrane/bondStretch.hpp"

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<BondStretch>& BondStretch::schema() {
    static const Schema<BondStretch> s =
        Schema<BondStretch>("bond stretch",
                            "a bond breaks for good when its length exceeds limit times its rest length")
            .quantity("limit", &BondStretch::limit, unit::none, "greatest l/l0 of a bond",
                      {.range = {.low = 1, .lowOpen = true}});
    return s;
}

CORPUSCLE_REGISTER(RuptureLaw, BondStretch, "bondStretch", "a bond breaks past a stretch limit");

}  // namespace corpuscle::membrane
