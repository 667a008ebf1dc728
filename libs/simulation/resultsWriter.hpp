// Results for ParaView and renderCase: one stream for the fluid, one for each type of cell, in which the array `cell`
// has the number of each, one for each rigid body, and one for the rims of all holes once there are some. Walls stand
// in 0/walls.vtp.
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
    // To write the same times again from a state of this run: entries after `time` are removed. Collective.
    void goBack(const Ticker& ticker, const Time& time);
    void write(const coupling::Scene& scene, const Time& time);
    long written() const { return written_; }

  private:
    io::PolyData fluidPiece(const coupling::Scene& scene) const;
    Ticker ticker_;
    std::vector<std::string> fields_;
    io::VtkSeries fluid_;
    std::vector<io::VtkSeries> types_, bodies_;  // of cells
    std::optional<io::VtkSeries> holes_;         // none unless a membrane can rupture
    long written_ = 0;
};

// A membrane's surface with its arrays.
io::PolyData membranePiece(const membrane::Membrane& membrane, double spacing);

// The same of all cells of a type that this rank owns, one after another; the arrays alone where it owns none.
io::PolyData typePiece(const coupling::Scene& scene, std::size_t type);

// Adds the rims of a membrane's holes, each a closed line, with the numbers of the cell and, from 1 in the order of
// Network::rims(), of the hole: those of the observer rupture.
void addRims(const membrane::Membrane& membrane, io::PolyData& data);

// A rigid body's surface with its velocity; empty on ranks other than `writer`.
io::PolyData bodyPiece(const coupling::Scene& scene, const bodies::Body& body, bool writer);

// What lies around a fault, with all cells: streams `fault` and `fault_<type>`. Returns the file to open. Collective.
std::string writeFault(const Case& input, const coupling::Scene& scene, const Time& time, const Vec3& place);

}  // namespace corpuscle::simulation
