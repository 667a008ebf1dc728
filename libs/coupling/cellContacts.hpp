// Contact of the cells of a scene with each other, with themselves and with walls (contact/contacts.hpp): a term of
// the elasticity of their membranes.
//
// Contact of two cells is computed by the lowest rank that holds both (cells near each other have a common holder),
// contact of a cell with itself and its own images by its owner; forces are sent to all holders of a cell
// (holderSums.hpp). Contact with walls (contact/wallContact.hpp) is computed by every holder of a cell; the force on
// the wall is the opposite of that on the node.
//
// Surfaces do not cross along a motion that freeTravel reports as free, whatever the forces are. It is called for every
// motion of the nodes: from the beginning of a step to the positions where forces are evaluated, and from there to the
// end of the step.
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
    // A motion of the nodes. Its times are needed if images of the box slide (core/periodicity.hpp).
    struct Way {
        NodeVectors displacement;  // [m]
        double seconds = 0;        // duration of the motion
        double ago = 0;            // how long ago the motion began [s]; 0: it begins now
    };

    // walls: of the fluid; kept by reference, they must not move in memory.
    CellContacts(const contact::ContactSettings& settings, const boundary::Walls& walls);

    // Finds the contacts at the present positions of the nodes. way: how nodes are expected to move before the next
    // call. Collective.
    void place(const Cells& cells, const NodeLayout& layout, const particles::ParticleSystem& system, const Way& way);

    // At the positions of the last call of `place`, for all cells that the rank holds. Collective among holders.
    void addForces(NodeVectors& f) const;                                          // N
    void addStiffness(double factor, const NodeVectors& u, NodeVectors& f) const;  // f += factor K u
    void addForcesAt(const NodeVectors& displacement, NodeVectors& f) const;  // with nodes displaced from there [m]
    // Power of the contact forces on sliding images by their slide velocity alone, with nodes displaced [m] from their
    // positions at `place`; this rank's part [W].
    double powerOfImages(const Periodicity& period, const NodeVectors& displacement) const;
    // Forces on walls from the cells that this rank owns, with nodes displaced [m] from their positions at `place`.
    struct OnWall {
        int wall;           // its number
        Vec3 place, force;  // position of the node [m], force on the wall [N]
    };
    std::vector<OnWall> forcesOnWalls(const Cells& cells, int rank, const NodeVectors& displacement) const;

    // The largest fraction of a motion from x that is free for all nodes of the scene. Collective.
    double freeTravel(const Cells& cells, const NodeLayout& layout, const particles::ParticleSystem& system,
                      const NodeVectors& x, const Way& way) const;
    // Energy of contact at the present positions of the nodes, this rank's part [J].
    double energy(const Cells& cells, const particles::ParticleSystem& system) const;
    // -sum x f^T over the contacts among membranes and with walls, at the present positions [J]. Collective.
    Mat3 stresslet(const Cells& cells, const particles::ParticleSystem& system) const;

  private:
    // Spare length of the lists, over the reach of the law: how much more than expected cells may approach each other.
    static constexpr double spareOfReach = 0.5;
    // A node of one cell at a wall; `node` is its number among the nodes of all held cells (NodeLayout).
    struct AtWall : contact::AtWall {
        std::size_t cell;  // index of the cell
    };
    // The surface made of the whole triangles of a network, and Network::changes() then.
    struct Known {
        long changes;
        std::shared_ptr<const contact::Surface> surface;
    };
    using Surfaces = std::vector<std::shared_ptr<const contact::Surface>>;
    Surfaces surfacesOf(const Cells& cells, std::map<const membrane::Network*, Known>& known) const;
    // Contacts at the present positions: those among cells that this rank computes, those of its own cells with walls.
    struct Now {
        contact::Contacts among;
        std::vector<AtWall> atWalls;
    };
    Now now(const Cells& cells, const particles::ParticleSystem& system) const;
    // Makes the lists for the cells that the rank holds now.
    void list(contact::Contacts& contacts, const Cells& cells, const NodeVectors& x,
              const particles::ParticleSystem& system, const Way& way, const Surfaces& surfaces) const;
    // Whether the lists of `place` are still for the cells that the rank holds and for the same offset of the images.
    bool isListed(const Cells& cells, const Periodicity& period) const;
    std::vector<AtWall> atWallsOf(const NodeLayout& layout, const NodeVectors& x, const Surfaces& surfaces) const;
    double freeOfWalls(const NodeLayout& layout, const NodeVectors& x, const NodeVectors& displacement) const;
    template <class Add>
    void addUp(NodeVectors& f, Add&& add) const;

    contact::ContactSettings settings_;
    const boundary::Walls& walls_;
    contact::Contacts contacts_;
    NodeLayout layout_;
    NodeVectors x_;                                    // positions at `place`
    std::vector<int> listed_;                          // numbers of the cells in the lists
    Vec3 listedOffset_ = Vec3::Zero();                 // offset of sliding images when the lists were made
    std::map<const membrane::Network*, Known> known_;  // unbroken cells of a type share one surface
    Surfaces surfaces_;                                // of each held cell
    std::vector<AtWall> atWalls_;
    mutable HolderSums sums_;
};

}  // namespace corpuscle::coupling
