// Length of an implicit step that is to end where bonds break.
//
// Within a step of length d, nodes move with constant velocity from x^n to x^n + d v. An element of a membrane breaks
// at the time after the beginning of the step at which its excess by the rupture law (membrane/ruptureLaw.hpp) becomes
// positive. A step may end at any time between that of the first break and the deadline: the latest end at which, in
// each cell,
//     nothing should have broken for longer than w,   w = max(1e-3 times the length asked for, 1e-4/rate)
//     or no more elements should have broken than the share s of the bonds that the cell has lost before
//     or no excess should be greater than the law tolerates (a law that weakens the sheet before it breaks)
// All of them break at its end. The first condition resolves the first breaks of a cell in time; by the second one, a
// tear of N bonds takes some ln(N)/s steps however long it is, and an element breaks late by the time in which the tear
// grows by the share s.
//
// v depends on d, since the velocity of a membrane that relaxes decreases during the step. The step is therefore
// repeated with other lengths until it ends between the two times. Lengths follow from the middle between them in the
// last two steps by the secant method, and stay between those of steps that ended before the first break and those that
// ended after the deadline.
//
// symbol | meaning                                        | unit
// rate   | rate of the flow (sph/flow.hpp)                | 1/s
// w      | resolution of breaks in time                   | s
// s      | 0.05                                           | -
#pragma once
#include <limits>

#include "coupling/immersed.hpp"

namespace corpuscle::implicit {

constexpr double never = std::numeric_limits<double>::infinity();

struct BreakTimes {
    double first = never, deadline = never;  // from the beginning of the step [s]
};

// First break and deadline, both looked for up to `horizon` [s] after the beginning of the step; a deadline beyond the
// horizon is `never`. The nodes are at x*, `begun` after the beginning [s]; velocity: of the nodes during the step;
// resolution: w [s]. Collective.
BreakTimes findBreaks(const coupling::Immersed& immersed, MPI_Comm comm, double begun,
                      const coupling::Immersed::Vectors& velocity, double horizon, double resolution);

class BreakSearch {
  public:
    // asked: length of the step if nothing breaks [s].
    BreakSearch(double asked, double rate);

    double resolution() const { return resolution_; }  // w [s]
    double length() const { return length_; }          // of the step to be tried now [s]
    double horizon() const { return shortestAfter_ == never ? length_ : shortestAfter_; }  // of findBreaks [s]
    // Takes the breaks in a step of length(). Returns true if this step is the one to be made, and otherwise sets
    // length() for another one.
    bool accepts(const BreakTimes& breaks);
    bool isShortened() const { return shortestAfter_ != never; }  // below the length asked for
    // Whether bonds break that no step could be made to end at closely enough.
    bool isCoarse() const { return isCoarse_; }

  private:
    static constexpr int mostTries = 10;
    double resolution_, length_;
    double longestBefore_ = 0, shortestAfter_ = never;  // lengths of steps that ended before the first break and after
                                                        // the deadline
    double lastLength_ = 0, lastGap_ = 0;               // of the step tried before: d, aim - d; 0: none
    int tries_ = 0;
    bool isCoarse_ = false;
};

}  // namespace corpuscle::implicit
