#include "core/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/quantityForms.hpp"

namespace corpuscle {

bool Range::contains(double v) const { return (lowOpen ? v > low : v >= low) && (highOpen ? v < high : v <= high); }

std::string Range::text(Dimension dimension) const {
    // The fewest digits that give the same number when read again.
    const auto shown = [&](double v) {
        if (v == 0 || dimension.isDimensionless()) return fmt::format("{}", v);
        int digits = 4;
        while (digits < 17 && parseQuantity(formatQuantity(v, dimension, digits)).value != v) ++digits;
        return formatQuantity(v, dimension, digits);
    };
    const bool hasLow = std::isfinite(low), hasHigh = std::isfinite(high);
    if (hasLow && hasHigh && !lowOpen && !highOpen) return shown(low) + " to " + shown(high);
    std::string text;
    if (hasLow) text = (lowOpen ? "greater than " : "at least ") + shown(low);
    if (hasHigh) text += (hasLow ? " and " : "") + std::string(highOpen ? "less than " : "at most ") + shown(high);
    return text;
}

std::string FieldInfo::example() const {
    if (!fallback.empty()) return fallback;
    if (type == "quantity" || type == "length") {
        static const std::vector<std::pair<Dimension, std::string>> examples{{unit::none, "1"},
                                                                             {unit::metre, "8 um"},
                                                                             {unit::second, "1e-6 s"},
                                                                             {unit::perSecond, "100 1/s"},
                                                                             {unit::metrePerSecond, "1 mm/s"},
                                                                             {unit::metrePerSecond2, "9.81 m/s^2"},
                                                                             {unit::kilogramPerMetre3, "1000 kg/m^3"},
                                                                             {unit::pascal, "1000 Pa"},
                                                                             {unit::pascalSecond, "1.2e-3 Pa s"},
                                                                             {unit::newton, "50 pN"},
                                                                             {unit::newtonPerMetre, "5e-6 N/m"},
                                                                             {unit::joule, "2e-19 J"},
                                                                             {unit::newtonSecondPerMetre, "5e-7 N s/m"},
                                                                             {unit::metre2PerSecond, "1e-6 m^2/s"}};
        for (const auto& [d, text] : examples)
            if (d == dimension) return text;
        return "1 " + dimension.si();
    }
    const std::string si = dimension.si();
    if (type == "vector")
        return si.empty() ? "[0, 0, 1]" : fmt::format("[1 {0}, 2 {0}, 3 {0}]", dimension == unit::metre ? "um" : si);
    if (type == "quantities") return si.empty() ? "[1, 2]" : fmt::format("[1 {0}, 2 {0}]", si);
    if (type == "integer") return "1";
    if (type == "boolean") return "true";
    if (type == "booleans") return "[true, true, false]";
    if (type == "integers") return "[1, 2, 3]";
    if (type == "interval") return "0.1 strain";
    if (type == "word or quantity" && !words.empty()) return words.front();
    if (type == "word" && !words.empty()) return words.front();
    if (type == "words") return fmt::format("[{}]", joinWords(words));
    if (type == "values") return "[0.1, 8 um]";
    return "";
}

std::string FieldInfo::description() const {
    const std::string si = dimension.si();
    const std::string limits = range.text(dimension).empty() ? "" : ", " + range.text(dimension);
    std::string what;
    if (type == "quantity")
        what = si.empty() ? "a number without unit" : "a quantity in " + si;
    else if (type == "quantities")
        what = si.empty() ? "a list of numbers" : "a list of quantities in " + si;
    else if (type == "integer")
        what = "a whole number";
    else if (type == "boolean")
        what = "true or false";
    else if (type == "word")
        what = fmt::format("one of {}", joinWords(words));
    else if (type == "word or quantity")
        what = fmt::format("{}, or a quantity in {}", joinWords(words), si);
    else if (type == "words")
        what = words.empty() ? "a list of names" : fmt::format("a list of {}", joinWords(words));
    else if (type == "name")
        what = "a name";
    else if (type == "text")
        what = "a text";
    else if (type == "values")
        what = "a list of values of any kind";
    else if (type == "vector")
        what = si.empty() ? "three numbers [x, y, z]" : "a vector [x, y, z] in " + si;
    else if (type == "integers")
        what = "three whole numbers";
    else if (type == "booleans")
        what = "three of true or false";
    else if (type == "length")
        what = "a length in m or in particle spacings (dx)";
    else if (type == "interval")
        what = "an interval in strain, time or steps, or never";
    else if (type == "table")
        what = "a table";
    else if (type == "list")
        what = "a list of tables";
    else if (type == "map")
        what = "a table of named tables";
    else if (type == "model")
        what = "a " + family;
    else
        what = "a table of named models, each a " + family;
    return what + limits + (alternative.empty() ? "" : ", or " + alternative);
}

const char* nameOf(AtRestart policy) {
    switch (policy) {
        case AtRestart::free:
            return "free";
        case AtRestart::noted:
            return "noted";
        case AtRestart::resolved:
            return "resolved";
        case AtRestart::fixed:
        case AtRestart::undeclared:
            break;
    }
    return "fixed";
}

void SchemaBase::declareAtRestart(AtRestart policy, const std::vector<std::string>& keys) {
    for (const std::string& key : keys) {
        const auto field =
            std::find_if(fields_.begin(), fields_.end(), [&](const Field& f) { return f.info.key == key; });
        if (field == fields_.end())
            throw std::logic_error("atRestart of '" + name_ + "' names '" + key + "', which is not declared before it");
        field->info.atRestart = policy;
    }
}

SchemaBase::SchemaBase(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}

SchemaInfo SchemaBase::info() const {
    SchemaInfo info{name_, text_, {}, exactlyOne_, atMostOne_};
    for (const Field& f : fields_) info.fields.push_back(f.info);
    return info;
}

FieldInfo SchemaBase::describe(std::string type, std::string key, std::string text, const FieldOptions& options,
                               Dimension dimension) {
    FieldInfo info;
    info.type = std::move(type);
    info.key = std::move(key);
    info.text = std::move(text);
    info.fallback = options.fallback;
    info.required = options.fallback.empty();
    info.range = options.range;
    info.dimension = dimension;
    if (info.key == "*") info.required = false;
    return info;
}

std::optional<Node> SchemaBase::writeOptional(std::optional<Node> node, const std::string& alternative) {
    if (!node && !alternative.empty()) return Node::word(alternative);
    return node;
}

bool SchemaBase::isWord(const Node& node, const std::string& word) {
    return !word.empty() && node.kind == Node::Kind::scalar && node.scalar == word;
}

void SchemaBase::eachEntry(const Node& node, Problems& problems,
                           const std::function<void(const std::string&, const Node&)>& entry) {
    if (node.kind != Node::Kind::table) {
        problems.add(node.place(), node.path, fmt::format("found {}; a table of names is expected", node.kindText()));
        return;
    }
    for (const auto& [key, value] : node.entries)
        if (!isName(key))
            problems.add(
                value.place(), value.path,
                fmt::format("'{}' is not a name: a letter, then letters, digits, '-' and '_'", shortened(key, 80)));
        else if (matches(key, reservedWords))
            problems.add(value.place(), value.path,
                         fmt::format("'{}' is not a name: YAML reads it as true, false or nothing; take another", key));
        else
            entry(key, value);
}

void SchemaBase::eachItem(const Node& node, Problems& problems, const std::function<void(const Node&)>& item) {
    if (node.kind != Node::Kind::list || !node.unit.empty()) {
        problems.add(
            node.place(), node.path,
            fmt::format("found {}; a list is expected: [{{...}}, {{...}}] or one '- ' for each item", node.kindText()));
        return;
    }
    for (const Node& i : node.items) item(i);
}

namespace {

std::string quotedList(const std::vector<std::string>& keys) { return fmt::format("'{}'", joinWords(keys, "', '")); }

// A message about a wrong scalar also names the word that is allowed in its place.
void readOr(const std::string& word, const Node& value, Problems& problems,
            const std::function<void(Problems&)>& read) {
    if (word.empty() || value.kind != Node::Kind::scalar) return read(problems);
    Problems own;
    read(own);
    try {
        own.throwIfAny();
    } catch (const CaseError& error) {
        for (const Problem& p : error.problems())
            problems.add(p.mark, p.key, fmt::format("{}, or {}", p.message, word));
    }
}

// Whether the keys of one entry stand in place of the entries' names, "type: shape" for "deformation: {type: shape}";
// this is reported as one problem.
bool lacksNames(const Node& table, const FieldInfo& entries, Problems& problems) {
    if (table.kind != Node::Kind::table || table.entries.empty()) return false;
    const Node* first = &table.entries.front().value;
    std::string key = table.entries.front().key;
    if (!entries.family.empty()) {
        key = "type";
        first = table.find(key);
        if (!first || first->kind != Node::Kind::scalar) return false;
    } else {
        const std::vector<FieldInfo> fields = entries.table().fields;
        for (const Node::Entry& entry : table.entries)
            if (std::none_of(fields.begin(), fields.end(), [&](const FieldInfo& f) { return f.key == entry.key; }))
                return false;
    }
    problems.add(first->place(), table.path,
                 fmt::format("'{0}' stands without the name that it belongs to: each entry has a name of its own, "
                             "'NAME: {{{0}: ...}}'. An entry is {1}",
                             key, entries.text));
    return true;
}

bool differOnlyInCapitals(const std::string& a, const std::string& b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

// The keys present, in the order of the file.
std::vector<const Node*> present(const Node& node, const std::vector<std::string>& keys) {
    std::vector<const Node*> found;
    for (const auto& [key, value] : node.entries)
        if (std::find(keys.begin(), keys.end(), key) != keys.end()) found.push_back(&value);
    return found;
}

}  // namespace

void SchemaBase::readInto(void* object, const Node& node, Problems& problems, const std::string& ignored) const {
    if (node.kind != Node::Kind::table) {
        problems.add(node.place(), node.path,
                     fmt::format("found {}; a table is expected ({})", node.kindText(), text_));
        return;
    }
    const std::size_t before = problems.count();
    const std::vector<std::string> misspelt = nameUnknown(node, ignored, problems);
    readFields(object, node, ignored, misspelt, problems);
    checkRules(node, misspelt, problems);
    if (problems.count() == before)
        for (const Check& check : checks_) check(object, node, problems);
}

// The field that takes all keys that are not declared otherwise; null: there is none.
const SchemaBase::Field* SchemaBase::rest() const {
    const auto found = std::find_if(fields_.begin(), fields_.end(), [](const Field& f) { return f.info.key == "*"; });
    return found == fields_.end() ? nullptr : &*found;
}

std::vector<std::string> SchemaBase::keys() const {
    std::vector<std::string> all;
    for (const Field& f : fields_)
        if (f.info.key != "*") all.push_back(f.info.key);
    return all;
}

// Adds a problem for each unknown key. Returns the known keys that the unknown ones resemble: these are not reported as
// missing as well.
std::vector<std::string> SchemaBase::nameUnknown(const Node& node, const std::string& ignored,
                                                 Problems& problems) const {
    std::vector<std::string> misspelt;
    if (rest()) return misspelt;
    const std::vector<std::string> known = keys();
    std::vector<std::string> absent;
    for (const std::string& k : known)
        if (!node.find(k)) absent.push_back(k);
    const std::string allowed = known.empty() ? "No key is allowed here" : fmt::format("Allowed: {}", joinWords(known));
    for (const Node::Entry& entry : node.entries) {
        const std::string& key = entry.key;
        if (key == ignored || std::find(known.begin(), known.end(), key) != known.end()) continue;
        std::string nearest, advice;
        if (misspelt.size() < 2 * Problems::mostShown) {
            const bool isGiven = std::any_of(known.begin(), known.end(), [&](const std::string& k) {
                return differOnlyInCapitals(k, key) && node.find(k);
            });
            if (!isGiven) nearest = nearestWord(key, absent);
            if (!nearest.empty()) {
                advice = fmt::format(" Did you mean '{}'?", nearest);
            } else if (nearest = nearestWord(key, known); !nearest.empty()) {
                const Mark& there = node.find(nearest)->place();
                advice = fmt::format(" Did you mean '{}'? It is given already{}.", nearest,
                                     there.line ? fmt::format(" in line {}", there.line) : "");
            }
        }
        misspelt.push_back(nearest);
        problems.add(entry.value.place(), entry.value.path,
                     fmt::format("unknown key '{}'.{} {}", shortened(key, 80), advice, allowed));
    }
    return misspelt;
}

void SchemaBase::readFields(void* object, const Node& node, const std::string& ignored,
                            const std::vector<std::string>& misspelt, Problems& problems) const {
    Node others;
    others.mark = node.mark;
    others.keyMark = node.keyMark;
    others.path = node.path;
    if (const std::vector<std::string> known = keys(); rest())
        for (const auto& [key, value] : node.entries)
            if (key != ignored && std::find(known.begin(), known.end(), key) == known.end())
                others.entries.emplace_back(key, value);
    for (const Field& f : fields_) {
        if (&f == rest()) {
            if (!lacksNames(others, f.info, problems)) f.read(object, others, problems);
        } else if (const Node* value = node.find(f.info.key)) {
            const bool isMap = f.info.type == "map" || f.info.type == "models";
            if (!isMap || !lacksNames(*value, f.info, problems))
                readOr(f.info.alternative, *value, problems, [&](Problems& own) { f.read(object, *value, own); });
        } else if (!f.info.fallback.empty()) {
            Node fallback = parseValue(f.info.fallback, node.mark.file, problems);
            fallback.keyMark = node.place();
            fallback.mark = node.place();
            fallback.setPath(node.path.empty() ? f.info.key : node.path + "." + f.info.key);
            f.read(object, fallback, problems);
        } else if (f.info.required && std::find(misspelt.begin(), misspelt.end(), f.info.key) == misspelt.end()) {
            const std::string example = f.info.example();
            problems.add(
                node.place(), node.path.empty() ? f.info.key : node.path + "." + f.info.key,
                fmt::format("missing: {}. Expected {}{}", f.info.text, f.info.description(),
                            example.empty() ? "" : fmt::format(", for example '{}: {}'", f.info.key, example)));
        }
    }
}

// Checks the rules on keys of which exactly one, or at most one, must be given.
void SchemaBase::checkRules(const Node& node, const std::vector<std::string>& misspelt, Problems& problems) const {
    const auto misspeltOneOf = [&](const std::vector<std::string>& keys) {
        return std::any_of(keys.begin(), keys.end(), [&](const auto& k) {
            return std::find(misspelt.begin(), misspelt.end(), k) != misspelt.end();
        });
    };
    for (const auto& keys : exactlyOne_) {
        const auto found = present(node, keys);
        if (found.empty() && !misspeltOneOf(keys))
            problems.add(node.place(), node.path,
                         fmt::format("one of {} is missing; give exactly one", quotedList(keys)));
        if (found.size() > 1)
            problems.add(found[1]->place(), found[1]->path, fmt::format("give exactly one of {}", quotedList(keys)));
    }
    for (const auto& keys : atMostOne_)
        if (const auto found = present(node, keys); found.size() > 1)
            problems.add(found[1]->place(), found[1]->path, fmt::format("give at most one of {}", quotedList(keys)));
}

Node SchemaBase::writeFrom(const void* object) const {
    Node table;
    for (const Field& f : fields_) {
        std::optional<Node> value = f.write(object);
        if (!value) continue;
        if (f.info.key == "*")
            for (auto& entry : value->entries) table.entries.push_back(std::move(entry));
        else
            table.entries.emplace_back(f.info.key, std::move(*value));
    }
    return table;
}

}  // namespace corpuscle
