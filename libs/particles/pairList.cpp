#include "particles/pairList.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "particles/listKernel.hpp"

namespace corpuscle::particles {

namespace {

struct Bounds {
    Vec3 low, high;
};

// Every span of candidates of one set of columns that may lie within reach of the bounds. `spans` holds the last answer for each
// column: the next block is close by.
template <class F>
void forSpans(const Columns& columns, const double* z, const Bounds& bounds, double reach,
              std::vector<Columns::Span>& spans, F&& f) {
    const auto& [low, high] = bounds;
    const int x0 = columns.cellX(low[0] - reach), x1 = columns.cellX(high[0] + reach);
    const int y0 = columns.cellY(low[1] - reach), y1 = columns.cellY(high[1] + reach);
    for (int cx = x0; cx <= x1; ++cx) {
        const double gapX = columns.gapX(cx, low[0], high[0]);
        for (int cy = y0; cy <= y1; ++cy) {
            const double gapY = columns.gapY(cy, low[1], high[1]);
            const double rest = reach * reach - gapX * gapX - gapY * gapY;
            if (rest <= 0) continue;
            const double dz = std::sqrt(rest);
            const int column = columns.column(cx, cy);
            Columns::Span& span = spans[static_cast<std::size_t>(column)];
            span = columns.between(column, z, low[2] - dz, high[2] + dz, span);
            if (span.begin < span.end) f(span);
        }
    }
}

}  // namespace

void PairList::build(const Columns& ownedColumns, int owned, const Columns& ghostColumns, int ghosts,
                     const double* const position[3], const std::vector<unsigned char>& wall, const Brick& brick,
                     double reach) {
    owned_ = owned;
    const int lanes = blockLanes();
    const int count = (owned + lanes - 1) / lanes, total = owned + ghosts;
    first_.assign(2 * static_cast<std::size_t>(count) + 1, 0);
    for (auto& group : blocks_) group.clear();
    const double *x = position[0], *y = position[1], *z = position[2];

    // Single precision relative to the middle; reach grows by what rounding may take away.
    const Vec3 middle = 0.5 * (brick.low + brick.high);
    double extent = 0;
    for (int k = 0; k < 3; ++k) {
        relative_[k].resize(static_cast<std::size_t>(total) + ListKernel::padding, 0.0f);
        for (int i = 0; i < total; ++i) {
            const double d = position[k][i] - middle[k];
            extent = std::max(extent, std::abs(d));
            relative_[k][i] = static_cast<float>(d);
        }
    }
    const auto wide = static_cast<float>(reach + 4 * std::numeric_limits<float>::epsilon() * (extent + reach));
    const ListKernel& kernel = listKernel();
    std::vector<Columns::Span> ownedSpans(static_cast<std::size_t>(ownedColumns.columnCount()));
    std::vector<Columns::Span> ghostSpans(static_cast<std::size_t>(ghostColumns.columnCount()));
    std::size_t used = 0;

    for (int b = 0; b < count; ++b) {
        const int slot = b * lanes, inBlock = std::min(lanes, owned - slot);
        float points[3 * 8];
        bool allWall = !wall.empty(), anyWall = false;
        Bounds bounds{Vec3::Constant(INFINITY), Vec3::Constant(-INFINITY)};
        for (int l = 0; l < lanes; ++l) {
            const int i = slot + std::min(l, inBlock - 1);
            const Vec3 p(x[i], y[i], z[i]);
            bounds.low = bounds.low.cwiseMin(p), bounds.high = bounds.high.cwiseMax(p);
            for (int k = 0; k < 3; ++k) points[k * lanes + l] = relative_[k][i];
            if (!wall.empty()) allWall = allWall && wall[i], anyWall = anyWall || wall[i];
        }
        const auto append = [&](Columns::Span span, int offset) {
            const std::size_t room = used + static_cast<std::size_t>(span.end - span.begin) + ListKernel::padding;
            if (j_.size() < room) j_.resize(std::max(room, j_.size() + j_.size() / 2 + 1024));
            int* out = j_.data() + used;
            int found = kernel.gather(points, relative_[0].data() + offset, relative_[1].data() + offset,
                                      relative_[2].data() + offset, span.begin, span.end, offset, wide * wide, out);
            if (allWall)
                found = static_cast<int>(std::remove_if(out, out + found, [&](int j) { return wall[j] != 0; }) - out);
            used += static_cast<std::size_t>(found);
        };
        // The particles of later blocks, then those of this one.
        const std::size_t start = used;
        forSpans(ownedColumns, z, bounds, reach, ownedSpans, [&](Columns::Span span) {
            span.begin = std::max(span.begin, slot + lanes);
            if (span.begin < span.end) append(span, 0);
        });
        first_[2 * static_cast<std::size_t>(b) + 1] = static_cast<int>(used);
        append({slot, slot + inBlock}, 0);
        const std::size_t interiorEntries = used;
        // Ghosts lie outside the brick.
        const bool inside =
            ((bounds.low - brick.low).array() > reach).all() && ((brick.high - bounds.high).array() > reach).all();
        if (ghosts > 0 && !inside)
            forSpans(ghostColumns, z + owned, bounds, reach, ghostSpans,
                     [&](Columns::Span span) { append(span, owned); });
        if (used > static_cast<std::size_t>(INT32_MAX))
            throw Failure(ExitCode::numerics, "the neighbour list of one rank exceeds 2^31 entries: use more ranks");
        first_[2 * static_cast<std::size_t>(b) + 2] = static_cast<int>(used);

        if (!wall.empty() && !anyWall)
            for (std::size_t k = start; k < used && !anyWall; ++k) anyWall = wall[j_[k]];
        blocks_[(used > interiorEntries ? boundary : interior) + (anyWall ? 1 : 0)].push_back(b);
    }
}

}  // namespace corpuscle::particles
