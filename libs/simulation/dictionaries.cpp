#include "simulation/dictionaries.hpp"

#include <nlohmann/json.hpp>

#include "contact/contactSettings.hpp"
#include "core/atomicFile.hpp"
#include "core/schemaJson.hpp"
#include "observers/observers.hpp"
#include "packing/packSettings.hpp"
#include "simulation/caseSettings.hpp"
#include "simulation/readyCell.hpp"
#include "simulation/relaxSettings.hpp"

namespace corpuscle::simulation {
namespace {

// constant/flow.yaml is one model: `type` with its settings beside it.
SchemaInfo flowInfo() {
    FieldInfo type;
    type.key = "type";
    type.type = "word";
    type.text = "what drives the fluid; the settings of that [flow](#flow) stand beside it";
    type.words = Registry<sph::Flow>::instance().names();
    SchemaInfo info;
    info.name = "flow";
    info.text = "constant/flow.yaml: what drives the fluid";
    info.fields.push_back(type);
    return info;
}

std::string schemaText(const SchemaInfo& info) { return schemaOf(info).dump(2) + "\n"; }

// All, by the file's name.
std::vector<std::pair<std::string, SchemaInfo>> schemas() {
    std::vector<std::pair<std::string, SchemaInfo>> all;
    for (const auto& [file, info] : dictionaries())
        all.emplace_back(std::filesystem::path(file).stem().string() + ".json", info);
    all.emplace_back("cell.json", readyCellInfo());
    return all;
}

}  // namespace

const std::vector<std::pair<std::string, SchemaInfo>>& dictionaries() {
    static const std::vector<std::pair<std::string, SchemaInfo>> all{
        {"system/control.yaml", ControlSettings::schema().info()},
        {"system/numerics.yaml", NumericsSettings::schema().info()},
        {"system/mesh.yaml", MeshSettings::schema().info()},
        {"system/pack.yaml", packing::PackSettings::schema().info()},
        {"system/relax.yaml", RelaxSettings::schema().info()},
        {"system/observers.yaml", observers::ObserversSettings::schema().info()},
        {"constant/fluid.yaml", FluidSettings::schema().info()},
        {"constant/membranes.yaml", MembranesSettings::schema().info()},
        {"constant/bodies.yaml", bodies::BodiesSettings::schema().info()},
        {"constant/contact.yaml", contact::ContactSettings::schema().info()},
        {"constant/flow.yaml", flowInfo()}};
    return all;
}

nlohmann::ordered_json schemaOf(const SchemaInfo& info) {
    return info.name == "flow" ? jsonSchemaOfModel(info.name, info.text, sph::Flow::familyName) : jsonSchema(info);
}

SchemaInfo readyCellInfo() { return ReadyCell::schema().info(); }

std::vector<std::filesystem::path> writeSchemas(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> written;
    for (const auto& [name, info] : schemas()) {
        written.push_back(folder / name);
        writeFileAtomically(written.back(), schemaText(info));
    }
    return written;
}

void refreshSchemas(const Application& app) {
    if (!app.communicator().isRoot()) return;
    for (const auto& [name, info] : schemas()) {
        const std::filesystem::path path = app.path(".schema") / name;
        const std::string text = schemaText(info);
        try {
            if (!std::filesystem::exists(path) || readFile(path) != text) writeFileAtomically(path, text);
        } catch (const std::exception&) {
            return;
        }
    }
}

}  // namespace corpuscle::simulation
