#include "simulation/foreignKeys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "simulation/dictionaries.hpp"

namespace corpuscle::simulation {

namespace {

struct Habit {
    const char* file;
    std::vector<std::string> keys;
    const char* instead;
};

constexpr const char* control = "system/control.yaml";
constexpr const char* numerics = "system/numerics.yaml";
constexpr const char* mesh = "system/mesh.yaml";
constexpr const char* fluid = "constant/fluid.yaml";
constexpr const char* flow = "constant/flow.yaml";
constexpr const char* step =
    "the time step follows from its limits; 'implicit: {step: 0.05}' of system/numerics.yaml is the largest strain of "
    "one step, 'safety' the factor of the explicit limits";

const std::vector<Habit>& habits() {
    static const std::vector<Habit> all{
        {control, {"deltaT", "dt", "timestep", "timeStep", "maxCo", "maxDeltaT", "adjustTimeStep"}, step},
        {numerics, {"deltaT", "dt", "timestep", "timeStep", "maxCo", "maxDeltaT", "adjustTimeStep"}, step},
        {control,
         {"writeInterval", "writeControl", "dump", "dumpInterval", "outputInterval"},
         "'write: {strain: 0.5}' or 'write: {time: 1 ms}' says how often results are written, its 'keep' how many of "
         "them stay"},
        {control, {"stopAt"}, "a run ends at 'endStrain' or 'endTime'"},
        {control,
         {"steps", "nSteps", "maxSteps", "run"},
         "a run ends at 'endStrain' or 'endTime'; for a few steps alone start the solver with '-steps 5'"},
        {control, {"startTime"}, "'startFrom' is latestTime, firstTime or a time, for example 'startFrom: 1 ms'"},
        {fluid,
         {"nu", "kinematicViscosity"},
         "'viscosity' is the dynamic one, mu = rho nu, for example 'viscosity: 1e-3 Pa s'"},
        {fluid, {"mu", "eta", "dynamicViscosity"}, "write 'viscosity', for example 'viscosity: 1e-3 Pa s'"},
        {fluid, {"rho", "rho0"}, "write 'density', for example 'density: 1000 kg/m^3'"},
        {numerics,
         {"dx", "resolution"},
         "write 'spacing', the distance between particles, for example 'spacing: 0.5 um'"},
        {numerics,
         {"h", "smoothingLength"},
         "the kernel has its support radius, for example 'kernel: {type: wendlandC2, support: 2.4 dx}'"},
        {mesh, {"box", "boxSize", "bounds"}, "write 'domain: {size: [20 um, 20 um, 20 um]}'"},
        {flow, {"gammaDot", "gammadot", "rate"}, "write 'shearRate', for example 'shearRate: 100 1/s', or 'Ca'"}};
    return all;
}

// What to write in place of a key of another program; empty if the key is not known.
std::string insteadOf(const std::string& file, const std::string& key) {
    for (const Habit& habit : habits())
        if (habit.file == file && std::find(habit.keys.begin(), habit.keys.end(), key) != habit.keys.end())
            return habit.instead;
    return {};
}

// The other dictionary that has a key, which was found at the top level of `file`; empty if there is none.
std::string belongsIn(const std::string& file, const std::string& key) {
    for (const auto& [other, info] : dictionaries())
        if (other != file && std::any_of(info.fields.begin(), info.fields.end(),
                                         [&](const FieldInfo& field) { return field.key == key; }))
            return other;
    return {};
}

}  // namespace

void throwWithKeysInstead(const Problems& problems) {
    try {
        problems.throwIfAny();
    } catch (const CaseError& error) {
        Problems told;
        for (const Problem& p : error.problems()) {
            const std::string key = p.key.substr(p.key.rfind('.') + 1);  // npos + 1 is 0
            const bool isUnknown = p.message.starts_with("unknown key");
            const std::string instead = isUnknown ? insteadOf(p.mark.file, key) : "",
                              other = isUnknown && key == p.key ? belongsIn(p.mark.file, key) : "";
            told.add(p.mark, p.key,
                     p.message + (!instead.empty() ? ". In its place: " + instead
                                  : !other.empty() ? fmt::format(". '{}' belongs in {}", key, other)
                                                   : ""));
        }
        told.addUncounted(error.more());
        told.throwIfAny();
    }
}

}  // namespace corpuscle::simulation
