// A periodic box, and the images of points in it.
//
// A surface that crosses a periodic face is kept whole: its nodes are contiguous and may lie outside the box. Which
// image of a point belongs to it is for the surface itself to say: every image that falls into its bounds is tested. An
// image chosen by its distance from one point of the surface, its centroid or middle, is another one wherever the
// surface reaches further than half a period from there.
#pragma once
#include <cmath>

#include "core/vec.hpp"

namespace corpuscle::geometry {

// Edge lengths of the box [m]; 0 along an axis that is not periodic.
using Period = Vec3;

// f(image) for each periodic image of x in the cuboid [low, high], itself included where it lies there.
template <class F>
void forImagesWithin(const Vec3& x, const Vec3& low, const Vec3& high, const Period& period, F&& f) {
    Vec3 first = Vec3::Zero();  // in periods
    Index3 count{1, 1, 1};
    for (int k = 0; k < 3; ++k) {
        if (!(period[k] > 0)) {
            if (!(x[k] >= low[k] && x[k] <= high[k])) return;
            continue;
        }
        first[k] = std::ceil((low[k] - x[k]) / period[k]);
        const double images = std::floor((high[k] - x[k]) / period[k]) - first[k] + 1;
        if (!(images >= 1)) return;
        count[static_cast<std::size_t>(k)] = static_cast<int>(images);
    }
    for (int a = 0; a < count[0]; ++a)
        for (int b = 0; b < count[1]; ++b)
            for (int c = 0; c < count[2]; ++c) f(Vec3(x + (first + Vec3(a, b, c)).cwiseProduct(period)));
}

}  // namespace corpuscle::geometry
