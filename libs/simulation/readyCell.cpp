#include "simulation/readyCell.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "simulation/cellFolder.hpp"

namespace corpuscle::simulation {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> folders(const Application& app) {
    std::vector<fs::path> all{app.caseDirectory() / "constant" / "cells"};
    if (const char* named = std::getenv("CORPUSCLE_CELLS")) {
        std::istringstream words(named);
        for (std::string word; std::getline(words, word, ':');)
            if (!word.empty()) all.emplace_back(word);
    }
    std::error_code ignored;
    if (const fs::path program = fs::read_symlink("/proc/self/exe", ignored); !program.empty())
        all.push_back(program.parent_path().parent_path() / "share" / "corpuscle" / "cells");
    all.emplace_back(sourceCellFolder);
    return all;
}

// What rank 0, the only one that reads the disk, has found: path and text of the file, and the names of all ready
// cells.
struct Found {
    std::string path, text, names;
};
Found find(const Application& app, const std::string& name) {
    Found found;
    if (app.communicator().isRoot())
        for (const fs::path& folder : folders(app)) {
            std::error_code ignored;
            for (const auto& entry : fs::directory_iterator(folder, ignored))
                if (entry.path().extension() == ".yaml") found.names += entry.path().stem().string() + ' ';
            const fs::path file = folder / (name + ".yaml");
            if (!found.path.empty() || !fs::is_regular_file(file, ignored)) continue;
            std::stringstream text;
            text << std::ifstream(file).rdbuf();
            found.path = file.string(), found.text = text.str();
        }
    const Communicator& ranks = app.communicator();
    return {ranks.broadcast(found.path), ranks.broadcast(found.text), ranks.broadcast(found.names)};
}

std::vector<std::string> sortedWords(const std::string& text) {
    std::vector<std::string> words;
    std::istringstream all(text);
    for (std::string word; all >> word;) words.push_back(word);
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    return words;
}

std::string typeOf(const Node& table) {
    const Node* type = table.kind == Node::Kind::table ? table.find("type") : nullptr;
    return type ? type->scalar : "";
}

void put(Node& table, const std::string& key, Node value) {
    if (Node* old = table.find(key))
        *old = std::move(value);
    else
        table.entries.emplace_back(key, std::move(value));
}

// Overrides values of `base` by those of `above`; a model of another type is replaced as a whole.
void layOver(Node& base, const Node& above) {
    const std::string type = typeOf(above);
    const bool both = base.kind == Node::Kind::table && above.kind == Node::Kind::table;
    if (!both || (!type.empty() && type != typeOf(base))) {
        base = above;
        return;
    }
    for (const auto& [key, value] : above.entries) {
        if (Node* old = base.find(key))
            layOver(*old, value);
        else
            base.entries.emplace_back(key, value);
    }
}

// The file's two tables; empty if the file is missing or invalid, with the reason in `problems`.
std::optional<Node> readReady(const Application& app, const Node& name, Problems& problems) {
    const Found found = find(app, name.scalar);
    if (found.path.empty()) {
        const std::vector<std::string> known = sortedWords(found.names);
        problems.add(name.mark, name.path,
                     "found '" + name.scalar + "', and there is no ready cell of this name; there " +
                         (known.empty() ? "is none" : "are: " + joinWords(known)) + "." +
                         didYouMean(name.scalar, known));
        return {};
    }
    const std::size_t before = problems.count();
    Node root = parseDictionary(found.text, found.path, problems);
    if (problems.count() != before) return {};
    for (const char* key : {"shape", "membrane"})
        if (!root.find(key))
            problems.add({found.path, 1, 1}, key, "is missing; a ready cell has 'shape' and 'membrane'");
    for (const auto& [key, value] : root.entries)
        if (key != "shape" && key != "membrane")
            problems.add(
                value.place(), key,
                "unknown key; a ready cell has 'shape' and 'membrane'." + didYouMean(key, {"shape", "membrane"}));
    if (problems.count() != before) return {};
    return root;
}

}  // namespace

const Schema<ReadyCell>& ReadyCell::schema() {
    static const Schema<ReadyCell> s =
        Schema<ReadyCell>("cell", "constant/cells/NAME.yaml: a ready cell, for 'cell: NAME' in system/mesh.yaml")
            .model("shape", &ReadyCell::shape, "its stress-free shape; axis along z")
            .table("membrane", &ReadyCell::membrane, "the laws of its membrane");
    return s;
}

bool namesReadyCells(const Node& mesh) {
    const Node* cells = mesh.kind == Node::Kind::table ? mesh.find("cells") : nullptr;
    return cells && std::any_of(cells->items.begin(), cells->items.end(),
                                [](const Node& cell) { return cell.kind == Node::Kind::table && cell.find("cell"); });
}

void insertReadyCells(const Application& app, Node& mesh, Node& membranes, Problems& problems) {
    if (!namesReadyCells(mesh)) return;
    std::map<std::string, Node> done;
    for (Node& cell : mesh.find("cells")->items) {
        const Node* const found = cell.kind == Node::Kind::table ? cell.find("cell") : nullptr;
        if (!found) continue;
        const Node name = *found;
        if (name.kind != Node::Kind::scalar || !isName(name.scalar)) continue;  // the reader reports it
        bool isAlone = true;
        for (const char* key : {"shape", "membrane"})
            if (const Node* other = cell.find(key)) {
                isAlone = false;
                problems.add(
                    other->place(), other->path,
                    std::string("given beside 'cell', which stands for it; remove one of them") +
                        (std::string(key) == "membrane" ? "; other laws for it go into constant/membranes.yaml, as "
                                                          "entry '" +
                                                              name.scalar + "'"
                                                        : ""));
            }
        if (!isAlone) continue;
        if (!done.contains(name.scalar)) {
            std::optional<Node> ready = readReady(app, name, problems);
            if (!ready) continue;
            Node laws = *ready->find("membrane");
            if (const Node* own = membranes.find(name.scalar)) layOver(laws, *own);
            laws.setPath(name.scalar);
            put(membranes, name.scalar, laws);
            done.emplace(name.scalar, *ready);
        }
        Node shape = *done.at(name.scalar).find("shape"), membrane = Node::word(name.scalar);
        shape.setPath(cell.path + ".shape");
        membrane.setPath(cell.path + ".membrane");
        membrane.mark = name.mark, membrane.keyMark = name.keyMark;
        std::erase_if(cell.entries, [](const Node::Entry& entry) { return entry.key == "cell"; });
        put(cell, "shape", std::move(shape));
        put(cell, "membrane", std::move(membrane));
    }
}

}  // namespace corpuscle::simulation
