// Boxes in a uniform grid of cubes, to find those that intersect a given box.
//
// Each cube has a list of the boxes that reach into it; all lists are in one array, with the index where each begins.
// The cubes are as large as the boxes on average, or larger, so that there are at most `perBox` entries per box.
#pragma once
#include <vector>

#include "geometry/crossings.hpp"

namespace corpuscle::contact {

class BoxGrid {
  public:
    explicit BoxGrid(const std::vector<geometry::Bounds>& boxes);  // kept by reference

    // f(number) once for each box that intersects this one, in no particular order.
    template <class F>
    void forMeeting(const geometry::Bounds& box, F&& f) {
        if (boxes_.empty() || !all_.intersects(box)) return;
        ++question_;
        const Index3 low = cube(box.min()), high = cube(box.max());
        for (int i = low[0]; i <= high[0]; ++i)
            for (int j = low[1]; j <= high[1]; ++j)
                for (int k = low[2]; k <= high[2]; ++k) {
                    const std::size_t at = index(i, j, k);
                    for (int n = begin_[at]; n < begin_[at + 1]; ++n) {
                        const int number = entries_[n];
                        if (asked_[number] == question_) continue;
                        asked_[number] = question_;
                        if (boxes_[number].intersects(box)) f(number);
                    }
                }
    }

  private:
    static constexpr double perBox = 16;
    Index3 cube(const Vec3& x) const;  // the nearest one of the grid
    std::size_t index(int i, int j, int k) const {
        return (static_cast<std::size_t>(i) * count_[1] + j) * count_[2] + k;
    }
    void chooseCubes();
    double entries() const;
    template <class F>
    void forCubes(const geometry::Bounds& box, F&& f) const;

    const std::vector<geometry::Bounds>& boxes_;
    geometry::Bounds all_;
    double size_ = 1;  // of a cube, m
    Index3 count_{1, 1, 1};
    std::vector<int> begin_, entries_;
    std::vector<unsigned> asked_;  // number of the query that found each box last
    unsigned question_ = 0;
};

}  // namespace corpuscle::contact
