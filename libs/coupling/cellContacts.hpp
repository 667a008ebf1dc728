// Contact of the cells of a scene with each other, with themselves and with walls (contact/contacts.hpp): a term of
// their membranes' elasticity.
//
// A pair of cells is looked at by the lowest rank that holds both (where they are near each other there is one), a
// cell with itself and its images by its owner; forces go to all holders of a cell (holderSums.hpp). Contact with walls
// (contact/wallContact.hpp) is found by every holder of a cell. What a wall feels is the opposite.
//
// Nothing crosses on a way that freeTravel calls free, whatever the forces are: it is asked of every way that nodes go,
// from the beginning of a step to where forces are taken, and from there to its end.
#pragma once
#include <map>
#include <memory>

#include "boundary/walls.hpp"
#include "contact/contactSettings.hpp"
#include "contact/contacts.hpp"
#include "contact/wallContact.hpp"
#include "coupling/holderSums.hpp"
#include "coupling/nodeLayout.hpp"
#include "particles/particleSystem.hpp"

namespace corpuscle::coupling {

class CellContacts {
  public:
    // How nodes move. The rest is needed where images of the box slide (core/periodicity.hpp).
    struct Way {
        NodeVectors displacement;  // [m]
        double seconds = 0;        // that it takes
        double ago = 0;            // how long ago it began [s]; 0: it begins now
    };

    // walls: of the fluid; they must stay where they are.
    CellContacts(const contact::ContactSettings& settings, const boundary::Walls& walls);

    // Where nodes are now. way: how they may move before this is called again. Collective.
    void place(const Cells& cells, const NodeLayout& layout, const particles::ParticleSystem& system, const Way& way);

    // Of the places at `place`, of all cells that the rank holds. Collective among holders.
    void addForces(NodeVectors& f) const;                                          // N
    void addStiffness(double factor, const NodeVectors& u, NodeVectors& f) const;  // f += factor K u
    void addForcesAt(const NodeVectors& displacement, NodeVectors& f) const;       // nodes displaced from there [m]
    // Power of the forces on nodes beside images of others that slide, by the slide alone, nodes displaced [m] from
    // their places at `place`; this rank's part [W].
    double powerOfImages(const Periodicity& period, const NodeVectors& displacement) const;
    // What walls feel of the cells that this rank owns, nodes displaced [m] from their places at `place`.
    struct OnWall {
        int wall;           // its number
        Vec3 place, force;  // m, N
    };
    std::vector<OnWall> forcesOnWalls(const Cells& cells, int rank, const NodeVectors& displacement) const;

    // The largest fraction of a way from x that is free for all nodes of the scene. Collective.
    double freeTravel(const Cells& cells, const NodeLayout& layout, const particles::ParticleSystem& system,
                      const NodeVectors& x, const Way& way) const;
    // Where nodes are now, this rank's part [J].
    double energy(const Cells& cells, const particles::ParticleSystem& system) const;
    // -sum x f^T over membranes and walls that touch, where nodes are now [J]. Collective.
    Mat3 stresslet(const Cells& cells, const particles::ParticleSystem& system) const;

  private:
    static constexpr double spareOfReach = 0.5;  // by which cells may approach each other more than expected
    // Of one cell, its nodes numbered as in all cells.
    struct AtWall : contact::AtWall {
        std::size_t cell;
    };
    struct Known {
        int broken;
        std::shared_ptr<const contact::Surface> surface;
    };
    using Surfaces = std::vector<std::shared_ptr<const contact::Surface>>;
    Surfaces surfacesOf(const Cells& cells, std::map<const membrane::Network*, Known>& known) const;
    // Of where nodes are now: among cells, by this rank; with walls, by the owner of each cell.
    struct Now {
        contact::Contacts among;
        std::vector<AtWall> atWalls;
    };
    Now now(const Cells& cells, const particles::ParticleSystem& system) const;
    // Lists for cells as they are held.
    void list(contact::Contacts& contacts, const Cells& cells, const NodeVectors& x,
              const particles::ParticleSystem& system, const Way& way, const Surfaces& surfaces) const;
    // Whether the lists of `place` are of the cells that are held, with images where they are.
    bool isListed(const Cells& cells, const Periodicity& period) const;
    std::vector<AtWall> atWallsOf(const NodeLayout& layout, const NodeVectors& x, const Surfaces& surfaces) const;
    double freeOfWalls(const NodeLayout& layout, const NodeVectors& x, const NodeVectors& displacement) const;
    template <class Add>
    void addUp(NodeVectors& f, Add&& add) const;

    contact::ContactSettings settings_;
    const boundary::Walls& walls_;
    contact::Contacts contacts_;
    NodeLayout layout_;
    NodeVectors x_;                                    // at `place`
    std::vector<int> listed_;                          // numbers of the cells that lists are of
    Vec3 listedOffset_ = Vec3::Zero();                 // of images that slide, when lists were made
    std::map<const membrane::Network*, Known> known_;  // whole cells of a type share one
    Surfaces surfaces_;                                // of each held cell
    std::vector<AtWall> atWalls_;
    mutable HolderSums sums_;
};

}  // namespace corpuscle::coupling
