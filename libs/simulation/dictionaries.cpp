#include "simulation/dictionaries.hpp"

#include <fmt/format.h>

#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "contact/contactSettings.hpp"
#include "core/atomicFile.hpp"
#include "core/schemaJson.hpp"
#include "observers/observers.hpp"
#include "packing/packSettings.hpp"
#include "simulation/caseSettings.hpp"
#include "simulation/readyCell.hpp"
#include "simulation/relaxSettings.hpp"
#include "study/studySettings.hpp"

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

// A dictionary: its declared settings and its reader.
struct Known {
    std::string file;
    SchemaInfo info;
    std::function<void(const Node&, Problems&)> read;
};

template <class T>
Known knownAs(const std::string& file) {
    return {file, T::schema().info(), [](const Node& node, Problems& problems) { corpuscle::read<T>(node, problems); }};
}

const std::vector<Known>& known() {
    static const std::vector<Known> all{
        knownAs<ControlSettings>("system/control.yaml"),
        knownAs<NumericsSettings>("system/numerics.yaml"),
        knownAs<MeshSettings>("system/mesh.yaml"),
        knownAs<packing::PackSettings>("system/pack.yaml"),
        knownAs<RelaxSettings>("system/relax.yaml"),
        knownAs<observers::ObserversSettings>("system/observers.yaml"),
        knownAs<FluidSettings>("constant/fluid.yaml"),
        knownAs<MembranesSettings>("constant/membranes.yaml"),
        knownAs<bodies::BodiesSettings>("constant/bodies.yaml"),
        knownAs<contact::ContactSettings>("constant/contact.yaml"),
        {"constant/flow.yaml", flowInfo(),
         [](const Node& node, Problems& problems) { readChoice<sph::Flow>(node, problems); }},
        knownAs<study::StudySettings>("study.yaml")};
    return all;
}

// The shape of a ready cell is inserted when a case is read; here a dummy shape stands in for it.
void checkMesh(Node node, Problems& problems) {
    Node none;
    Node* cells = node.find("cells");
    for (Node& cell : (cells ? cells : &none)->items)
        if (cell.kind == Node::Kind::table && cell.find("cell") && !cell.find("shape")) {
            Problems ignored;
            cell.entries.emplace_back("shape", parseValue("{type: sphere, radius: 1 um}", "", ignored));
            std::erase_if(cell.entries, [](const Node::Entry& entry) { return entry.key == "cell"; });
        }
    read<MeshSettings>(node, problems);
}

std::string schemaText(const SchemaInfo& info) { return schemaOf(info).dump(2) + "\n"; }

// All schemas, by file name.
std::vector<std::pair<std::string, SchemaInfo>> schemas() {
    std::vector<std::pair<std::string, SchemaInfo>> all;
    for (const auto& [file, info] : dictionaries())
        all.emplace_back(std::filesystem::path(file).stem().string() + ".json", info);
    all.emplace_back("cell.json", readyCellInfo());
    return all;
}

}  // namespace

const std::vector<std::pair<std::string, SchemaInfo>>& dictionaries() {
    static const std::vector<std::pair<std::string, SchemaInfo>> all = [] {
        std::vector<std::pair<std::string, SchemaInfo>> found;
        for (const Known& one : known()) found.emplace_back(one.file, one.info);
        return found;
    }();
    return all;
}

void checkDictionary(const std::string& file, const Node& node, Problems& problems) {
    if (file.starts_with("constant/cells/")) {
        read<ReadyCell>(node, problems);
        return;
    }
    if (file == "system/mesh.yaml") return checkMesh(node, problems);
    std::vector<std::string> names;
    for (const Known& one : known()) {
        if (one.file == file) return one.read(node, problems);
        names.push_back(one.file);
    }
    problems.add({file, 0, 0}, "", fmt::format("there is no dictionary of this name.{}", didYouMean(file, names)));
}

namespace {

std::vector<Problem> faultsOf(const std::string& file, const std::string& text) {
    Problems found;
    try {
        const Node node = parseDictionary(text, file, found);
        found.throwIfAny();
        checkDictionary(file, node, found);
        found.throwIfAny();
    } catch (const CaseError& error) {
        return error.problems();
    }
    return {};
}

}  // namespace

void addNewProblems(const std::string& file, const std::string& before, const std::string& after, Problems& problems) {
    std::map<std::string, int> old;
    for (const Problem& problem : faultsOf(file, before)) ++old[problem.key + problem.message];
    for (const Problem& problem : faultsOf(file, after))
        if (old[problem.key + problem.message]-- <= 0) problems.add(problem.mark, problem.key, problem.message);
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
