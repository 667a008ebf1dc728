// Observer `section`: what passes through a disc: flow rate, haematocrits, cells; one file, section.csv. Several
// entries of this type look at several places, such as the branches of a vessel.
//
//     Q = sum_i V_i (u_i.n) w(s_i),   w = (1 + cos(2 pi s/b))/b for |s| < b/2, else 0
// symbol | meaning
// s      | distance of the particle from the plane of the disc, along its normal n [m]
// b      | `width` of the slab over which the flow is averaged [m]; the integral of w is 1. Where the tube is straight
//        | over a long distance, a wide slab has less noise
// i      | particles of all kinds but those of walls, within `radius` of the axis of the disc
//
// haematocrit           = sum over particles within cells of V w/sum of V w
// haematocrit_discharge = the same of V (u.n) w: the share of the cells in what flows
// cells                 = cells whose middle (the mean of their nodes) has passed since the start, those against the
//                         normal subtracted. Between two outputs a cell is taken to move straight on; it must move by
//                         less than half the box
//
// Numbers to compare with: the flow through a network of tubes (boundary/networkWalls.hpp); what flows in flows out.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/communicator.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "observers/cells.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

struct Disc {
    Vec3 centre, normal;
    double radius, width;  // [m]
};

class SectionObservation : public Observation {
  public:
    SectionObservation(std::vector<Table> tables, const Disc& disc, const Scene& scene)
        : Observation(std::move(tables)),
          disc_(disc),
          before_(static_cast<std::size_t>(scene.cells.count()), Vec3::Constant(nowhere)) {}

    bool leavesGaps() const override { return true; }  // nothing flows, or no particle is there
    std::vector<Row> observe(const Scene& scene, const Time&) override {
        const particles::ParticleStore& s = scene.store();
        const bool hasCells = scene.cells.count() > 0;
        std::vector<double> sums(4, 0.0);  // of V w and V (u.n) w, of all and of the fluid within cells
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (s.kindOf(i) == particles::Kind::wall) continue;
            const auto [along, across] = from(scene.system->periodicity().shortest(s.position(i) - disc_.centre));
            if (std::abs(along) >= 0.5 * disc_.width || across >= disc_.radius) continue;
            const double w = (1 + std::cos(2 * std::numbers::pi * along / disc_.width)) / disc_.width;
            const double volume = scene.mass(i) / s.density[i] * w, flow = volume * s.velocity(i).dot(disc_.normal);
            sums[0] += volume, sums[1] += flow;
            if (hasCells && s.side[i] > 0) sums[2] += volume, sums[3] += flow;
        }
        sums = Communicator(scene.system->comm()).sum(std::move(sums));
        const auto ratio = [](double a, double b) { return b == 0 ? std::numeric_limits<double>::quiet_NaN() : a / b; };
        std::vector<double> row{sums[1], ratio(sums[1], sums[0])};
        if (hasCells) {
            countCells(scene);
            row.insert(row.end(), {ratio(sums[2], sums[0]), ratio(sums[3], sums[1]), passed_});
        }
        return {{0, std::move(row)}};
    }
    std::vector<double> state() const override {
        std::vector<double> all{passed_};
        for (const Vec3& r : before_) all.insert(all.end(), r.data(), r.data() + 3);
        return all;
    }

  protected:
    void setState(std::span<const double> saved) override {
        passed_ = saved[0];
        for (std::size_t c = 0; c < before_.size(); ++c) before_[c] = Vec3::Map(saved.data() + 1 + 3 * c);
    }

  private:
    static constexpr double nowhere = std::numeric_limits<double>::infinity();  // before the first output

    // Distance from the plane of the disc, and from its axis, of a point r from its centre.
    std::pair<double, double> from(const Vec3& r) const {
        const double along = r.dot(disc_.normal);
        return {along, (r - along * disc_.normal).norm()};
    }
    void countCells(const Scene& scene) {
        const auto middles = ofEachCell(scene, 3, [](const coupling::Cell& cell, double* out) {
            Vec3 sum = Vec3::Zero();
            for (const Vec3& x : cell.membrane.position) sum += x;
            Vec3::Map(out) = sum / static_cast<double>(cell.membrane.position.size());
        });
        const Periodicity& period = scene.system->periodicity();
        for (std::size_t c = 0; c < middles.size(); ++c) {
            const Vec3 r = period.shortest(Vec3::Map(middles[c].data()) - disc_.centre), last = before_[c];
            before_[c] = r;
            const double start = last.dot(disc_.normal), end = r.dot(disc_.normal);
            bool jumps = !std::isfinite(start);  // to another image of the disc
            for (int k = 0; k < 3; ++k)
                jumps = jumps || (period.lengths()[k] > 0 && std::abs(r[k] - last[k]) > 0.5 * period.lengths()[k]);
            if (jumps || (start < 0) == (end < 0)) continue;
            if (from(last + start / (start - end) * (r - last)).second < disc_.radius) passed_ += end < 0 ? -1 : 1;
        }
    }

    Disc disc_;
    double passed_ = 0;
    std::vector<Vec3> before_;  // middle of each cell from the centre of the disc, at the last output
};

struct SectionObserver : Observer {
    Vec3 centre = Vec3::Zero(), normal = Vec3::UnitX();
    double radius = 0;
    Length width;

    static const Schema<SectionObserver>& schema() {
        static const Schema<SectionObserver> s =
            Schema<SectionObserver>("section", "flow rate, haematocrit and cells through a disc")
                .include<ObserverSettings>()
                .vector("centre", &SectionObserver::centre, unit::metre, "of the disc, from the middle of the box")
                .vector("normal", &SectionObserver::normal, unit::none, "the direction that counts as forwards",
                        {.fallback = "[1, 0, 0]"})
                .quantity("radius", &SectionObserver::radius, unit::metre, "of the disc; larger than the vessel there",
                          {.range = positive})
                .length("width", &SectionObserver::width,
                        "of the slab along the normal over which the flow is averaged",
                        {.fallback = "6 dx", .range = positive})
                .check([](const SectionObserver& of, const Node& node, Problems& problems) {
                    if (of.normal.isZero())
                        problems.add(node.find("normal")->place(), node.path + ".normal",
                                     "found a direction without length; give one such as [1, 0, 0]");
                });
        return s;
    }
    std::vector<Table> tables(const SceneParts& parts) const override {
        std::vector<io::Column> columns{{"flowRate", "m3_s", "volume through the disc per time, along its normal"},
                                        {"meanVelocity", "m_s", "flow rate over the area of the fluid in the disc"}};
        if (!parts.cells.empty())
            columns.insert(columns.end(),
                           {{"haematocrit_tube", "", "volume of the fluid within cells over that of all, in the slab"},
                            {"haematocrit_discharge", "", "flow rate of the fluid within cells over that of all"},
                            {"cells", "", "cells that have passed since the start, those backwards subtracted"}});
        return {{"section", std::move(columns)}};
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        const Disc disc{scene.fluidBox.middle() + centre, normal.normalized(), radius, width.metres(scene.spacing)};
        const double room = scene.fluidBox.size().dot(disc.normal.cwiseAbs());
        if (disc.width > room * (1 + 1e-9))
            throw Failure(ExitCode::invalidCase,
                          fmt::format("system/observers.yaml: width: found {} for an observer of type section, but the "
                                      "box is {} long along its normal; give at most that",
                                      formatQuantity(disc.width, unit::metre), formatQuantity(room, unit::metre)));
        return std::make_unique<SectionObservation>(tables(SceneParts::of(scene)), disc, scene);
    }
};

CORPUSCLE_REGISTER(Observer, SectionObserver, "section", "flow rate, haematocrit and cells through a disc");

}  // namespace
}  // namespace corpuscle::observers
