// Reads dictionaries as the programs do, many at once: for tests that compare the reader with the JSON schemas.
//
//     readDictionaries DIR      writes the schemas into DIR, then answers standard input line by line
//
// A line {"file": "system/mesh.yaml", "text": "..."} is answered by ["problem", ...], empty where the text is accepted.
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "observers/observers.hpp"
#include "packing/packSettings.hpp"
#include "simulation/caseSettings.hpp"
#include "simulation/dictionaries.hpp"
#include "simulation/readyCell.hpp"
#include "simulation/relaxSettings.hpp"

using namespace corpuscle;

namespace {

template <class T>
void readAs(const Node& node, Problems& problems) {
    read<T>(node, problems);
}

const std::map<std::string, std::function<void(const Node&, Problems&)>> readers{
    {"system/control.yaml", readAs<simulation::ControlSettings>},
    {"system/numerics.yaml", readAs<simulation::NumericsSettings>},
    {"system/mesh.yaml", readAs<simulation::MeshSettings>},
    {"system/pack.yaml", readAs<packing::PackSettings>},
    {"system/relax.yaml", readAs<simulation::RelaxSettings>},
    {"system/observers.yaml", readAs<observers::ObserversSettings>},
    {"constant/fluid.yaml", readAs<simulation::FluidSettings>},
    {"constant/membranes.yaml", readAs<simulation::MembranesSettings>},
    {"constant/bodies.yaml", readAs<bodies::BodiesSettings>},
    {"constant/contact.yaml", readAs<contact::ContactSettings>},
    {"constant/cells/cell.yaml", readAs<simulation::ReadyCell>},
    {"constant/flow.yaml", [](const Node& node, Problems& problems) { readChoice<sph::Flow>(node, problems); }}};

}  // namespace

int main(int argc, char* argv[]) {
    if (argc != 2) return 1;
    simulation::writeSchemas(argv[1]);
    for (std::string line; std::getline(std::cin, line);) {
        const nlohmann::json asked = nlohmann::json::parse(line);
        const std::string file = asked.at("file");
        nlohmann::json answer = nlohmann::json::array();
        Problems problems;
        const Node node = parseDictionary(asked.at("text"), file, problems);
        if (problems.empty()) readers.at(file)(node, problems);
        try {
            problems.throwIfAny();
        } catch (const CaseError& error) {
            for (const Problem& p : error.problems()) answer.push_back(p.text());
        }
        std::cout << answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
    }
    return 0;
}
