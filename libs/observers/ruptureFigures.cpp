#include "observers/ruptureFigures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "membrane/diagnostics.hpp"
#include "observers/cells.hpp"

namespace corpuscle::observers {

namespace {

// In the order in which the numbers travel between ranks.
constexpr std::array members{&Losses::bonds,        &Losses::triangles,  &Losses::holes,       &Losses::holeArea,
                             &Losses::holeRestArea, &Losses::bondStrain, &Losses::arealStrain, &Losses::tension,
                             &Losses::damage,       &Losses::tearLength};
static_assert(sizeof(Losses) == members.size() * sizeof(double), "a member is not named above");

Losses lossesOf(const coupling::Cell& cell) {
    const membrane::Membrane& m = cell.membrane;
    const membrane::Network& network = m.network();
    const bool broken = network.brokenTriangles() > 0;
    return {.bonds = static_cast<double>(network.brokenBonds()),
            .triangles = static_cast<double>(network.brokenTriangles()),
            .holes = broken ? static_cast<double>(network.rims().size()) : 0,
            .holeArea = broken ? network.holeArea(m.position) : 0,
            .holeRestArea = network.holeRestArea(),
            .bondStrain = membrane::maxBondStrain(network, m.position),
            .arealStrain = membrane::maxArealStrain(network, m.position),
            .tension = membrane::maxTension(network, m.laws(), m.position),
            .damage = m.maxDamage(),
            .tearLength = m.tearLength()};
}

std::vector<double> list(const Vec3& v) { return {v.data(), v.data() + 3}; }

}  // namespace

std::vector<double> FirstBreak::numbers() const {
    return {time, strain, bond, place[0], place[1], place[2], place0[0], place0[1], place0[2]};
}

FirstBreak FirstBreak::of(const double* n) { return {n[0], n[1], n[2], Vec3(n + 3), Vec3(n + 6)}; }

std::vector<Losses> losses(const coupling::Scene& scene) {
    const auto numbers = ofEachCell(scene, members.size(), [](const coupling::Cell& cell, double* out) {
        const Losses lost = lossesOf(cell);
        for (const auto member : members) *out++ = lost.*member;
    });
    std::vector<Losses> all(numbers.size());
    for (std::size_t c = 0; c < all.size(); ++c)
        for (std::size_t k = 0; k < members.size(); ++k) all[c].*members[k] = numbers[c][k];
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
