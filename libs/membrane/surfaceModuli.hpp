// Moduli of a sheet at small strain: W = Ks/2 (tr eps)^2 + Gs |dev eps|^2 per area.
#pragma once

namespace corpuscle::membrane {

struct SurfaceModuli {
    double shear = 0;  // Gs, N/m
    double area = 0;   // Ks, N/m

    SurfaceModuli& operator+=(const SurfaceModuli& other) {
        shear += other.shear;
        area += other.area;
        return *this;
    }
};

}  // namespace corpuscle::membrane
