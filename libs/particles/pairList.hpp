// The neighbour list: one flat array of j for every block of consecutive particles i (as many as the pair loop has
// lanes).
//
// A particle j is in the list of a block if it lies within reach = support + skin of any particle of the block at the
// time of the build; the list is valid as long as no particle has moved more than skin/2 since.
//
// What a block lists:
// - particles of later blocks of this rank and their periodic images: the earlier of two blocks lists their pairs;
// - ghosts owned by other ranks, in every block that has them within reach;
// - last, images of the block's own particles, which get no reaction.
// The block's own particles are not listed, as the pair loop covers all pairs within a block. A block that consists of
// wall particles alone lists no wall particles: walls do not act on walls. Particles within the support at the time of
// the build come first, those that only the skin adds after them.
//
// Blocks are grouped by what they need: those without ghosts can be processed while the halo exchange is under way, and
// those with wall particles in the block or its list need the form of a law at walls.
#pragma once
#include <vector>

#include "particles/columns.hpp"
#include "particles/decomposition.hpp"
#include "particles/pairLoop.hpp"
#include "particles/particleStore.hpp"

namespace corpuscle::particles {

class PairList {
  public:
    // lanes: particles per block.
    explicit PairList(int lanes) : lanes_(lanes) {}
    int lanes() const { return lanes_; }

    enum Group { interior = 0, interiorAtWall = 1, boundary = 2, boundaryAtWall = 3, groups = 4 };
    static constexpr bool isAtWall(Group group) { return group == interiorAtWall || group == boundaryAtWall; }

    // position[3]: coordinates of the owned particles, sorted by `ownedColumns`, then of the ghosts, sorted by
    // `ghostColumns`. wall[k] != 0 for wall particles; empty if there are none. imageOf[g]: the owned particle that
    // ghost g is an image of, or -1. No ghost lies in the brick.
    void build(const Columns& ownedColumns, int owned, const Columns& ghostColumns, int ghosts,
               const double* const position[3], const std::vector<unsigned char>& wall, const std::vector<int>& imageOf,
               const Brick& brick, double support, double reach);

    PairView view() const { return {owned_, first_.data(), j_.data()}; }
    const std::vector<int>& blocks(Group group) const { return blocks_[group]; }
    int blockCount() const { return static_cast<int>(first_.size() / PairView::parts); }
    std::size_t entries() const { return j_.empty() ? 0 : static_cast<std::size_t>(first_.back()); }
    std::size_t bytes() const { return j_.capacity() * sizeof(int) + first_.capacity() * sizeof(int); }

  private:
    struct Candidates;
    double findRelative(const double* const position[3], int count, const Vec3& middle);
    std::size_t list(int slot, int stop, int h, const Candidates& c, std::size_t used,
                     const std::vector<unsigned char>& wall, const std::vector<int>& imageOf);

    int lanes_, owned_ = 0;
    std::vector<int> first_{0};
    AlignedVector<int> j_;
    AlignedVector<float> relative_[3];  // positions relative to the brick's middle; kept to reuse the memory
    std::vector<int> blocks_[groups];
    // near and far candidates of each of the blocks that share their candidates; kept to reuse the memory
    std::vector<int> found_[4];
};

}  // namespace corpuscle::particles
