// What a picture shows: the surfaces of a case at some times. Cells in a periodic box are unwrapped in the results;
// here each cell is moved as a whole, by box lengths, until the mean of its points lies in the box.
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

namespace corpuscle {

struct Frame {
    double time = 0;                               // s
    std::optional<double> strain;                  // gammadot t; empty where the flow has no shear rate
    std::optional<double> stage;                   // of a protocol
    std::map<std::string, io::PolyData> surfaces;  // by name of the type of cells or of the rigid body
    std::optional<Slice> slice;                    // of the fluid, where it is shown
};

// One wanted time of the results.
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
    std::string membrane;        // empty: all there are
    std::vector<Wanted> wanted;  // the nearest results are taken; empty: `count` at equal distances in time
    int count = 4;               // 0: all
    bool keepBroken = false;     // triangles marked `broken` are left out otherwise
};

// Of types of cells that are placed by a list: where the mesh in 0/, which stands around the origin, is put.
using PlacesByName = std::map<std::string, std::vector<geometry::Place>>;

// The streams of a case. Files are read when asked for.
class Results {
  public:
    // Throws Failure(io) when there is neither results/*.pvd nor 0/*.vtp.
    explicit Results(const std::filesystem::path& caseDir);

    bool hasRun() const { return hasRun_; }  // false: only 0/ is there
    bool hasFluid() const { return hasFluid_; }
    const std::vector<std::string>& surfaces() const { return surfaces_; }

    // `places` of the meshes in 0/, where nothing has run. Throws Failure: usage for times outside the results or an
    // unknown membrane, io for unreadable files.
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
