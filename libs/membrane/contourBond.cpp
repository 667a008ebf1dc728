#include "membrane/contourBond.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace corpuscle::membrane {

void beyondContour(double l, double l0, double x0) {
    throw Failure(ExitCode::numerics,
                  fmt::format("a bond of rest length {:.4g} m has the length {:.4g} m, at or beyond its contour length "
                              "{:.4g} m; take a smaller x0 (now {:.4g}), a smaller time step, or let bonds break "
                              "before (rupture: bondStretch with a limit below {:.4g})",
                              l0, l, l0 / x0, x0, 1 / x0));
}

}  // namespace corpuscle::membrane
