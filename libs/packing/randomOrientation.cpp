#include "packing/randomOrientation.hpp"

namespace corpuscle::packing {

const Schema<RandomOrientation>& RandomOrientation::schema() {
    static const Schema<RandomOrientation> s("random", "axes that begin in random directions");
    return s;
}

CORPUSCLE_REGISTER(Orientation, RandomOrientation, "random",
                   "axes in random directions, turned as cells make room for each other");

}  // namespace corpuscle::packing
