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

bool isSet(unsigned char flag) { return flag != 0; }

// Calls f for every span of candidates in one set of columns, from particle `from` on, that may lie within reach of the
// bounds. `spans` holds the last result for each column, from which the search starts, as the next block is close by.
template <class F>
void forSpans(const Columns& columns, int from, const double* z, const Bounds& bounds, double reach,
              std::vector<Columns::Span>& spans, F&& f) {
    const auto& [low, high] = bounds;
    const int x0 = columns.cellX(low[0] - reach), x1 = columns.cellX(high[0] + reach);
    const int y0 = columns.cellY(low[1] - reach), y1 = columns.cellY(high[1] + reach);
    for (int cx = x0; cx <= x1; ++cx) {
        const double gapX = columns.gapX(cx, low[0], high[0]);
        for (int cy = y0; cy <= y1; ++cy) {
            const int column = columns.column(cx, cy);
            if (columns.end(column) <= from) continue;
            const double gapY = columns.gapY(cy, low[1], high[1]);
            const double rest = reach * reach - gapX * gapX - gapY * gapY;
            if (rest <= 0) continue;
            const double dz = std::sqrt(rest);
            Columns::Span& near = spans[static_cast<std::size_t>(column)];
            near = columns.between(column, z, low[2] - dz, high[2] + dz, near);
            const Columns::Span span{std::max(near.begin, from), near.end};
            if (span.begin < span.end) f(span);
        }
    }
}

}  // namespace

// State of the search for the blocks that share their candidates: 2h and 2h + 1 stand for the near and far candidates
// of block h, stored in found_. out points past the last entry; later is the number of entries before the first ghost.
struct PairList::Candidates {
    int* out[4];
    std::ptrdiff_t later[4];
};

void PairList::build(const Columns& ownedColumns, int owned, const Columns& ghostColumns, int ghosts,
                     const double* const position[3], const std::vector<unsigned char>& wall,
                     const std::vector<int>& imageOf, const Brick& brick, double support, double reach) {
    owned_ = owned;
    constexpr int points = ListKernel::points;
    const int together = points / lanes_, count = (owned + lanes_ - 1) / lanes_;
    first_.assign(PairView::parts * static_cast<std::size_t>(count) + 1, 0);
    for (auto& group : blocks_) group.clear();
    const double *x = position[0], *y = position[1], *z = position[2];

    // The reach is increased by the largest possible rounding error of single precision.
    const double extent = findRelative(position, owned + ghosts, 0.5 * (brick.low + brick.high));
    const auto wide = static_cast<float>(reach + 4 * std::numeric_limits<float>::epsilon() * (extent + reach));
    const ListKernel::Gather gather = together == 2 ? listKernel().twoBlocks : listKernel().oneBlock;
    std::vector<Columns::Span> ownedSpans(static_cast<std::size_t>(ownedColumns.columnCount()));
    std::vector<Columns::Span> ghostSpans(static_cast<std::size_t>(ghostColumns.columnCount()));
    const auto within = static_cast<float>(support);
    Candidates c;
    float point[3 * points];
    const auto find = [&](Columns::Span span, int offset) {
        for (int k = 0; k < 2 * together; ++k) {  // makes room for all candidates of the span
            const auto used = static_cast<std::size_t>(c.out[k] - found_[k].data());
            const std::size_t room = used + static_cast<std::size_t>(span.end - span.begin) + ListKernel::padding;
            if (found_[k].size() < room) found_[k].resize(2 * room), c.out[k] = found_[k].data() + used;
        }
        gather(point, relative_[0].data() + offset, relative_[1].data() + offset, relative_[2].data() + offset,
               span.begin, span.end, offset, within * within, wide * wide, c.out);
    };
    std::size_t used = 0;
    for (int start = 0; start < owned; start += points) {
        const int stop = std::min(start + points, owned);
        Bounds bounds{Vec3::Constant(INFINITY), Vec3::Constant(-INFINITY)};
        for (int l = 0; l < points; ++l) {
            const int i = std::min(start + l, stop - 1);
            const Vec3 p(x[i], y[i], z[i]);
            bounds.low = bounds.low.cwiseMin(p), bounds.high = bounds.high.cwiseMax(p);
            for (int k = 0; k < 3; ++k) point[k * points + l] = relative_[k][i];
        }
        // Particles of later blocks. Those of the second of two blocks are candidates of the first block alone.
        for (int k = 0; k < 2 * together; ++k) c.out[k] = found_[k].data();
        if (start + lanes_ < stop) {
            find({start + lanes_, stop}, 0);
            c.out[2] = found_[2].data(), c.out[3] = found_[3].data();
        }
        forSpans(ownedColumns, stop, z, bounds, reach, ownedSpans, [&](Columns::Span span) { find(span, 0); });
        for (int k = 0; k < 2 * together; ++k) c.later[k] = c.out[k] - found_[k].data();
        // A block that is further than the reach from all faces of the brick has no ghosts, since these lie outside.
        const bool inside =
            ((bounds.low - brick.low).array() > reach).all() && ((brick.high - bounds.high).array() > reach).all();
        if (ghosts > 0 && !inside)
            forSpans(ghostColumns, 0, z + owned, bounds, reach, ghostSpans,
                     [&](Columns::Span span) { find(span, owned); });
        for (int h = 0; h < together && start + h * lanes_ < stop; ++h)
            used = list(start + h * lanes_, stop, h, c, used, wall, imageOf);
    }
    if (used > 0) j_[used] = 0;
}

// Fills relative_ with positions relative to `middle` in single precision; returns the largest absolute coordinate.
double PairList::findRelative(const double* const position[3], int count, const Vec3& middle) {
    double extent = 0;
    for (int k = 0; k < 3; ++k) {
        relative_[k].resize(static_cast<std::size_t>(count) + ListKernel::padding, 0.0f);
        for (int i = 0; i < count; ++i) {
            const double d = position[k][i] - middle[k];
            extent = std::max(extent, std::abs(d));
            relative_[k][i] = static_cast<float>(d);
        }
    }
    return extent;
}

// Appends to j_, after its first `used` entries, the list of the block that begins at particle `slot` and is number h
// of those that share c. Returns the new number of entries.
std::size_t PairList::list(int slot, int stop, int h, const Candidates& c, std::size_t used,
                           const std::vector<unsigned char>& wall, const std::vector<int>& imageOf) {
    const int b = slot / lanes_, last = std::min(slot + lanes_, stop);
    std::size_t room = used + ListKernel::padding;
    for (const int k : {2 * h, 2 * h + 1}) room += static_cast<std::size_t>(c.out[k] - found_[k].data());
    if (j_.size() < room) j_.resize(std::max(room, j_.size() + j_.size() / 2 + 1024));
    const bool allWall = !wall.empty() && std::all_of(wall.begin() + slot, wall.begin() + last, isSet);
    // Two blocks that meet across a periodic face do so twice, each with images of the other: the earlier block lists
    // these pairs.
    const auto blockOf = [&](int ghost) {
        const int own = imageOf[ghost - owned_];
        return own < 0 ? -1 : own / lanes_;
    };
    int* const begin = j_.data() + used;
    int* to = begin;
    int* first = first_.data() + static_cast<std::size_t>(PairView::parts) * static_cast<std::size_t>(b);
    bool meetsGhosts = false;
    const auto append = [&](int j) {
        *to = j;
        to += !allWall || wall[j] == 0;
    };
    for (const int k : {2 * h, 2 * h + 1}) {
        const int *found = found_[k].data(), *ghosts = found + c.later[k];
        std::for_each(found, ghosts, append);
        const int* const before = to;
        std::for_each(ghosts, static_cast<const int*>(c.out[k]), [&](int j) {
            if (const int block = blockOf(j); block < 0 || block > b) append(j);
        });
        meetsGhosts = meetsGhosts || to > before;
        *++first = static_cast<int>(to - j_.data());
    }
    for (const int k : {2 * h, 2 * h + 1}) {
        const int* const before = to;
        std::for_each(found_[k].data() + c.later[k], c.out[k], [&](int j) {
            if (blockOf(j) == b) append(j);
        });
        meetsGhosts = meetsGhosts || to > before;
        *++first = static_cast<int>(to - j_.data());
    }
    if (to - j_.data() > INT32_MAX)
        throw Failure(ExitCode::numerics, "the neighbour list of one rank exceeds 2^31 entries: use more ranks");
    const bool atWall = !wall.empty() && (std::any_of(wall.begin() + slot, wall.begin() + last, isSet) ||
                                          std::any_of(begin, to, [&](int j) { return wall[j] != 0; }));
    blocks_[(meetsGhosts ? boundary : interior) + (atWall ? 1 : 0)].push_back(b);
    return static_cast<std::size_t>(to - j_.data());
}

}  // namespace corpuscle::particles
