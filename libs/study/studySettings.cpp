#include "study/studySettings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/units.hpp"

namespace corpuscle::study {
namespace {

struct End {
    double value = 0;
    std::string unit;
};

// A number with the unit that follows it, as text.
std::optional<End> endOf(const std::string& text) {
    try {
        parseQuantity(text);
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
    const std::size_t blank = text.find(' ');
    return End{std::stod(text.substr(0, blank)), blank == std::string::npos ? "" : text.substr(blank + 1)};
}

const std::vector<std::string>& endsOf(const ParameterSettings& p) { return p.range ? *p.range : *p.logRange; }

void checkRange(const ParameterSettings& p, const Node& node, Problems& problems) {
    const Node& given = *node.find(p.range ? "range" : "logRange");
    const std::vector<std::string>& ends = endsOf(p);
    const auto complain = [&](const std::string& message) { problems.add(given.mark, given.path, message); };
    if (ends.size() != 2)
        return complain(fmt::format("found {}; two ends are expected, as in [1 1/s, 1000 1/s]", given.kindText()));
    const auto low = endOf(ends[0]), high = endOf(ends[1]);
    if (!low || !high)
        complain(fmt::format("'{}' is not a number or a quantity", low ? ends[1] : ends[0]));
    else if (low->unit != high->unit)
        complain(fmt::format("found '{}' and '{}'; write both ends in the same unit", ends[0], ends[1]));
    else if (low->value >= high->value)
        complain(fmt::format("'{}' is not below '{}'", ends[0], ends[1]));
    else if (p.logRange && low->value <= 0)
        complain(fmt::format("'{}' is not above zero, and the logarithm of a range needs that", ends[0]));
}

void checkKeys(const ParameterSettings& p, const Node& node, Problems& problems) {
    const Node* given = node.find(p.key ? "key" : "keys");
    if (!given) return;
    const std::vector<std::string> keys = p.allKeys();
    if (keys.empty()) problems.add(given->mark, given->path, "found no keys; name at least one");
    for (std::size_t k = 0; k < keys.size(); ++k) try {
            parseOverride(keys[k] + "=0");
        } catch (const Failure&) {
            problems.add(k < given->items.size() ? given->items[k].mark : given->mark, given->path,
                         fmt::format("found '{}'; write FILE:/path, such as constant/flow.yaml:/Ca or "
                                     "system/mesh.yaml:/cells/0/edge",
                                     keys[k]));
        }
}

void checkParameter(const ParameterSettings& p, const Node& node, Problems& problems) {
    checkKeys(p, node, problems);
    if (p.values && p.values->empty() && node.find("values"))
        problems.add(node.find("values")->mark, node.find("values")->path, "found no values; name at least one");
    if (p.values) {
        std::set<std::string> seen;
        for (const std::string& value : *p.values)
            if (!seen.insert(value).second)
                problems.add(node.find("values")->mark, node.find("values")->path,
                             fmt::format("'{}' stands twice; keep one", value));
        if (p.count && node.find("count"))
            problems.add(node.find("count")->mark, node.find("count")->path,
                         "found beside 'values', which are as many as they are; remove it");
    }
    if (p.range || p.logRange) checkRange(p, node, problems);
}

void checkMoment(const std::optional<std::string>& text, const char* key, const Node& node, Problems& problems) {
    if (!text || !node.find(key)) return;
    try {
        Moment::parse(*text);
    } catch (const std::invalid_argument&) {
        problems.add(node.find(key)->mark, node.find(key)->path,
                     fmt::format("found '{}', which is no time and no strain; write '0.2 s' or '5 strain'", *text));
    }
}

void checkFollowers(const StudySettings& study, const Node& node, Problems& problems) {
    const Node* table = node.find("parameters");
    if (!table) return;
    std::vector<std::string> leaders;
    for (const auto& [name, p] : study.parameters)
        if (!p.with) leaders.push_back(name);
    for (const auto& [name, p] : study.parameters) {
        if (!p.with) continue;
        const Node& given = *table->find(name)->find("with");
        const auto leader = study.parameters.find(*p.with);
        if (leader == study.parameters.end() || leader->second.with)
            problems.add(given.mark, given.path,
                         fmt::format("found '{}'; name a parameter that has no 'with' of its own: {}.{}", *p.with,
                                     joinWords(leaders), didYouMean(*p.with, leaders)));
        else if (p.levels() != leader->second.levels())
            problems.add(given.mark, given.path,
                         fmt::format("'{}' has {} values and '{}' has {}; both need the same number", name, p.levels(),
                                     *p.with, leader->second.levels()));
    }
}

// Reports a key that two parameters set, or a parameter and `set`, or that lies within another: only the last setting
// would have an effect.
void checkSameKeys(const StudySettings& study, const Node& node, Problems& problems) {
    const auto isWithin = [](const std::string& inner, const std::string& outer) {
        return inner == outer || inner.starts_with(outer + "/");
    };
    std::vector<std::pair<std::string, std::string>> seen;  // key, and what sets it
    const auto note = [&](const std::string& key, const std::string& who, const Mark& mark, const std::string& place) {
        for (const auto& [other, what] : seen)
            if (isWithin(key, other) || isWithin(other, key))
                problems.add(
                    mark, place,
                    fmt::format("'{}' is set by {} too ('{}'); one of them would have no effect", key, what, other));
        seen.emplace_back(key, who);
    };
    const Node* set = node.find("set");
    for (std::size_t k = 0; set && k < study.set.size(); ++k)
        if (const std::string& change = study.set[k]; change.find('=') != std::string::npos)
            note(change.substr(0, change.find('=')), "'set'", k < set->items.size() ? set->items[k].mark : set->mark,
                 "set");
    const Node* table = node.find("parameters");
    for (const auto& [name, p] : study.parameters)
        if (const Node* given = table ? table->find(name) : nullptr)
            for (const std::string& key : p.allKeys())
                note(key, fmt::format("the parameter '{}'", name), given->place(), given->path);
}

void checkSampling(const StudySettings& study, const Node& node, Problems& problems) {
    std::vector<std::string> names;
    std::vector<std::size_t> levels;
    for (const auto& [name, p] : study.parameters)
        if (!p.with) names.push_back(name), levels.push_back(p.levels());
    if (const Node* table = node.find("parameters"); table && study.parameters.empty())
        problems.add(table->place(), "parameters", "found none; a study varies at least one");
    if (!study.sampling || names.empty()) return;
    const Node* sampling = node.find("sampling");
    if (const std::string refusal = study.sampling->refusal(names, levels); !refusal.empty())
        problems.add(sampling ? sampling->mark : node.find("parameters")->place(), "sampling", refusal);
}

}  // namespace

std::vector<std::string> ParameterSettings::allKeys() const {
    if (key) return {*key};
    return keys.value_or(std::vector<std::string>{});
}

std::size_t ParameterSettings::levels() const {
    return values ? values->size() : static_cast<std::size_t>(count.value_or(0));
}

std::string ParameterSettings::value(double u) const {
    if (values)
        return (
            *values)[std::min(static_cast<std::size_t>(u * static_cast<double>(values->size())), values->size() - 1)];
    const End low = *endOf(endsOf(*this)[0]), high = *endOf(endsOf(*this)[1]);
    double part = u;
    if (const std::size_t n = levels(); n > 0)
        part = n == 1 ? 0 : std::floor(u * static_cast<double>(n)) / static_cast<double>(n - 1);
    if (levels() > 0 && part == 0) return endsOf(*this)[0];  // the ends as they were written
    if (levels() > 0 && part == 1) return endsOf(*this)[1];
    const double number =
        logRange ? low.value * std::pow(high.value / low.value, part) : low.value + part * (high.value - low.value);
    // As few digits as give the number to within 1 % of the distance to the next value, since the text becomes part of
    // the case's name.
    const std::size_t n = levels();
    const double ratio = logRange ? high.value / low.value : 0;
    const double step = n < 2      ? 1e-4 * std::abs(number)
                        : logRange ? number * std::expm1(std::log(ratio) / static_cast<double>(n - 1))
                                   : (high.value - low.value) / static_cast<double>(n - 1);
    std::string shown;
    for (int digits = logRange ? 4 : 6; digits <= 17; ++digits) {
        shown = fmt::format("{:.{}g}", number, digits);
        if (std::abs(std::stod(shown) - number) <= 0.01 * step) break;
    }
    return shown + (low.unit.empty() ? "" : " " + low.unit);
}

const Schema<ParameterSettings>& ParameterSettings::schema() {
    static const Schema<ParameterSettings> s =
        Schema<ParameterSettings>("study parameter", "a parameter of a study: where it stands and its values")
            .text("key", &ParameterSettings::key,
                  "where it stands in a case, FILE:/path, such as constant/flow.yaml:/Ca")
            .values("keys", &ParameterSettings::keys, "several such places, which all get the same value")
            .exactlyOneOf({"key", "keys"})
            .values("values", &ParameterSettings::values, "its values, as they are written in the dictionary")
            .values("range", &ParameterSettings::range, "the two ends of its range, such as [0.1, 1]")
            .values("logRange", &ParameterSettings::logRange,
                    "the two ends of a range of which the logarithm is cut into equal parts, such as [1 1/s, 1000 1/s]")
            .exactlyOneOf({"values", "range", "logRange"})
            .integer("count", &ParameterSettings::count,
                     "of values in the range, both ends among them; absent: any value (latinHypercube)",
                     {.range = between(1, 100000)})
            .name("with", &ParameterSettings::with,
                  "another parameter: both take their first values together, then their second ones, ...")
            .check(checkParameter);
    return s;
}

std::optional<Moment> ResultSettings::first() const {
    return from ? std::optional(Moment::parse(*from)) : std::nullopt;
}
std::optional<Moment> ResultSettings::last() const { return to ? std::optional(Moment::parse(*to)) : std::nullopt; }

std::string ResultSettings::meaning() const {
    const std::optional<Moment> moment = from ? first() : last();
    const char* along = moment && moment->column == "time_s" ? ", a time [s]"
                        : moment                             ? ", a strain"
                                                             : ", a strain, or a time [s] without shear";
    const bool isHalf = !from && !statistic->isOfWholeRun();
    return fmt::format("{} of {} of {}{}{}{}", statistic->text(), column, table,
                       from     ? " from " + *from
                       : isHalf ? " in the second half of the run"
                                : "",
                       to ? " to " + *to : "", statistic->isAlong() ? along : "");
}

const Schema<ResultSettings>& ResultSettings::schema() {
    static const Schema<ResultSettings> s =
        Schema<ResultSettings>("study result", "a number that is taken from the table of an observer in each case")
            .text("table", &ResultSettings::table, "OBSERVER/FILE under postProcessing, without .csv")
            .text("column", &ResultSettings::column, "of the table; of several cells the mean is taken at each time")
            .model("statistic", &ResultSettings::statistic, "which number of the series in time", {.fallback = "last"})
            .text("from", &ResultSettings::from, "beginning of the part that is used, as a strain or time")
            .text("to", &ResultSettings::to, "end of the part that is used, as a strain or time")
            .check([](const ResultSettings& result, const Node& node, Problems& problems) {
                checkMoment(result.from, "from", node, problems);
                checkMoment(result.to, "to", node, problems);
            });
    return s;
}

const Schema<StudySettings>& StudySettings::schema() {
    static const Schema<StudySettings> s =
        Schema<StudySettings>("study", "study.yaml: a parameter study, of cases that are made from one template")
            .text("template", &StudySettings::templateCase, "the case that is varied; a path from this file")
            .text("cases", &StudySettings::cases, "the folder of the cases; a path from this file",
                  {.fallback = "cases"})
            .map("parameters", &StudySettings::parameters, "what is varied, by any name")
            .model("sampling", &StudySettings::sampling, "how values of several parameters are put together",
                   {.fallback = "grid"})
            .values("set", &StudySettings::set,
                    "what is different from the template in all cases, each FILE:/path=value", {.fallback = "[]"})
            .words("programs", &StudySettings::programs, {},
                   "what is run in each case, in this order; absent: the mesh utilities and the solver that the "
                   "template needs")
            .integer("jobs", &StudySettings::jobs, "cases at a time; absent: as many as cores allow",
                     {.range = between(1, 10000)})
            .integer("ranks", &StudySettings::ranks, "MPI ranks of each solver",
                     {.fallback = "1", .range = between(1, 100000)})
            .map("results", &StudySettings::results, "what is collected of each case, by any name", {.fallback = "{}"})
            .check(checkFollowers)
            .check(checkSameKeys)
            .check(checkSampling)
            .check([](const StudySettings& study, const Node& node, Problems& problems) {
                const Node* table = node.find("results");
                for (const auto& [name, result] : study.results)
                    if (table && (study.parameters.contains(name) || name == "case" || name == "status"))
                        problems.add(table->find(name)->place(), "results." + name,
                                     "a parameter or a column of summary.csv has this name already; take another one");
            })
            .check([](const StudySettings& study, const Node& node, Problems& problems) {
                const Node* set = node.find("set");
                for (std::size_t k = 0; set && k < study.set.size(); ++k) try {
                        parseOverride(study.set[k]);
                    } catch (const Failure& failure) {
                        problems.add(set->mark, "set", std::string(failure.what()).substr(5));
                    }
            });
    return s;
}

}  // namespace corpuscle::study
