#include "particles/pairList.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "particles/listKernel.hpp"

namespace corpuscle::particles {

namespace {

// Every span of candidates of one set of columns that may lie within reach of the bounds low..high.
template <class F>
void forSpans(const Columns& columns, const double* z, const Vec3& low, const Vec3& high, double reach, F&& f) {
    const int x0 = columns.cellX(low[0] - reach), x1 = columns.cellX(high[0] + reach);
    const int y0 = columns.cellY(low[1] - reach), y1 = columns.cellY(high[1] + reach);
    for (int cx = x0; cx <= x1; ++cx) {
        const double gapX = columns.gapX(cx, low[0], high[0]);
        for (int cy = y0; cy <= y1; ++cy) {
            const double gapY = columns.gapY(cy, low[1], high[1]);
            const double rest = reach * reach - gapX * gapX - gapY * gapY;
            if (rest <= 0) continue;
            const double dz = std::sqrt(rest);
            const Columns::Span span = columns.between(columns.column(cx, cy), z, low[2] - dz, high[2] + dz);
            if (span.begin < span.end) f(span);
        }
    }
}

}  // namespace

void PairList::build(const Columns& ownedColumns, int owned, const Columns& ghostColumns, int ghosts,
                     const double* const position[3], const std::vector<unsigned char>& wall, double reach) {
    owned_ = owned;
    const int lanes = blockLanes();
    const int count = (owned + lanes - 1) / lanes;
    first_.assign(static_cast<std::size_t>(count) + 1, 0);
    for (auto& group : blocks_) group.clear();
    const double *x = position[0], *y = position[1], *z = position[2];
    const ListKernel& kernel = listKernel();
    std::size_t used = 0;

    for (int b = 0; b < count; ++b) {
        const int slot = b * lanes, inBlock = std::min(lanes, owned - slot);
        double px[8], py[8], pz[8];
        bool allWall = !wall.empty(), anyWall = false;
        for (int l = 0; l < lanes; ++l) {
            const int i = slot + std::min(l, inBlock - 1);
            px[l] = x[i], py[l] = y[i], pz[l] = z[i];
            if (!wall.empty()) allWall = allWall && wall[i], anyWall = anyWall || wall[i];
        }
        const Vec3 low(*std::min_element(px, px + lanes), *std::min_element(py, py + lanes), *std::min_element(pz, pz + lanes));
        const Vec3 high(*std::max_element(px, px + lanes), *std::max_element(py, py + lanes), *std::max_element(pz, pz + lanes));
        const auto append = [&](const double* cx, const double* cy, const double* cz, const unsigned char* skip, Columns::Span span,
                                int offset) {
            const auto candidates = static_cast<std::size_t>(span.end - span.begin) + 1;
            if (j_.size() < used + candidates) j_.resize(std::max(used + candidates, j_.size() + j_.size() / 2 + 1024));
            int* out = j_.data() + used;
            const int found = kernel.gather(px, py, pz, cx, cy, cz, span.begin, span.end, reach * reach, skip, out);
            if (offset)
                for (int k = 0; k < found; ++k) out[k] += offset;
            used += static_cast<std::size_t>(found);
        };
        const unsigned char* skip = allWall ? wall.data() : nullptr;
        forSpans(ownedColumns, z, low, high, reach, [&](Columns::Span span) { append(x, y, z, skip, span, 0); });
        const std::size_t interiorEntries = used;
        if (ghosts > 0)
            forSpans(ghostColumns, z + owned, low, high, reach, [&](Columns::Span span) {
                append(x + owned, y + owned, z + owned, skip ? skip + owned : nullptr, span, owned);
            });
        if (used > static_cast<std::size_t>(INT32_MAX))
            throw Failure(ExitCode::numerics, "the neighbour list of one rank exceeds 2^31 entries: use more ranks");
        first_[static_cast<std::size_t>(b) + 1] = static_cast<int>(used);

        if (!wall.empty() && !anyWall)
            for (auto k = static_cast<std::size_t>(first_[b]); k < used && !anyWall; ++k) anyWall = wall[j_[k]];
        blocks_[(used > interiorEntries ? boundary : interior) + (anyWall ? 1 : 0)].push_back(b);
    }
}

}  // namespace corpuscle::particles
