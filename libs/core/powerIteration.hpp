// The largest eigenvalue of a symmetric operator by power iterations, which approach it from below.
//
//     x <- x/|x|;   x <- A x;   rate = |A x|/|x|
// Vectors, norms and the operator are the caller's.
#pragma once
#include <cmath>

namespace corpuscle {

// normalise(): scales x, and gives the square of its norm then; 0 where there is nothing left of it. apply(): x <- A x,
// and the square of the norm of that.
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
