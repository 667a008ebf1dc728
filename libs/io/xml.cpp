#include "io/xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace corpuscle::io {
namespace {

constexpr int deepest = 64, most = 100000;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool isNameCharacter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.' || c == ':';
}

class XmlReader {
  public:
    explicit XmlReader(std::string_view bytes) : bytes_(bytes) {}

    XmlElement document() {
        if (bytes_.starts_with("\xEF\xBB\xBF")) at_ = 3;
        skipToElement();
        XmlElement root = element(0);
        if (appended_) return root;
        skipMisc();
        if (at_ < bytes_.size()) fault("there is more behind the last element");
        return root;
    }

  private:
    [[noreturn]] void fault(const std::string& what) const {
        const auto line = 1 + std::count(bytes_.begin(), bytes_.begin() + static_cast<long>(at_), '\n');
        throw XmlFault(fmt::format("line {}: {}", line, what));
    }
    bool next(std::string_view word) const { return bytes_.substr(at_).starts_with(word); }
    void skipBlanks() {
        while (at_ < bytes_.size() && isBlank(bytes_[at_])) ++at_;
    }
    void skipPast(std::string_view end, const char* what) {
        const std::size_t found = bytes_.find(end, at_);
        if (found == std::string_view::npos) fault(fmt::format("{} does not end", what));
        at_ = found + end.size();
    }
    // Skips blanks, comments and processing instructions.
    void skipMisc() {
        while (true) {
            skipBlanks();
            if (next("<!--"))
                skipPast("-->", "a comment");
            else if (next("<?"))
                skipPast("?>", "a processing instruction");
            else
                return;
        }
    }
    void skipToElement() {
        skipMisc();
        if (next(rawByDefault)) {
            at_ += rawByDefault.size();
            rawByDefault_ = true;
            skipMisc();
        }
        if (next("<!")) fault("a document type is not read");
        if (!next("<")) fault("no XML element was found");
    }
    std::string name() {
        const std::size_t begin = at_;
        while (at_ < bytes_.size() && isNameCharacter(bytes_[at_])) ++at_;
        if (at_ == begin) fault("a name is missing");
        return std::string(bytes_.substr(begin, at_ - begin));
    }

    void entity(std::string& text) {
        const std::size_t end = bytes_.substr(0, std::min(at_ + 12, bytes_.size())).find(';', at_);
        if (end == std::string_view::npos) fault("an entity does not end with ';'");
        const std::string_view word = bytes_.substr(at_ + 1, end - at_ - 1);
        at_ = end + 1;
        if (word == "lt") return text.push_back('<');
        if (word == "gt") return text.push_back('>');
        if (word == "amp") return text.push_back('&');
        if (word == "quot") return text.push_back('"');
        if (word == "apos") return text.push_back('\'');
        const bool hex = word.starts_with("#x");
        const std::string_view digits = word.substr(std::min(word.size(), std::size_t{hex ? 2u : 1u}));
        unsigned code = 0;
        const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, hex ? 16 : 10);
        if (!word.starts_with('#') || error != std::errc() || stop != digits.data() + digits.size() || code > 0x10FFFF)
            fault(fmt::format("unknown entity '&{};'", word));
        const auto add = [&](unsigned c) { text.push_back(static_cast<char>(c)); };
        if (code < 0x80) return add(code);
        if (code < 0x800) {
            add(0xC0 | code >> 6);
        } else if (code < 0x10000) {
            add(0xE0 | code >> 12), add(0x80 | (code >> 6 & 0x3F));
        } else {
            add(0xF0 | code >> 18), add(0x80 | (code >> 12 & 0x3F)), add(0x80 | (code >> 6 & 0x3F));
        }
        add(0x80 | (code & 0x3F));
    }

    void attribute(XmlElement& e) {
        std::string key = name(), value;
        skipBlanks();
        if (!next("=")) fault(fmt::format("the attribute '{}' has no value", key));
        ++at_;
        skipBlanks();
        if (!next("\"") && !next("'")) fault(fmt::format("the value of the attribute '{}' is not quoted", key));
        const char quote = bytes_[at_++];
        while (at_ < bytes_.size() && bytes_[at_] != quote) {
            if (bytes_[at_] == '<') fault(fmt::format("the value of the attribute '{}' does not end", key));
            if (bytes_[at_] == '&')
                entity(value);
            else
                value.push_back(bytes_[at_++]);
        }
        if (at_ == bytes_.size()) fault(fmt::format("the value of the attribute '{}' does not end", key));
        ++at_;
        if (!e.attributes.emplace(key, std::move(value)).second)
            fault(fmt::format("the attribute '{}' stands twice", key));
    }

    void takeText(XmlElement& e) {
        const std::size_t begin = at_;
        at_ = std::min(bytes_.find('<', at_), bytes_.size());
        const std::string_view text = bytes_.substr(begin, at_ - begin);
        if (e.text.empty() && !std::all_of(text.begin(), text.end(), isBlank)) e.text = text;
    }

    XmlElement element(int depth) {
        if (depth > deepest) fault("elements are nested too deeply");
        if (++count_ > most) fault(fmt::format("there are more than {} elements", most));
        XmlElement e;
        e.line = lineHere();
        ++at_;
        e.name = name();
        while (true) {
            skipBlanks();
            if (next("/>")) {
                at_ += 2;
                return e;
            }
            if (next(">")) break;
            attribute(e);
        }
        ++at_;
        if (e.name == "AppendedData") {
            const std::size_t mark = bytes_.find('_', at_);
            if (mark == std::string_view::npos) fault("the appended data do not begin with '_'");
            e.text = bytes_.substr(mark + 1);
            if (rawByDefault_) e.attributes.emplace("encoding", "raw");
            appended_ = true;
            return e;
        }
        while (true) {
            takeText(e);
            if (at_ >= bytes_.size()) fault(fmt::format("the element '{}' does not end", e.name));
            if (next("<!--")) {
                skipPast("-->", "a comment");
            } else if (next("<?")) {
                skipPast("?>", "a processing instruction");
            } else if (next("</")) {
                at_ += 2;
                if (const std::string end = name(); end != e.name)
                    fault(fmt::format("the element '{}' ends with '</{}>'", e.name, end));
                skipBlanks();
                if (!next(">")) fault(fmt::format("the end of the element '{}' is not closed", e.name));
                ++at_;
                return e;
            } else {
                e.children.push_back(element(depth + 1));
                if (appended_) return e;
            }
        }
    }

    // Line of the current position, counted onwards from the position of the previous call.
    int lineHere() {
        line_ += static_cast<int>(
            std::count(bytes_.begin() + static_cast<long>(counted_), bytes_.begin() + static_cast<long>(at_), '\n'));
        counted_ = at_;
        return line_;
    }

    std::string_view bytes_;
    std::size_t at_ = 0, counted_ = 0;
    int line_ = 1, count_ = 0;
    bool appended_ = false, rawByDefault_ = false;
};

}  // namespace

const XmlElement* XmlElement::child(std::string_view childName) const {
    const auto found =
        std::find_if(children.begin(), children.end(), [&](const XmlElement& e) { return e.name == childName; });
    return found == children.end() ? nullptr : &*found;
}

const std::string* XmlElement::attribute(const std::string& attributeName) const {
    const auto found = attributes.find(attributeName);
    return found == attributes.end() ? nullptr : &found->second;
}

XmlElement parseXml(std::string_view bytes) { return XmlReader(bytes).document(); }

}  // namespace corpuscle::io
