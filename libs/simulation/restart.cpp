#include "simulation/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "simulation/placesTable.hpp"

namespace corpuscle::simulation {

namespace {

constexpr const char* settingsName = "origin/settings";
constexpr const char* meshFile = "system/mesh.yaml";
constexpr const char* membranesFile = "constant/membranes.yaml";
constexpr const char* bodiesFile = "constant/bodies.yaml";
constexpr const char* wayOut = "start from firstTime, or give the old value";

// Text packed into integers, the last one padded with zeros.
std::vector<std::int64_t> packed(const std::string& text) {
    std::vector<std::int64_t> words((text.size() + sizeof(std::int64_t) - 1) / sizeof(std::int64_t));
    std::memcpy(words.data(), text.data(), text.size());
    return words;
}
std::string unpacked(const std::vector<std::int64_t>& words) {
    std::string text(words.size() * sizeof(std::int64_t), '\0');
    std::memcpy(text.data(), words.data(), text.size());
    text.resize(std::min(text.find('\0'), text.size()));
    return text;
}

std::vector<double> flat(const std::vector<Vec3>& vectors) {
    std::vector<double> values;
    values.reserve(3 * vectors.size());
    for (const Vec3& v : vectors) values.insert(values.end(), v.data(), v.data() + 3);
    return values;
}
std::vector<std::int64_t> flat(const std::vector<Index3>& triangles) {
    std::vector<std::int64_t> values;
    for (const Index3& t : triangles) values.insert(values.end(), t.data(), t.data() + 3);
    return values;
}

// A value that follows from several settings.
struct Derived {
    std::string name;       // in the checkpoint
    std::string file, key;  // named in errors
    AtRestart policy;
    std::string value;
    std::string cure = wayOut;
};

std::vector<Derived> derivedValues(const Case& input) {
    const auto shown = [](double value, Dimension dimension) { return fmt::format("{} {}", value, dimension.si()); };
    std::vector<Derived> all;
    const bool fromRe = input.flow.densityFromRe;
    all.push_back({"density", fromRe ? "constant/flow.yaml" : "constant/fluid.yaml", fromRe ? "inertia" : "density",
                   AtRestart::fixed, shown(input.flow.density, unit::kilogramPerMetre3)});
    if (fromRe)
        all.back().cure =
            "start from firstTime, or keep the density of the checkpoint: 'inertia: physical' here and that density in "
            "constant/fluid.yaml";
    // Particles carry their viscosity where it varies.
    all.push_back({"viscosity", "constant/fluid.yaml", "viscosity",
                   input.varyingViscosity() ? AtRestart::fixed : AtRestart::noted,
                   shown(input.fluid.viscosity, unit::pascalSecond)});
    // Schemes that keep the same state between steps can continue each other's runs.
    all.push_back({"integrator", "system/numerics.yaml", "integrator", AtRestart::noted, input.numerics.integrator});
    if (input.flow.shearRate > 0)
        all.push_back({"shearRate", "constant/flow.yaml", "shear rate", AtRestart::noted,
                       shown(input.flow.shearRate, unit::perSecond)});
    return all;
}

// Axes are normalised, since only their directions are to be compared.
Node meshSettings(MeshSettings mesh) {
    for (CellTypeSettings& cell : mesh.cells) {
        cell.axis.normalize();
        for (PlaceSettings& place : cell.places) place.axis.normalize();
        if (cell.table) *cell.table += " with " + describePlaces(cell.placed);
    }
    for (BodyPlaceSettings& body : mesh.bodies) body.axis.normalize();
    return write(mesh);
}

Node settingsOf(const Case& input) {
    Node all;
    const auto dictionaries = restartDictionaries();
    for (const auto& [file, table] : input.effective) {
        const auto known = std::find_if(dictionaries.begin(), dictionaries.end(),
                                        [&, &name = file](const auto& entry) { return entry.first == name; });
        const Node settings = file == meshFile ? meshSettings(input.mesh) : table;
        Node kept = known == dictionaries.end() ? settings : withoutFree(known->second, settings);
        if (kept.kind != Node::Kind::table || !kept.entries.empty()) all.entries.emplace_back(file, std::move(kept));
    }
    Node derived;
    for (const Derived& value : derivedValues(input)) derived.entries.emplace_back(value.name, Node::word(value.value));
    all.entries.emplace_back("derived", std::move(derived));
    return all;
}

// Whether one integrator can continue from a checkpoint of the other.
bool keepTheSame(const std::string& integrator, const std::string& other) {
    const ModelTables<schemes::Scheme> defaults;
    const auto one = defaults.of(integrator), two = defaults.of(other);
    return one && two && one->traits().state == two->traits().state;
}

const Node& emptyTable() {
    static const Node empty;
    return empty;
}
const Node& tableOf(const Node& all, const std::string& key) {
    const Node* found = all.find(key);
    return found ? *found : emptyTable();
}

double spacingOf(const Node& all) {
    const Node* spacing = tableOf(all, "system/numerics.yaml").find("spacing");
    return spacing ? parseQuantity(spacing->scalar).value : 0;
}

std::string wordOf(const Node& table, const std::string& key) {
    const Node* word = table.find(key);
    return word ? word->scalar : std::string();
}

// Collects the errors and notes that follow from changes, by the policies of their settings.
class Verdict {
  public:
    Verdict(std::string checkpoint, Spacings spacings) : checkpoint_(std::move(checkpoint)), spacings_(spacings) {}

    void compare(const std::string& file, const FieldInfo& dictionary, const Node& before, const Node& now,
                 const std::string& prefix = {}) {
        for (const SettingChange& change : settingChanges(dictionary, before, now, spacings_))
            add(file, prefix + change.key, change.policy, change.before, change.now);
    }
    void add(const std::string& file, const std::string& key, AtRestart policy, const std::string& before,
             const std::string& now, const std::string& cure = wayOut) {
        if (policy == AtRestart::free || policy == AtRestart::resolved) return;
        if (std::find(seen_.begin(), seen_.end(), file + key) != seen_.end()) return;  // two cells with the same laws
        seen_.push_back(file + key);
        if (policy == AtRestart::fixed)
            problems.add({file, 0, 0}, key,
                         fmt::format("the case now has {}{}, but {} was written with {}; {}",
                                     key == "inertia" ? "a density of " : "", now, checkpoint_, before, cure));
        else
            notes.push_back(fmt::format("{}: {}: changed at the restart, from {} to {}", file, key, before, now));
    }
    Problems problems;
    std::vector<std::string> notes;

  private:
    std::string checkpoint_;
    Spacings spacings_;
    std::vector<std::string> seen_;
};

// Compares the laws of each cell, or the kind of each body, of the checkpoint and of the case.
void compareKinds(Verdict& verdict, const std::string& file, const FieldInfo& dictionary, const std::string& list,
                  const std::string& kindKey, const Node& before, const Node& now) {
    const Node *was = tableOf(before, meshFile).find(list), *is = tableOf(now, meshFile).find(list);
    if (!was || !is) return;
    const auto kindOf = [&](const Node& item) {
        const std::string kind = wordOf(item, kindKey);
        return kind.empty() ? wordOf(item, "name") : kind;
    };
    for (std::size_t i = 0; i < std::min(was->items.size(), is->items.size()); ++i) {
        const std::string kind = kindOf(is->items[i]);
        verdict.compare(file, dictionary, tableOf(tableOf(before, file), kindOf(was->items[i])),
                        tableOf(tableOf(now, file), kind), kind + ".");
    }
}

}  // namespace

std::vector<std::pair<std::string, FieldInfo>> restartDictionaries() {
    return {{"system/control.yaml", dictionaryField([] { return ControlSettings::schema().info(); })},
            {"system/numerics.yaml", dictionaryField([] { return NumericsSettings::schema().info(); })},
            {meshFile, dictionaryField([] { return MeshSettings::schema().info(); })},
            {"system/observers.yaml", dictionaryField([] { return observers::ObserversSettings::schema().info(); })},
            {"constant/fluid.yaml", dictionaryField([] { return FluidSettings::schema().info(); })},
            {"constant/flow.yaml", dictionaryField(sph::Flow::familyName)},
            {membranesFile, dictionaryField([] { return MembranesSettings::schema().info(); })},
            {bodiesFile, dictionaryField([] { return bodies::BodiesSettings::schema().info(); })},
            {"constant/contact.yaml", dictionaryField([] { return contact::ContactSettings::schema().info(); })}};
}

void writeOrigin(io::CheckpointWriter& file, const Case& input, const coupling::Scene& scene) {
    file.writeReplicated(settingsName, packed(emit(settingsOf(input))));
    for (const coupling::CellType& type : scene.cells.types()) {
        const std::string group = "origin/" + type.name + "/";
        file.writeReplicated(group + "nodes", flat(type.nodes));
        if (!type.stressFree.empty() && type.stressFree != type.nodes)
            file.writeReplicated(group + "stressFree", flat(type.stressFree));
        file.writeReplicated(group + "triangles", flat(type.triangles));
    }
    if (!scene.bodies) return;
    for (const bodies::Body& body : scene.bodies->all()) {
        const std::string group = "origin/" + body.name + "/";
        file.writeReplicated(group + "nodes", flat(body.solid.surface.nodes));
        file.writeReplicated(group + "triangles", flat(body.solid.surface.triangles));
    }
}

std::vector<std::string> compareSettings(const std::filesystem::path& checkpoint, const Case& input, MPI_Comm comm) {
    io::CheckpointReader file(comm, checkpoint);
    const std::string name = checkpoint.string();
    if (!file.has(settingsName))
        throw Failure(ExitCode::io, name +
                                        " was written by an earlier version, which did not note its settings there: it "
                                        "cannot be told whether the case is still the same. Start anew with "
                                        "'startFrom: firstTime'");
    Problems unreadable;
    const Node before = parseDictionary(unpacked(file.readReplicated<std::int64_t>(settingsName)), name, unreadable);
    unreadable.throwIfAny();
    const Node now = settingsOf(input);

    Verdict verdict(name, {spacingOf(before), spacingOf(now)});
    for (const auto& [dictionary, field] : restartDictionaries()) {
        if (dictionary == membranesFile)
            compareKinds(verdict, membranesFile,
                         dictionaryField([] { return membrane::MembraneSettings::schema().info(); }), "cells",
                         "membrane", before, now);
        else if (dictionary == bodiesFile)
            compareKinds(verdict, bodiesFile, dictionaryField([] { return bodies::BodySettings::schema().info(); }),
                         "bodies", "body", before, now);
        else
            verdict.compare(dictionary, field, tableOf(before, dictionary), tableOf(now, dictionary));
    }
    const Node& derived = tableOf(before, "derived");
    for (const Derived& value : derivedValues(input)) {
        const std::string was = wordOf(derived, value.name);
        AtRestart policy = value.policy;
        std::string cure = value.cure;
        if (value.name == "integrator" && !keepTheSame(was, value.value)) {
            policy = AtRestart::fixed;
            if (input.integratorChosen)
                cure = fmt::format(
                    "it is what 'automatic' stands for with the settings as they are now; write "
                    "'integrator: {}', or start from firstTime",
                    was);
        }
        FieldInfo field;
        field.type = "quantity";
        field.atRestart = policy;
        for (const SettingChange& change : settingChanges(field, Node::word(was), Node::word(value.value), {}))
            verdict.add(value.file, value.key, policy, change.before, change.now, cure);
    }
    input.throwIfAny(verdict.problems);
    return verdict.notes;
}

void compareMeshes(io::CheckpointReader& file, const std::filesystem::path& checkpoint, const Case& input,
                   const coupling::Scene& scene) {
    constexpr double slack = 1e-6;  // of the spacing
    Problems problems;
    const auto refuse = [&](const std::string& name, const std::string& what) {
        problems.add({"0/" + name + ".vtp", 0, 0}, "",
                     fmt::format("{}, not the mesh that {} was written with: the case was meshed again after it; start "
                                 "from firstTime, or put the old mesh back",
                                 what, checkpoint.string()));
    };
    const auto compare = [&](const std::string& name, const std::vector<Vec3>& nodes,
                             const std::vector<Index3>& triangles, const std::vector<Vec3>* stressFree) {
        const std::string group = "origin/" + name + "/";
        const auto farthest = [&](const std::vector<double>& before, const std::vector<Vec3>& now) {
            const std::vector<double> values = flat(now);
            double largest = 0;
            for (std::size_t k = 0; k < values.size(); ++k)
                largest = std::max(largest, std::abs(values[k] - before[k]));
            return largest;
        };
        const auto before = file.readReplicated<double>(group + "nodes");
        if (before.size() != 3 * nodes.size())
            return refuse(name, fmt::format("has {} nodes instead of {}", nodes.size(), before.size() / 3));
        if (file.readReplicated<std::int64_t>(group + "triangles") != flat(triangles))
            return refuse(name, "has other triangles");
        if (const double away = farthest(before, nodes); !(away <= slack * input.spacing()))
            return refuse(
                name, fmt::format("has nodes up to {} away from where they were", formatQuantity(away, unit::metre)));
        if (!stressFree) return;
        const auto rest = file.has(group + "stressFree") ? file.readReplicated<double>(group + "stressFree") : before;
        if (rest.size() != 3 * stressFree->size() || !(farthest(rest, *stressFree) <= slack * input.spacing()))
            refuse(name, "has, by 'stressFree' of constant/membranes.yaml, another stress-free shape");
    };
    for (const coupling::CellType& type : scene.cells.types())
        compare(type.name, type.nodes, type.triangles, &type.membrane->network().stressFree());
    if (scene.bodies)
        for (const bodies::Body& body : scene.bodies->all())
            compare(body.name, body.solid.surface.nodes, body.solid.surface.triangles, nullptr);
    input.throwIfAny(problems);
}

}  // namespace corpuscle::simulation
