#include "observers/ruptureFigures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "membrane/diagnostics.hpp"
#include "observers/cells.hpp"

namespace corpuscle::observers {

namespace {

constexpr std::size_t lossNumbers = sizeof(Losses) / sizeof(double);

Losses lossesOf(const coupling::Cell& cell) {
    const membrane::Membrane& m = cell.membrane;
    const membrane::Network& network = m.network();
    const bool broken = network.brokenTriangles() > 0;
    double damage = 0;
    if (!m.damage().empty())
        for (const int t : network.wholeTriangles()) damage = std::max(damage, m.damage()[static_cast<std::size_t>(t)]);
    return {static_cast<double>(network.brokenBonds()),
            static_cast<double>(network.brokenTriangles()),
            broken ? static_cast<double>(network.rims().size()) : 0,
            broken ? network.holeArea(m.position) : 0,
            network.holeRestArea(),
            membrane::maxBondStrain(network, m.position),
            membrane::maxArealStrain(network, m.position),
            membrane::maxTension(network, m.laws(), m.position),
            damage};
}

std::vector<double> list(const Vec3& v) { return {v.data(), v.data() + 3}; }

}  // namespace

std::vector<double> FirstBreak::numbers() const {
    return {time, strain, bond, place[0], place[1], place[2], place0[0], place0[1], place0[2]};
}

FirstBreak FirstBreak::of(const double* n) { return {n[0], n[1], n[2], Vec3(n + 3), Vec3(n + 6)}; }

std::vector<Losses> losses(const coupling::Scene& scene) {
    std::vector<Losses> all;
    for (const auto& n : ofEachCell(scene, lossNumbers, [](const coupling::Cell&cell, std::size_t, double*out) {
             const Losses lost = lossesOf(cell);
             std::copy_n(&lost.bonds, lossNumbers, out);
         }))
        all.push_back({n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]});
    return all;
}

nlohmann::ordered_json figures(const Interior& in, const Losses& lost, const FirstBreak& first) {
    return {{"firstBreak_s", first.time},
            {"firstBreak_strain", first.strain},
            {"firstBreak_bond", first.bond},
            {"firstBreak_place_m", list(first.place)},
            {"firstBreak_stressFreePlace_m", list(first.place0)},
            {"bondsBroken", lost.bonds},
            {"trianglesLost", lost.triangles},
            {"holes", lost.holes},
            {"holeArea_m2", lost.holeArea},
            {"released", in.released},
            {"leaked", in.leaked},
            {"releasedVolume_m3", in.releasedVolume},
            {"haemolysisIndex_percent", in.haemolysisIndex()}};
}

std::string sentence(const Interior& in, const Losses& lost, const FirstBreak& first) {
    const auto um = [](const Vec3& x) {
        return fmt::format("({:.3f}, {:.3f}, {:.3f}) um", 1e6 * x[0], 1e6 * x[1], 1e6 * x[2]);
    };
    return fmt::format(
        "first break at strain {:.6g}, t = {}, bond {:.0f} at {}, {} on the stress-free cell; {:.0f} bonds and {:.0f} "
        "triangles lost, {:.0f} hole{} of {:.4g} um^2, {:.4g} fL released, haemolysis index {:.4g} %",
        first.strain, formatQuantity(first.time, unit::second), first.bond, um(first.place), um(first.place0),
        lost.bonds, lost.triangles, lost.holes, lost.holes == 1 ? "" : "s", 1e12 * lost.holeArea,
        1e18 * in.releasedVolume, in.haemolysisIndex());
}

}  // namespace corpuscle::observers
