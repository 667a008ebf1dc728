// The largest eigenvalue of a symmetric operator by power iterations, which approach it from below.
//
//     x <- x/|x|;   x <- A x;   rate = |A x|/|x|
// Vectors, norms and the operator are the caller's.
#pragma once
#include <cmath>

namespace corpuscle {

// normalise(): scales x and returns the square of its norm after scaling, 0 when x has vanished. apply(): x <- A x,
// returns the square of the norm of the new x.
template <class Normalise, class Apply>
double largestEigenvalue(int iterations, Normalise&& normalise, Apply&& apply) {
    double rate = 0;
    for (int it = 0; it < iterations; ++it) {
        const double before = normalise();
        if (!(before > 0)) break;
        rate = std::sqrt(apply() / before);
    }
    return rate;
}

}  // namespace corpuscle
