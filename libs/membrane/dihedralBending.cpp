#include "membrane/dihedralBending.hpp"

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<DihedralBending>& DihedralBending::schema() {
    static const Schema<DihedralBending> s =
        Schema<DihedralBending>("dihedral bending",
                                "springs on the angles between adjacent triangles, at rest in the stress-free mesh")
            .quantity(
                "Eb", &DihedralBending::Eb, unit::none,
                "bending modulus relative to the sheet, kappa/(Gs a^2), with Gs of bonds and triangles in closed form",
                {.range = positive})
            .quantity("kappa", &DihedralBending::kappa, unit::joule,
                      "bending modulus; the spring constant is 2/sqrt(3) kappa", {.range = positive})
            .quantity("k", &DihedralBending::k, unit::joule, "spring constant itself (N m/rad)", {.range = positive})
            .exactlyOneOf({"Eb", "kappa", "k"});
    return s;
}

CORPUSCLE_REGISTER(BendingLaw, DihedralBending, "dihedral", "springs on the angles between adjacent triangles");

}  // namespace corpuscle::membrane
