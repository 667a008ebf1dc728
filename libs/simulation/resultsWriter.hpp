// Results for ParaView and renderCase: one stream for the fluid, one for each type of cell (its array `cell` contains
// the number of the cell), one for each rigid body, and one for the rims of all holes once there are any. Wall
// particles are in 0/walls.vtp.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "core/time.hpp"
#include "coupling/scene.hpp"
#include "io/vtkSeries.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

class ResultsWriter {
  public:
    ResultsWriter(const Case& input, const coupling::Scene& scene, const Time& start);
    bool due(const Time& time) { return ticker_.due(time); }
    const Ticker& ticker() const { return ticker_; }
    // Other settings, as edited while the case runs; the next result is that of the next multiple of the interval.
    void change(const WriteSettings& settings, const Time& time);
    // After a rollback: removes the entries after `time`, so that these times are written again. Collective.
    void goBack(const Ticker& ticker, const Time& time);
    void write(const coupling::Scene& scene, const Time& time);
    long written() const { return written_; }

  private:
    io::PolyData fluidPiece(const coupling::Scene& scene) const;
    std::vector<io::VtkSeries*> series();
    Ticker ticker_;
    std::vector<std::string> fields_;
    io::VtkSeries fluid_;
    std::vector<io::VtkSeries> types_, bodies_;  // one for each type of cell, one for each body
    std::optional<io::VtkSeries> holes_;         // empty unless a membrane can rupture
    long written_ = 0;
};

// A membrane's surface with its arrays.
io::PolyData membranePiece(const membrane::Membrane& membrane, double spacing);

// The same for all cells of a type that this rank owns, one after another; if it owns none, the arrays exist but are
// empty.
io::PolyData typePiece(const coupling::Scene& scene, std::size_t type);

// Adds the rims of a membrane's holes, each as a closed line with the numbers of the cell and of the hole. Holes are
// numbered from 1 in the order of Network::rims(), as by the observer `rupture`.
void addRims(const membrane::Membrane& membrane, io::PolyData& data);

// A rigid body's surface with its velocity; empty unless this rank is the `writer`.
io::PolyData bodyPiece(const coupling::Scene& scene, const bodies::Body& body, bool writer);

// Writes the particles around a fault, and all cells: streams `fault` and `fault_<type>`. Returns the file to open.
// Collective.
std::string writeFault(const Case& input, const coupling::Scene& scene, const Time& time, const Vec3& place);

}  // namespace corpuscle::simulation
