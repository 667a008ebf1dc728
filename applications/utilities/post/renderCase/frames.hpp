// The content of a picture: the surfaces of a case at certain times. Results hold cells unwrapped across periodic
// faces; here each cell is moved as a whole, by box lengths, until the mean of its points lies in the box.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/place.hpp"
#include "io/polyData.hpp"
#include "particles/box.hpp"
#include "slice.hpp"
#include "streamlines.hpp"

namespace corpuscle {

struct Frame {
    double time = 0;                               // s
    std::optional<double> strain;                  // gammadot t; empty where the flow has no shear rate
    std::optional<double> stage;                   // of a protocol
    std::map<std::string, io::PolyData> surfaces;  // by the name of the type of cell or of the rigid body
    std::optional<Slice> slice;                    // slice of the fluid, if the fluid is shown
    std::vector<DrawnLine> streamlines;            // of the velocity at this time
};

// One time that the user asks for.
struct Wanted {
    enum class Kind {
        time,
        strain,
        stage,
        progress,
        first,
        latest
    } kind = Kind::time;  // progress: strain, else stage, else time
    double value = 0;
    std::string option;  // for messages: "-strain 9"
};

struct FrameChoice {
    std::string membrane;        // empty: all membranes
    std::vector<Wanted> wanted;  // for each, the nearest results; empty: `count` times at equal intervals
    int count = 4;               // 0: all times
    bool keepBroken = false;     // false: triangles marked `broken` are left out
};

// By the name of each type of cell that has `places` or a `table`: the places of its cells. The mesh of such a type in
// 0/ is centred on the origin.
using PlacesByName = std::map<std::string, std::vector<geometry::Place>>;

// The result streams of a case. Files are read on demand.
class Results {
  public:
    // Throws Failure(io) if there are neither results/*.pvd nor 0/*.vtp.
    explicit Results(const std::filesystem::path& caseDir);

    bool hasRun() const { return hasRun_; }  // false: there is only 0/
    bool hasFluid() const { return hasFluid_; }
    const std::vector<std::string>& surfaces() const { return surfaces_; }

    // `places`: for the meshes in 0/, used if nothing has run yet. Throws Failure: usage for times outside the results
    // or an unknown membrane, io for unreadable files.
    std::vector<Frame> frames(const FrameChoice& choice, const std::optional<particles::Box>& box,
                              const PlacesByName& places) const;
    // The particles at the time nearest to this one.
    io::PolyData fluidAt(double time) const;

  private:
    std::filesystem::path caseDir_;
    std::vector<std::string> surfaces_;
    bool hasRun_ = false, hasFluid_ = false;
};

}  // namespace corpuscle
