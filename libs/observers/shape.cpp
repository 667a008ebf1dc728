// Observer `shape`: deformation, orientation and rotation of each cell; one file for each type of cell, with a row for
// each of its cells at each output (sectionShape.hpp has the definitions).
//
// angleTurned grows without jumps: 2 pi is a whole tumble of a rigid cell, or a whole turn of a tank-treading membrane.
// treadPhase is how far the membrane is ahead of the shape: the angle of one node, which at rest is nearest to the main
// axis, about the centroid, less that of the main axis; near 0 for a rigid cell, growing by 2 pi with each turn of a
// tank-treading one. It jumps where a nearly round section changes axis.
//
// Angles are followed from one output to the next, and must therefore change by less than half a period between two;
// the material turns by no more than gammadot t, hence at most 1.5 strain between two outputs.
//
// Numbers to compare with: a rigid cell d, h, b = 8, 2.12, 1 um tumbles with the period 20.45/gammadot in unbounded
// Stokes flow (boundary elements, own computation of the project, three meshes, error below 0.05); spheroid of axis
// ratio r: 2 pi (r + 1/r)/gammadot (Jeffery 1922); sphere and its membrane in the limit of small Ca: 4 pi/gammadot.
#include <cmath>
#include <numbers>

#include "observers/cells.hpp"
#include "observers/observer.hpp"
#include "observers/sectionShape.hpp"

namespace corpuscle::observers {

namespace {

constexpr double largestStrainBetweenLooks = 1.5;

// The node nearest to the main axis, on its positive side.
int markerNode(const std::vector<Vec3>& nodes, const std::vector<Index3>& triangles, const ShearPlane& plane) {
    const SectionShape shape = sectionShape({nodes, triangles}, plane);
    Vec3 axis = Vec3::Zero();
    axis[0] = std::cos(shape.inclination);
    axis[plane.gradient] = std::sin(shape.inclination);
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const Vec3 r = nodes[n] - shape.centroid;
        const double along = r.dot(axis), off = (r - along * axis).squaredNorm();
        if (along > 0 && off < least) {
            least = off;
            best = static_cast<int>(n);
        }
    }
    return best;
}

class ShapeObservation : public Observation {
  public:
    ShapeObservation(std::vector<Table> tables, const Scene& scene)
        : Observation(std::move(tables)), angles_(scene.cells.count()) {
        plane_.gradient = scene.flow.gradient;
        for (const auto& marker : ofEachCell(scene, 1, [&](const coupling::Cell&cell, double*out) {
                 *out = markerNode(cell.membrane.initialPosition(), cell.membrane.network().triangles(), plane_);
             }))
            markers_.push_back(static_cast<std::size_t>(marker[0]));
    }

    bool leavesGaps() const override { return true; }
    std::vector<Row> observe(const Scene& scene, const Time&) override {
        auto measured = ofEachCell(scene, 11, [&](const coupling::Cell& cell, double* out) {
            const std::vector<Vec3>& x = cell.membrane.position;
            const SectionShape s = sectionShape(closedSurface(cell), plane_);
            const double turned = materialRotation(cell.membrane.initialPosition(), x, plane_);
            const std::size_t marker = markers_[static_cast<std::size_t>(cell.membrane.cell) - 1];
            const double phase = flowAngle(x[marker] - s.centroid, plane_) + s.inclination;
            const double values[] = {s.D12_extent, s.D12_inertia, s.inclination, turned,        phase,        s.length,
                                     s.height,     s.width,       s.centroid[0], s.centroid[1], s.centroid[2]};
            std::copy(std::begin(values), std::end(values), out);
        });
        for (std::size_t c = 0; c < measured.size(); ++c) {
            Angles& angles = angles_[c];
            double &turned = measured[c][3], &phase = measured[c][4];
            turned = followed(angles.turned, turned, 2 * std::numbers::pi);
            phase = followed(angles.phase, phase, std::numbers::pi);  // the main axis has no sign
            if (std::isfinite(turned)) angles.turned = turned;
            if (std::isfinite(phase)) angles.phase = phase;
        }
        return rowsByType(scene, 0, measured);
    }

    std::vector<double> state() const override {
        std::vector<double> all;
        for (const Angles& a : angles_) all.insert(all.end(), {a.turned, a.phase});
        return all;
    }

  protected:
    void setState(std::span<const double> saved) override {
        for (std::size_t c = 0; c < angles_.size(); ++c) angles_[c] = {saved[2 * c], saved[2 * c + 1]};
    }

  private:
    struct Angles {
        double turned = 0, phase = 0;  // at the last output
    };
    ShearPlane plane_;
    std::vector<std::size_t> markers_;  // of each cell of the scene
    std::vector<Angles> angles_;
};

struct ShapeObserver : Observer {
    static const Schema<ShapeObserver>& schema() {
        static const Schema<ShapeObserver> s =
            Schema<ShapeObserver>("shape", "deformation, orientation and rotation of each cell")
                .include<ObserverSettings>();
        return s;
    }
    std::string whyNot(const Subject& subject) const override {
        const double strain = every.kind == Interval::Kind::strain ? every.value
                              : every.kind == Interval::Kind::time ? every.value * subject.shearRate
                                                                   : 0;
        if (strain > largestStrainBetweenLooks)
            return "angles are followed from one look to the next: at most 1.5 strain may pass; give a smaller 'every'";
        return needsCells(subject);
    }
    std::vector<Table> tables(const SceneParts& parts) const override {
        std::vector<io::Column> columns{
            {"D12_extent", "", "deformation index |L - H|/(L + H) of length and height"},
            {"D12_inertia", "", "deformation index of the ellipsoid with the cell's tensor of inertia"},
            {"inclination", "rad", "angle of the main axis of the section against x, in (-pi/2, pi/2]"},
            {"angleTurned", "rad",
             "rotation of the material since the stress-free state, with the flow, without jumps"},
            {"treadPhase", "rad", "angle of one node of the membrane about the centroid less that of the main axis"},
            {"length", "m", "extent L along the main axis in the section with the shear plane"},
            {"height", "m", "extent H at right angles to it in the section"},
            {"width", "m", "extent along the vorticity axis"}};
        addVector(columns, "centroid", "m",
                  "coordinate of the centroid of the enclosed volume, not wrapped into the box (across faces whose "
                  "images slide it is)");
        std::vector<Table> all;
        for (const std::string& type : parts.cells) all.push_back({type, cellTable(columns)});
        return all;
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<ShapeObservation>(tables(SceneParts::of(scene)), scene);
    }
};

CORPUSCLE_REGISTER(Observer, ShapeObserver, "shape",
                   "deformation, orientation, tumbling and tank-treading of each cell");

}  // namespace
}  // namespace corpuscle::observers
