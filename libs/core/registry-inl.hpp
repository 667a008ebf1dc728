// The templates of the registry; code that needs no model type is in registry.cpp.
#pragma once

namespace corpuscle {

template <class Family>
constexpr const char* usualModel() {
    if constexpr (requires { Family::usualModel; })
        return Family::usualModel;
    else
        return "";
}
// The model's name in `node`, checked against `known`; nothing (and one problem) when there is no valid one. usual: the
// model of a table without `type`; "": `type` is required.
std::optional<std::string> modelName(const Node& node, const std::string& family, const std::string& usual,
                                     const std::vector<std::string>& known, Problems& problems);
// The table with the model's settings: the node itself, or an empty table for a bare name.
Node modelSettings(const Node& node);
// `type: name` with the settings beside it, or the bare name when there are none.
Node modelNode(const std::string& name, Node settings);

template <class Family>
Registry<Family>::Registry() {
    families()[Family::familyName] = {Family::familyName, usualModel<Family>(), [this] {
                                          std::vector<ModelInfo> models;
                                          for (const auto& [name, entry] : entries_)
                                              models.push_back({name, entry.text, entry.settings()});
                                          return models;
                                      }};
}

template <class Family>
Registry<Family>& Registry<Family>::instance() {
    static Registry registry;
    return registry;
}

template <class Family>
void Registry<Family>::add(const std::string& name, Entry entry) {
    entries_[name] = std::move(entry);
}

template <class Family>
std::vector<std::string> Registry<Family>::names() const {
    std::vector<std::string> names;
    for (const auto& [name, entry] : entries_) names.push_back(name);
    return names;
}

template <class Family>
const typename Registry<Family>::Entry* Registry<Family>::find(const std::string& name) const {
    const auto found = entries_.find(name);
    return found == entries_.end() ? nullptr : &found->second;
}

template <class Family, class Model>
struct Registration {
    Registration(const std::string& name, const std::string& text) {
        Registry<Family>::instance().add(
            name, {text, [] { return Model::schema().info(); },
                   [](const Node& node, Problems& problems) -> std::shared_ptr<const Family> {
                       auto model = std::make_shared<Model>();
                       Model::schema().readInto(model.get(), node, problems, "type");
                       return model;
                   },
                   [](const Family& model) { return Model::schema().writeFrom(static_cast<const Model*>(&model)); }});
    }
};

template <class Family>
Codec<Choice<Family>> choiceCodec() {
    return {[](const Node& node, Choice<Family>& choice, Problems& problems) {
                const Registry<Family>& registry = Registry<Family>::instance();
                const auto name = modelName(node, Family::familyName, usualModel<Family>(), registry.names(), problems);
                if (!name) return;
                choice.name = *name;
                choice.model = registry.find(*name)->make(modelSettings(node), problems);
            },
            [](const Choice<Family>& choice) {
                if (!choice) return Node{};
                return modelNode(choice.name, Registry<Family>::instance().find(choice.name)->write(*choice.model));
            }};
}

template <class Family>
std::shared_ptr<const Family> ModelTables<Family>::of(const std::string& name) const {
    if (const auto found = models.find(name); found != models.end()) return found->second;
    const auto* entry = Registry<Family>::instance().find(name);
    Problems none;
    return entry ? entry->make(Node{}, none) : nullptr;
}

template <class Family>
std::vector<ModelTable<Family>> modelTables() {
    const Registry<Family>& registry = Registry<Family>::instance();
    std::vector<ModelTable<Family>> tables;
    for (const std::string& name : registry.names()) {
        const auto& entry = *registry.find(name);
        if (entry.settings().fields.empty()) continue;
        tables.push_back({name,
                          entry.text,
                          entry.settings,
                          {[name, make = entry.make](const Node& node, ModelTables<Family>& all, Problems& problems) {
                               if (const Node* type = node.find("type"))
                                   problems.add(type->place(), type->path,
                                                "unknown key 'type': the name of the table says which model it is for");
                               all.models[name] = make(node, problems);
                           },
                           [name, write = entry.write](const ModelTables<Family>& all) {
                               const std::shared_ptr<const Family> model = all.of(name);
                               return model ? write(*model) : Node{};
                           }}});
    }
    return tables;
}

// `type: name` with its settings, defaults included.
template <class Family>
Node writeChoice(const Choice<Family>& choice) {
    return choiceCodec<Family>().write(choice);
}

// One choice outside of any schema.
template <class Family>
Choice<Family> readChoice(const Node& node, Problems& problems) {
    Choice<Family> choice;
    choiceCodec<Family>().read(node, choice, problems);
    return choice;
}

}  // namespace corpuscle
