// Schema<T>: the fields of T in the order of declaration. The work is done on type-erased fields in settings.cpp; only
// the access to the members is a template.
#pragma once
#include <algorithm>
#include <type_traits>
#include <utility>

namespace corpuscle {

// How a value of type M is read from and written to a node. `read` leaves the value alone when it finds a problem.
template <class M>
struct Codec {
    std::function<void(const Node&, M&, Problems&)> read;
    std::function<Node(const M&)> write;
};

namespace codec {
Codec<double> quantity(Dimension dimension, Range range);
Codec<std::vector<double>> quantities(Dimension dimension, Range range);
Codec<long> integer(Range range);
Codec<bool> boolean();
Codec<std::string> word(std::vector<std::string> allowed);
Codec<std::vector<std::string>> words(std::vector<std::string> allowed);  // empty: any names
Codec<std::string> name();
Codec<std::string> text();
Codec<std::vector<std::string>> values();  // of any kind, as YAML in one line
Codec<std::string> wordOrQuantity(const std::vector<std::string>& allowed, Dimension dimension, Range range);
Codec<Vec3> vector(Dimension dimension, Range range);
Codec<Index3> integers(Range range);
Codec<std::array<bool, 3>> booleans();
Codec<Length> length(Range range);
Codec<Interval> interval(Range range);
}  // namespace codec

class SchemaBase {
  public:
    SchemaBase(std::string name, std::string text);
    SchemaInfo info() const;
    // `ignored`: a key that is read elsewhere ("type" of a model).
    void readInto(void* object, const Node& node, Problems& problems, const std::string& ignored = {}) const;
    Node writeFrom(const void* object) const;

  protected:
    struct Field {
        FieldInfo info;
        std::function<void(void*, const Node&, Problems&)> read;
        std::function<std::optional<Node>(const void*)> write;  // nothing: the key is absent
    };
    using Check = std::function<void(const void*, const Node&, Problems&)>;

    void declareAtRestart(AtRestart policy, const std::vector<std::string>& keys);
    static FieldInfo describe(std::string type, std::string key, std::string text, const FieldOptions& options,
                              Dimension dimension = {});
    static std::optional<Node> writeOptional(std::optional<Node> node, const std::string& alternative);
    static bool isWord(const Node& node, const std::string& word);
    // Calls entry(key, value) for all entries of a table of free names.
    static void eachEntry(const Node& node, Problems& problems,
                          const std::function<void(const std::string&, const Node&)>& entry);
    static void eachItem(const Node& node, Problems& problems, const std::function<void(const Node&)>& item);

  private:
    const Field* rest() const;
    std::vector<std::string> keys() const;
    std::vector<std::string> nameUnknown(const Node& node, const std::string& ignored, Problems& problems) const;
    void readFields(void* object, const Node& node, const std::string& ignored,
                    const std::vector<std::string>& misspelt, Problems& problems) const;
    void checkRules(const Node& node, const std::vector<std::string>& misspelt, Problems& problems) const;

  protected:
    std::string name_, text_;
    std::vector<Field> fields_;
    std::vector<std::vector<std::string>> exactlyOne_, atMostOne_;
    std::vector<Check> checks_;
};

template <class Family>
struct Choice;
template <class Family>
Codec<Choice<Family>> choiceCodec();  // registry.hpp
template <class Family>
struct ModelTables;
// The settings table of one model of a family.
template <class Family>
struct ModelTable {
    std::string name, text;
    std::function<SchemaInfo()> settings;
    Codec<ModelTables<Family>> codec;
};
template <class Family>
std::vector<ModelTable<Family>> modelTables();  // registry.hpp

template <class T>
class Schema : public SchemaBase {
  public:
    using SchemaBase::SchemaBase;
    using Options = FieldOptions;
    using Str = std::string;
    template <class M>
    using Maybe = std::optional<M>;

    // A number with a unit of this dimension; without any unit when the dimension is unit::none.
    Schema& quantity(const Str& key, double T::*m, Dimension d, const Str& text, const Options& o = {}) {
        return add(describe("quantity", key, text, o, d), m, codec::quantity(d, o.range));
    }
    Schema& quantity(const Str& key, Maybe<double> T::*m, Dimension d, const Str& text, const Options& o = {}) {
        return add(describe("quantity", key, text, o, d), m, codec::quantity(d, o.range));
    }
    // The alternative word leaves the member empty.
    Schema& quantityOr(const Str& word, const Str& key, Maybe<double> T::*m, Dimension d, const Str& text,
                       const Options& o = {}) {
        return addOr(word, describe("quantity", key, text, o, d), m, codec::quantity(d, o.range));
    }
    Schema& quantities(const Str& key, std::vector<double> T::*m, Dimension d, const Str& text, const Options& o = {}) {
        return add(describe("quantities", key, text, o, d), m, codec::quantities(d, o.range));
    }

    Schema& integer(const Str& key, long T::*m, const Str& text, const Options& o = {}) {
        return add(describe("integer", key, text, o), m, codec::integer(o.range));
    }
    Schema& integer(const Str& key, Maybe<long> T::*m, const Str& text, const Options& o = {}) {
        return add(describe("integer", key, text, o), m, codec::integer(o.range));
    }
    // The alternative word leaves the member empty.
    Schema& integerOr(const Str& word, const Str& key, Maybe<long> T::*m, const Str& text, const Options& o = {}) {
        return addOr(word, describe("integer", key, text, o), m, codec::integer(o.range));
    }
    Schema& integer(const Str& key, int T::*m, const Str& text, Options o = {}) {
        o.range.low = std::max(o.range.low, static_cast<double>(std::numeric_limits<int>::min()));
        o.range.high = std::min(o.range.high, static_cast<double>(std::numeric_limits<int>::max()));
        const Codec<long> whole = codec::integer(o.range);
        return add(describe("integer", key, text, o), m,
                   Codec<int>{[whole](const Node& n, int& v, Problems& p) {
                                  long read = v;
                                  whole.read(n, read, p);
                                  v = static_cast<int>(read);
                              },
                              [whole](const int& v) { return whole.write(v); }});
    }

    Schema& boolean(const Str& key, bool T::*m, const Str& text, const Options& o = {}) {
        return add(describe("boolean", key, text, o), m, codec::boolean());
    }

    // One of the allowed words.
    Schema& word(const Str& key, Str T::*m, const std::vector<Str>& allowed, const Str& text, const Options& o = {}) {
        return add(withWords(describe("word", key, text, o), allowed), m, codec::word(allowed));
    }
    Schema& word(const Str& key, Maybe<Str> T::*m, const std::vector<Str>& allowed, const Str& text,
                 const Options& o = {}) {
        return add(withWords(describe("word", key, text, o), allowed), m, codec::word(allowed));
    }
    // A list of words; any names when `allowed` is empty.
    Schema& words(const Str& key, std::vector<Str> T::*m, const std::vector<Str>& allowed, const Str& text,
                  const Options& o = {}) {
        return add(withWords(describe("words", key, text, o), allowed), m, codec::words(allowed));
    }
    Schema& words(const Str& key, Maybe<std::vector<Str>> T::*m, const std::vector<Str>& allowed, const Str& text,
                  const Options& o = {}) {
        return add(withWords(describe("words", key, text, o), allowed), m, codec::words(allowed));
    }
    // A free name: a letter, then letters, digits, '-' and '_'.
    Schema& name(const Str& key, Str T::*m, const Str& text, const Options& o = {}) {
        return add(describe("name", key, text, o), m, codec::name());
    }
    Schema& name(const Str& key, Maybe<Str> T::*m, const Str& text, const Options& o = {}) {
        return add(describe("name", key, text, o), m, codec::name());
    }
    // Any text, for paths and titles.
    Schema& text(const Str& key, Str T::*m, const Str& text, const Options& o = {}) {
        return add(describe("text", key, text, o), m, codec::text());
    }
    Schema& text(const Str& key, Maybe<Str> T::*m, const Str& text, const Options& o = {}) {
        return add(describe("text", key, text, o), m, codec::text());
    }
    // Values of any kind, each kept as YAML on one line (a text in quotes without the quotes), to be parsed by the code
    // that uses them.
    Schema& values(const Str& key, std::vector<Str> T::*m, const Str& text, const Options& o = {}) {
        return add(describe("values", key, text, o), m, codec::values());
    }
    Schema& values(const Str& key, Maybe<std::vector<Str>> T::*m, const Str& text, const Options& o = {}) {
        return add(describe("values", key, text, o), m, codec::values());
    }

    // One of the allowed words, or a quantity, kept as it is written.
    Schema& wordOrQuantity(const Str& key, Str T::*m, const std::vector<Str>& allowed, Dimension d, const Str& text,
                           const Options& o = {}) {
        return add(withWords(describe("word or quantity", key, text, o, d), allowed), m,
                   codec::wordOrQuantity(allowed, d, o.range));
    }

    // "[1 um, 2 um, 3 um]"; the range holds for each component.
    Schema& vector(const Str& key, Vec3 T::*m, Dimension d, const Str& text, const Options& o = {}) {
        return add(describe("vector", key, text, o, d), m, codec::vector(d, o.range));
    }
    Schema& vector(const Str& key, Maybe<Vec3> T::*m, Dimension d, const Str& text, const Options& o = {}) {
        return add(describe("vector", key, text, o, d), m, codec::vector(d, o.range));
    }
    Schema& vectorOr(const Str& word, const Str& key, Maybe<Vec3> T::*m, Dimension d, const Str& text,
                     const Options& o = {}) {
        return addOr(word, describe("vector", key, text, o, d), m, codec::vector(d, o.range));
    }
    Schema& integers(const Str& key, Index3 T::*m, const Str& text, const Options& o = {}) {
        return add(describe("integers", key, text, o), m, codec::integers(o.range));
    }
    Schema& booleans(const Str& key, std::array<bool, 3> T::*m, const Str& text, const Options& o = {}) {
        return add(describe("booleans", key, text, o), m, codec::booleans());
    }

    // A length in metres or in particle spacings ("3.0 dx"); the range holds for the number in either unit.
    Schema& length(const Str& key, Length T::*m, const Str& text, const Options& o = {}) {
        return add(describe("length", key, text, o, unit::metre), m, codec::length(o.range));
    }
    Schema& length(const Str& key, Maybe<Length> T::*m, const Str& text, const Options& o = {}) {
        return add(describe("length", key, text, o, unit::metre), m, codec::length(o.range));
    }
    Schema& lengthOr(const Str& word, const Str& key, Maybe<Length> T::*m, const Str& text, const Options& o = {}) {
        return addOr(word, describe("length", key, text, o, unit::metre), m, codec::length(o.range));
    }
    Schema& interval(const Str& key, Interval T::*m, const Str& text, const Options& o = {}) {
        return add(describe("interval", key, text, o), m, codec::interval(o.range));
    }
    Schema& interval(const Str& key, Maybe<Interval> T::*m, const Str& text, const Options& o = {}) {
        return add(describe("interval", key, text, o), m, codec::interval(o.range));
    }

    template <class Nested>
    Schema& table(const Str& key, Nested T::*m, const Str& text, const Options& o = {}) {
        return add(withTable<Nested>(describe("table", key, text, o)), m, tableCodec<Nested>());
    }
    template <class Nested>
    Schema& table(const Str& key, Maybe<Nested> T::*m, const Str& text, const Options& o = {}) {
        return add(withTable<Nested>(describe("table", key, text, o)), m, tableCodec<Nested>());
    }
    template <class Nested>
    Schema& tableOr(const Str& word, const Str& key, Maybe<Nested> T::*m, const Str& text, const Options& o = {}) {
        return addOr(word, withTable<Nested>(describe("table", key, text, o)), m, tableCodec<Nested>());
    }
    template <class Nested>
    Schema& list(const Str& key, std::vector<Nested> T::*m, const Str& text, const Options& o = {}) {
        return add(withTable<Nested>(describe("list", key, text, o)), m, listCodec(tableCodec<Nested>()));
    }
    template <class Nested>
    Schema& map(const Str& key, std::map<Str, Nested> T::*m, const Str& text, const Options& o = {}) {
        return add(withTable<Nested>(describe("map", key, text, o)), m, mapCodec(tableCodec<Nested>()));
    }

    // A model of a family (registry.hpp), in the form "type: name" with its settings beside it, or the bare name.
    template <class Family>
    Schema& model(const Str& key, Choice<Family> T::*m, const Str& text, const Options& o = {}) {
        return add(withFamily<Family>(describe("model", key, text, o)), m, choiceCodec<Family>());
    }
    // The alternative word leaves the choice empty.
    template <class Family>
    Schema& modelOr(const Str& word, const Str& key, Choice<Family> T::*m, const Str& text, const Options& o = {}) {
        FieldInfo info = withFamily<Family>(describe("model", key, text, o));
        info.alternative = word;
        const auto inner = choiceCodec<Family>();
        return add(std::move(info), m,
                   Codec<Choice<Family>>{
                       [inner, word](const Node& n, Choice<Family>& v, Problems& p) {
                           if (isWord(n, word))
                               v = {};
                           else
                               inner.read(n, v, p);
                       },
                       [inner, word](const Choice<Family>& v) { return v ? inner.write(v) : Node::word(word); }});
    }
    template <class Family>
    Schema& models(const Str& key, std::map<Str, Choice<Family>> T::*m, const Str& text, const Options& o = {}) {
        return add(withFamily<Family>(describe("models", key, text, o)), m, mapCodec(choiceCodec<Family>()));
    }

    // A table for each model of a family that has settings, under the model's own name; a model without a table has its
    // defaults.
    template <class Family>
    Schema& modelTables(ModelTables<Family> T::*m, AtRestart policy) {
        for (const ModelTable<Family>& model : corpuscle::modelTables<Family>()) {
            FieldInfo info = describe("table", model.name, model.text, {.fallback = "{}"});
            info.table = model.settings;
            info.atRestart = policy;
            add(std::move(info), m, model.codec);
        }
        return *this;
    }

    // The fields, rules and checks of a base struct.
    template <class Base>
    Schema& include() {
        static_assert(std::is_base_of_v<Base, T>);
        struct Access : Schema<Base> {
            static const auto& fields(const Schema<Base>& s) { return s.*(&Access::fields_); }
            static const auto& checks(const Schema<Base>& s) { return s.*(&Access::checks_); }
            static const auto& one(const Schema<Base>& s) { return s.*(&Access::exactlyOne_); }
            static const auto& most(const Schema<Base>& s) { return s.*(&Access::atMostOne_); }
        };
        const Schema<Base>& base = Base::schema();
        const auto up = [](const void* object) { return static_cast<const Base*>(static_cast<const T*>(object)); };
        for (const Field& f : Access::fields(base))
            fields_.push_back({f.info,
                               [read = f.read](void* object, const Node& n, Problems& p) {
                                   read(static_cast<Base*>(static_cast<T*>(object)), n, p);
                               },
                               [write = f.write, up](const void* object) { return write(up(object)); }});
        for (const Check& c : Access::checks(base))
            checks_.push_back([c, up](const void* object, const Node& n, Problems& p) { c(up(object), n, p); });
        exactlyOne_.insert(exactlyOne_.end(), Access::one(base).begin(), Access::one(base).end());
        atMostOne_.insert(atMostOne_.end(), Access::most(base).begin(), Access::most(base).end());
        return *this;
    }

    Schema& exactlyOneOf(std::vector<Str> keys) {
        exactlyOne_.push_back(std::move(keys));
        return *this;
    }
    Schema& atMostOneOf(std::vector<Str> keys) {
        atMostOne_.push_back(std::move(keys));
        return *this;
    }
    // Sets the policy of these keys, which must have been declared before.
    Schema& atRestart(AtRestart policy, const std::vector<Str>& keys) {
        declareAtRestart(policy, keys);
        return *this;
    }
    // A rule over several fields; runs only when the table itself has no problem.
    Schema& check(std::function<void(const T&, const Node&, Problems&)> rule) {
        checks_.push_back([rule = std::move(rule)](const void* object, const Node& n, Problems& p) {
            rule(*static_cast<const T*>(object), n, p);
        });
        return *this;
    }

  private:
    template <class M>
    Schema& add(FieldInfo info, M T::*member, const Codec<M>& codec) {
        fields_.push_back({std::move(info),
                           [member, codec](void* object, const Node& n, Problems& p) {
                               codec.read(n, static_cast<T*>(object)->*member, p);
                           },
                           [member, codec](const void* object) -> std::optional<Node> {
                               return codec.write(static_cast<const T*>(object)->*member);
                           }});
        return *this;
    }
    // Absent keys and the alternative word leave the member empty.
    template <class M>
    Schema& add(FieldInfo info, Maybe<M> T::*member, const Codec<M>& codec) {
        if (info.alternative.empty()) info.required = false;
        const Str word = info.alternative;
        fields_.push_back({std::move(info),
                           [member, codec, word](void* object, const Node& n, Problems& p) {
                               Maybe<M>& value = static_cast<T*>(object)->*member;
                               value.reset();
                               if (isWord(n, word)) return;
                               M read{};
                               const std::size_t before = p.count();
                               codec.read(n, read, p);
                               if (p.count() == before) value = std::move(read);
                           },
                           [member, codec, word](const void* object) {
                               const Maybe<M>& value = static_cast<const T*>(object)->*member;
                               return writeOptional(value ? Maybe<Node>(codec.write(*value)) : std::nullopt, word);
                           }});
        return *this;
    }
    template <class M>
    Schema& addOr(const Str& word, FieldInfo info, Maybe<M> T::*member, const Codec<M>& codec) {
        info.alternative = word;
        return add(std::move(info), member, codec);
    }

    static FieldInfo withWords(FieldInfo info, std::vector<Str> words) {
        info.words = std::move(words);
        return info;
    }
    template <class Nested>
    static FieldInfo withTable(FieldInfo info) {
        info.table = [] { return Nested::schema().info(); };
        return info;
    }
    template <class Family>
    static FieldInfo withFamily(FieldInfo info) {
        info.family = Family::familyName;
        return info;
    }

    template <class Nested>
    static Codec<Nested> tableCodec() {
        return {[](const Node& n, Nested& v, Problems& p) { Nested::schema().readInto(&v, n, p); },
                [](const Nested& v) { return Nested::schema().writeFrom(&v); }};
    }
    template <class M>
    static Codec<std::vector<M>> listCodec(const Codec<M>& item) {
        return {[item](const Node& n, std::vector<M>& v, Problems& p) {
                    v.clear();
                    eachItem(n, p, [&](const Node& i) { item.read(i, v.emplace_back(), p); });
                },
                [item](const std::vector<M>& v) {
                    Node node = Node::list({});
                    for (const M& m : v) node.items.push_back(item.write(m));
                    return node;
                }};
    }
    template <class M>
    static Codec<std::map<Str, M>> mapCodec(const Codec<M>& item) {
        return {[item](const Node& n, std::map<Str, M>& v, Problems& p) {
                    v.clear();
                    eachEntry(n, p, [&](const Str& key, const Node& e) { item.read(e, v[key], p); });
                },
                [item](const std::map<Str, M>& v) {
                    Node node;
                    for (const auto& [key, m] : v) node.entries.emplace_back(key, item.write(m));
                    return node;
                }};
    }
};

template <class T>
T read(const Node& node, Problems& problems) {
    T value;
    T::schema().readInto(&value, node, problems);
    return value;
}

template <class T>
Node write(const T& value) {
    return T::schema().writeFrom(&value);
}

}  // namespace corpuscle
