#include "geometry/crossings.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace corpuscle::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

CGAL::Bbox_3 box(const Bounds& b) {
    return {b.min().x(), b.min().y(), b.min().z(), b.max().x(), b.max().y(), b.max().z()};
}

// A triangle of a surface, moved by a shift, with its bounds.
struct Facet {
    Kernel::Triangle_3 triangle;
    Bounds bounds;
};

std::vector<Facet> facetsWithin(const SurfaceView& surface, const Vec3& shift, const Bounds& part) {
    std::vector<Facet> facets;
    for (const Index3& t : *surface.triangles) {
        Bounds bounds;
        for (const int node : t) bounds.extend((*surface.nodes)[static_cast<std::size_t>(node)] + shift);
        if (!bounds.intersects(part)) continue;
        const auto p = [&](std::size_t k) {
            const Vec3 x = (*surface.nodes)[static_cast<std::size_t>(t[k])] + shift;
            return Kernel::Point_3(x.x(), x.y(), x.z());
        };
        if (!CGAL::collinear(p(0), p(1), p(2))) facets.push_back({{p(0), p(1), p(2)}, bounds});
    }
    return facets;
}

}  // namespace

Bounds boundsOf(const std::vector<Vec3>& points) {
    Bounds all;
    for (const Vec3& x : points) {
        if (!x.allFinite()) return {};
        all.extend(x);
    }
    return all;
}

std::vector<ImagePair> neighbours(const std::vector<Bounds>& bounds, const Periodicity& period, double margin) {
    // own: each surface by the image whose bounds have their lower corner in the first period. images: all images of
    // the surfaces that may meet one of these.
    struct Image {
        std::size_t surface;
        Vec3 shift;  // from the surface's own position
    };
    std::vector<Image> own, images;
    Bounds all;
    const auto at = [&](const Image& image) { return bounds[image.surface].translated(image.shift); };
    for (std::size_t s = 0; s < bounds.size(); ++s) {
        if (bounds[s].isEmpty()) continue;
        Vec3 shift = Vec3::Zero();
        const auto move = [&](int k) {
            const double periods = -std::floor((bounds[s].min()[k] + shift[k]) / period.lengths()[k]);
            shift[k] += period.lengths()[k] * periods;
            if (k == period.slidingAxis()) shift += periods * period.offset();
        };
        if (period.slides()) move(period.slidingAxis());
        for (int k = 0; k < 3; ++k)
            if (period.isAlong(k) && k != period.slidingAxis()) move(k);
        own.push_back({s, shift});
        all.extend(at(own.back()));
    }
    const Vec3 reach = Vec3::Constant(margin);
    for (const Image& one : own) {
        const Bounds here = at(one);
        period.forImagesWithin(Vec3::Zero(), all.min() - here.max() - reach, all.max() - here.min() + reach,
                               [&](const Vec3& by) {
                                   images.push_back({one.surface, one.shift + by});
                               });
    }
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, const Image*>;
    std::vector<Box> ownBoxes, imageBoxes;
    for (const Image& image : own) {
        const Bounds grown(at(image).min() - reach, at(image).max() + reach);
        ownBoxes.emplace_back(box(grown), &image);
    }
    for (const Image& image : images) imageBoxes.emplace_back(box(at(image)), &image);
    std::vector<ImagePair> pairs;
    CGAL::box_intersection_d(
        ownBoxes.begin(), ownBoxes.end(), imageBoxes.begin(), imageBoxes.end(), [&](const Box& a, const Box& b) {
            const std::size_t first = a.info()->surface, second = b.info()->surface;
            const Vec3 shift = b.info()->shift - a.info()->shift;
            if (first > second) return;
            if (first == second) {  // take one of two opposite images, and not the surface itself
                const Vec3 half = 0.5 * period.lengths();
                const auto side = [&](int k) { return shift[k] > half[k] ? 1 : shift[k] < -half[k] ? -1 : 0; };
                // The sliding axis decides first: along the others, images across sliding faces have any offset.
                const int across = period.slides() ? side(period.slidingAxis()) : 0;
                const int lead = across != 0 ? across : side(0) != 0 ? side(0) : side(1) != 0 ? side(1) : side(2);
                if (lead <= 0) return;
            }
            pairs.push_back({first, second, shift, period.slideOf(Vec3::Zero(), shift)});
        });
    std::sort(pairs.begin(), pairs.end(), [](const ImagePair& a, const ImagePair& b) {
        return std::tie(a.first, a.second, a.shift[0], a.shift[1], a.shift[2]) <
               std::tie(b.first, b.second, b.shift[0], b.shift[1], b.shift[2]);
    });
    return pairs;
}

std::optional<Crossing> crossing(const SurfaceView& first, const SurfaceView& second, const Vec3& shift) {
    const Bounds part = first.bounds().intersection(second.bounds().translated(shift));
    if (part.isEmpty()) return {};
    const std::vector<Facet> one = facetsWithin(first, Vec3::Zero(), part);
    if (one.empty()) return {};
    const std::vector<Facet> other = facetsWithin(second, shift, part);
    if (other.empty()) return {};
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, const Facet*>;
    std::vector<Box> boxes[2];
    for (const Facet& facet : one) boxes[0].emplace_back(box(facet.bounds), &facet);
    for (const Facet& facet : other) boxes[1].emplace_back(box(facet.bounds), &facet);
    std::optional<Crossing> found;
    CGAL::box_intersection_d(boxes[0].begin(), boxes[0].end(), boxes[1].begin(), boxes[1].end(),
                             [&](const Box& a, const Box& b) {
                                 if (!CGAL::do_intersect(a.info()->triangle, b.info()->triangle)) return;
                                 // The first by place, which does not depend on the order of the boxes.
                                 const Vec3 place = a.info()->bounds.intersection(b.info()->bounds).center();
                                 if (!found)
                                     found = Crossing{place, 1};
                                 else {
                                     ++found->pairs;
                                     if (std::lexicographical_compare(place.data(), place.data() + 3,
                                                                      found->place.data(), found->place.data() + 3))
                                         found->place = place;
                                 }
                             });
    return found;
}

}  // namespace corpuscle::geometry
