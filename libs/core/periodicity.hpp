// Periodic images of a box: what is at x with velocity u is also, for all integers n_k, at
//     x + sum_k n_k (L_k e_k + offset_k)   with velocity   u + sum_k n_k slide_k
// L_k: edge of the box along axis k if it is periodic. offset and slide are 0 unless images slide past each other,
// across one axis at most (a sheared box, whose planes move relative to each other: Lees-Edwards conditions).
//
// A surface that crosses a periodic face is not cut: its nodes are contiguous and may lie outside the box. Which image
// of a point belongs to such a surface is decided by the surface itself: every image within its bounds is tested.
// Choosing the image by its distance from one point of the surface, its centroid or middle, would give another image
// wherever the surface extends further than half a period from that point.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "core/vec.hpp"

namespace corpuscle {

class Periodicity {
  public:
    struct Image {
        Vec3 shift = Vec3::Zero();  // added to positions [m]
        Vec3 slide = Vec3::Zero();  // added to velocities [m/s]
    };

    Periodicity() = default;  // along no axis
    Periodicity(const Vec3& low, const Vec3& high, const std::array<bool, 3>& along);
    // Of a box around the origin with these edges [m], 0 along an axis that is not periodic.
    static Periodicity centred(const Vec3& lengths) {
        return {-0.5 * lengths, 0.5 * lengths, {lengths[0] > 0, lengths[1] > 0, lengths[2] > 0}};
    }

    bool isAlong(int k) const { return length_[k] > 0; }
    const Vec3& lengths() const { return length_; }  // L [m], 0 along an axis that is not periodic

    // Images across the faces of this axis are displaced by `offset` [m] at present and move with `velocity` [m/s];
    // neither vector has a component along the axis.
    void slide(int axis, const Vec3& offset, const Vec3& velocity);
    bool slides() const { return sliding_ >= 0; }
    int slidingAxis() const { return sliding_; }    // -1: nothing slides
    const Vec3& offset() const { return offset_; }  // of the next image along this axis [m]
    const Vec3& slide() const { return slide_; }    // its velocity minus that of the particle [m/s]
    // Number of periods along the sliding axis from x to `image`, an image of x.
    double periods(const Vec3& x, const Vec3& image) const {
        return slides() ? std::nearbyint((image[sliding_] - x[sliding_]) / length_[sliding_]) : 0;
    }
    // Velocity of `image`, an image of x, minus that of x [m/s].
    Vec3 slideOf(const Vec3& x, const Vec3& image) const { return periods(x, image) * slide_; }

    Image image(const Index3& n) const {
        Image image{Vec3(n[0], n[1], n[2]).cwiseProduct(length_), Vec3::Zero()};
        if (slides()) {
            const double periods = n[static_cast<std::size_t>(sliding_)];
            image.shift += periods * offset_, image.slide = periods * slide_;
        }
        return image;
    }

    // The image of x inside the box, along periodic axes only; bitwise x itself where x is inside.
    Vec3 wrap(Vec3 x) const {
        wrap(x, [](double) {});
        return x;
    }
    // The same for x together with its velocity u.
    void wrap(Vec3& x, Vec3& u) const {
        wrap(x, [&](double periods) { u += periods * slide_; });
    }
    // The coordinate x along axis k, moved into the box. Sliding is not considered.
    double wrap(double x, int k) const {
        if (!isAlong(k) || isInside(x, k)) return x;
        return std::max(x - length_[k] * periodsTo(x, k), low_[k]);
    }

    // The image of x that is nearest to `to`; bitwise x where that is x itself. Where images slide, the nearest along
    // the sliding axis, and then along the others.
    Vec3 nearest(Vec3 x, const Vec3& to) const {
        inOrder([&](int k) {
            const double periods = std::nearbyint((to[k] - x[k]) / length_[k]);
            if (periods == 0) return;
            x[k] += periods * length_[k];
            if (k == sliding_) x += periods * offset_;
        });
        return x;
    }
    // The shortest image of a difference of positions.
    Vec3 shortest(Vec3 d) const {
        inOrder([&](int k) {
            const double periods = std::nearbyint(d[k] / length_[k]);
            d[k] -= length_[k] * periods;
            if (k == sliding_) d -= periods * offset_;
        });
        return d;
    }

    // Calls f(image) for each image of x in the cuboid [low, high], including x itself if it lies there.
    template <class F>
    void forImagesWithin(const Vec3& x, const Vec3& low, const Vec3& high, F&& f) const {
        if (!slides()) return forPlainImages(x, low, high, length_, f);
        const int k = sliding_;
        Vec3 others = length_;
        others[k] = 0;
        const double first = std::ceil((low[k] - x[k]) / length_[k]), last = std::floor((high[k] - x[k]) / length_[k]);
        for (double n = first; n <= last; ++n) {
            Vec3 image = x + n * offset_;
            image[k] += n * length_[k];
            forPlainImages(image, low, high, others, f);
        }
    }

  private:
    bool isInside(double x, int k) const { return x >= low_[k] && x < high_[k]; }
    // Whole periods from the box to x. 0 if x lies so little below the box that rounding would put its image on the
    // upper face: x then belongs to the lower face, and moving it would add the offset of a sliding image without need.
    double periodsTo(double x, int k) const {
        if (isInside(x, k)) return 0;
        const double periods = std::floor((x - low_[k]) / length_[k]);
        return x - length_[k] * periods < high_[k] ? periods : periods + 1;
    }
    // Calls f(k) for the periodic axes, the sliding one first, since its offset moves x along the others.
    template <class F>
    void inOrder(F&& f) const {
        if (slides()) f(sliding_);
        for (int k = 0; k < 3; ++k)
            if (isAlong(k) && k != sliding_) f(k);
    }
    template <class F>
    void wrap(Vec3& x, F&& slid) const {
        if (slides()) {
            const int k = sliding_;
            const double periods = periodsTo(x[k], k);
            if (periods != 0) x -= periods * offset_, slid(-periods);
        }
        for (int k = 0; k < 3; ++k) x[k] = wrap(x[k], k);
    }
    template <class F>
    static void forPlainImages(const Vec3& x, const Vec3& low, const Vec3& high, const Vec3& length, F& f) {
        Vec3 first = Vec3::Zero();  // in periods
        Index3 count{1, 1, 1};
        for (int k = 0; k < 3; ++k) {
            if (!(length[k] > 0)) {
                if (!(x[k] >= low[k] && x[k] <= high[k])) return;
                continue;
            }
            first[k] = std::ceil((low[k] - x[k]) / length[k]);
            const double images = std::floor((high[k] - x[k]) / length[k]) - first[k] + 1;
            if (!(images >= 1)) return;
            count[static_cast<std::size_t>(k)] = static_cast<int>(images);
        }
        for (int a = 0; a < count[0]; ++a)
            for (int b = 0; b < count[1]; ++b)
                for (int c = 0; c < count[2]; ++c) f(Vec3(x + (first + Vec3(a, b, c)).cwiseProduct(length)));
    }

    Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero(), length_ = Vec3::Zero();
    int sliding_ = -1;  // axis; -1: nothing slides
    Vec3 offset_ = Vec3::Zero(), slide_ = Vec3::Zero();
};

}  // namespace corpuscle
