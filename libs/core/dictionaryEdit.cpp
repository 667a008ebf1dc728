#include "core/dictionaryEdit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace corpuscle {
namespace {

constexpr std::size_t nowhere = std::string::npos;

std::vector<std::string> wordsOf(const std::string& path) {
    std::vector<std::string> words;
    for (std::size_t begin = path.starts_with('/') ? 1 : 0; begin < path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        words.push_back(path.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

std::optional<std::size_t> indexIn(const Node& list, const std::string& word) {
    std::size_t i = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), i);
    if (error != std::errc() || end != word.data() + word.size() || i >= list.items.size()) return std::nullopt;
    return i;
}

const Node* childOf(const Node& node, const std::string& word) {
    if (node.kind == Node::Kind::table) return node.find(word);
    if (node.kind != Node::Kind::list) return nullptr;
    const auto i = indexIn(node, word);
    return i ? &node.items[*i] : nullptr;
}

// Nodes along a path, the root first, as far as they exist.
std::vector<const Node*> chainTo(const Node& root, const std::vector<std::string>& words) {
    std::vector<const Node*> chain{&root};
    for (const std::string& word : words) {
        const Node* next = childOf(*chain.back(), word);
        if (!next) break;
        chain.push_back(next);
    }
    return chain;
}

bool removeEntry(Node& node, const std::vector<std::string>& words, std::size_t at = 0) {
    const std::string& word = words[at];
    if (at + 1 < words.size()) {
        const Node* next = childOf(node, word);
        return next && removeEntry(const_cast<Node&>(*next), words, at + 1);
    }
    if (node.kind == Node::Kind::list) {
        const auto i = indexIn(node, word);
        if (i) node.items.erase(node.items.begin() + static_cast<std::ptrdiff_t>(*i));
        return i.has_value();
    }
    return std::erase_if(node.entries, [&](const Node::Entry& entry) { return entry.key == word; }) > 0;
}

// The text of a dictionary with the places of its nodes.
class Layout {
  public:
    explicit Layout(const std::string& text) : text_(text) {
        for (std::size_t at = 0; at != nowhere; at = text.find('\n', at), at += at == nowhere ? 0 : 1)
            lines_.push_back(at);
        if (text.starts_with("\xEF\xBB\xBF")) lines_[0] = 3;
    }

    std::size_t offset(const Mark& mark) const {
        const auto line = static_cast<std::size_t>(mark.line - 1);
        if (mark.line < 1 || line >= lines_.size()) return nowhere;
        return std::min(lines_[line] + static_cast<std::size_t>(mark.column - 1), text_.size());
    }
    bool inBrackets(const Node& node) const {
        const std::size_t at = offset(node.mark);
        return at < text_.size() && (text_[at] == '[' || text_[at] == '{');
    }

    // Start of a value; of a value on lines of its own, the first of them.
    std::size_t begin(const Node& node) const { return offset(node.mark); }

    // One past the last character of a value.
    std::size_t end(const Node& node) const {
        const std::size_t at = offset(node.mark);
        if (at == nowhere) return nowhere;
        if (node.isNothing()) return behindColon(node);
        if (node.kind != Node::Kind::scalar && inBrackets(node)) return closing(at);
        if (node.kind == Node::Kind::scalar)
            return node.quoted ? closingQuote(at) : std::min(at + node.scalar.size(), text_.size());
        if (node.kind == Node::Kind::list) return node.items.empty() ? nowhere : end(node.items.back());
        return node.entries.empty() ? at : end(node.entries.back().value);
    }

    // One past the colon after the key of a value.
    std::size_t behindColon(const Node& value) const {
        const std::size_t key = offset(value.keyMark);
        if (key >= text_.size()) return nowhere;
        const bool quoted = text_[key] == '"' || text_[key] == '\'';
        const std::size_t colon = text_.find(':', quoted ? closingQuote(key) : key);
        return colon == nowhere ? nowhere : colon + 1;
    }

    std::size_t lineStart(std::size_t at) const {
        const std::size_t newline = at == 0 ? nowhere : text_.rfind('\n', at - 1);
        return newline == nowhere ? 0 : newline + 1;
    }
    std::size_t nextLine(std::size_t at) const {
        const std::size_t newline = text_.find('\n', at);
        return newline == nowhere ? text_.size() : newline + 1;
    }
    bool isBlank(std::size_t from, std::size_t to) const {
        return text_.find_first_not_of(" \t\r", from) >= to || from >= to;
    }
    std::string lineEnd() const { return text_.find("\r\n") == nowhere ? "\n" : "\r\n"; }

    std::size_t closing(std::size_t at) const {
        int depth = 0;
        for (std::size_t i = at; i < text_.size(); ++i) {
            const char c = text_[i];
            if (c == '"' || c == '\'') {
                const char before = i == 0 ? ' ' : text_[i - 1];
                if (std::string_view(" ,[{:\n").find(before) == std::string_view::npos) continue;  // "5'": a plain text
                i = closingQuote(i) - 1;
            } else if (c == '#' && i > 0 && (text_[i - 1] == ' ' || text_[i - 1] == '\t' || text_[i - 1] == '\n')) {
                i = std::min(text_.find('\n', i), text_.size()) - 1;
            } else if (c == '[' || c == '{') {
                ++depth;
            } else if ((c == ']' || c == '}') && --depth == 0) {
                return i + 1;
            }
        }
        return nowhere;
    }

  private:
    // One past the closing quotation mark of the text that begins at `at`.
    std::size_t closingQuote(std::size_t at) const {
        const char quote = text_[at];
        for (std::size_t i = at + 1; i < text_.size(); ++i) {
            const bool isEscape = quote == '"' && text_[i] == '\\';
            const bool isDoubled = quote == '\'' && text_[i] == quote && i + 1 < text_.size() && text_[i + 1] == quote;
            if (isEscape || isDoubled)
                ++i;
            else if (text_[i] == quote)
                return i + 1;
        }
        return text_.size();
    }

    const std::string& text_;
    std::vector<std::size_t> lines_;
};

// A key as it has to be written in braces or on a line.
std::string keyText(const std::string& key) {
    Node table;
    table.entries.emplace_back(key, Node::word("x"));
    const std::string line = emit(table);
    return line.substr(0, line.rfind(": x"));
}

// "b: {c: value}" for the words from `first` on.
std::string nested(const std::vector<std::string>& words, std::size_t first, const std::string& value) {
    std::string text = value;
    for (std::size_t k = words.size(); k-- > first;) {
        const bool isLast = k + 1 == words.size();
        text = fmt::format("{}: {}{}{}", keyText(words[k]), isLast ? "" : "{", text, isLast ? "" : "}");
    }
    return text;
}

std::string replaced(const std::string& text, std::size_t begin, std::size_t end, const std::string& by) {
    if (begin == nowhere || end == nowhere || begin > end || end > text.size()) return {};
    return text.substr(0, begin) + by + text.substr(end);
}

// Whole lines of comment in a part of the text, each with its line end.
std::string commentLines(const std::string& text, std::size_t begin, std::size_t end) {
    std::string lines;
    for (std::size_t at = text.find('\n', begin); at != nowhere && at + 1 < end; at = text.find('\n', at + 1)) {
        const std::size_t next = std::min(text.find('\n', at + 1), text.size());
        const std::size_t first = text.find_first_not_of(" \t", at + 1);
        if (first < next && text[first] == '#' && next <= end) lines += text.substr(at + 1, next - at);
    }
    return lines;
}

// The text with `value` in place of the value of `node`. Empty: the layout is not understood.
std::string withValue(const std::string& text, const Layout& layout, const Node& node, const std::string& value) {
    if (node.mark.line == 0) return {};
    const bool ownLines = node.kind != Node::Kind::scalar && !layout.inBrackets(node);
    if (!node.isNothing() && !ownLines) return replaced(text, layout.begin(node), layout.end(node), value);
    const bool hasKey = !node.keyMark.file.empty();
    const std::size_t begin = hasKey ? layout.behindColon(node) : layout.begin(node), end = layout.end(node);
    if (begin == nowhere || end == nowhere) return {};
    const std::string now = (hasKey ? " " : "") + value;
    if (!ownLines) return replaced(text, begin, std::max(begin, end), now);
    // Comments between the removed lines are kept, after the line of the new value.
    const std::string comments = commentLines(text, begin, end);
    const std::size_t lineEnd = layout.nextLine(end);
    return replaced(text, begin, lineEnd,
                    now + text.substr(end, lineEnd - end) + (comments.empty() || lineEnd == end ? "" : comments));
}

// The text with `entry` ("key: value") added at the end of a table.
std::string withNewEntry(const std::string& text, const Layout& layout, const Node& table, const std::string& entry) {
    const bool isRoot = table.path.empty();
    if (layout.inBrackets(table) && !(isRoot && table.entries.empty())) {
        if (!table.entries.empty()) {
            const std::size_t at = layout.end(table.entries.back().value);
            return replaced(text, at, at, ", " + entry);
        }
        return replaced(text, layout.begin(table), layout.end(table), "{" + entry + "}");
    }
    const std::string newline = layout.lineEnd();
    if (table.entries.empty())
        return isRoot ? text + (text.empty() || text.ends_with('\n') ? "" : newline) + entry + newline : std::string();
    const std::size_t at = layout.nextLine(layout.end(table.entries.back().value));
    const std::string blanks(static_cast<std::size_t>(table.entries.front().value.keyMark.column - 1), ' ');
    return replaced(text, at, at,
                    (at > 0 && text[at - 1] != '\n' ? newline : std::string()) + blanks + entry + newline);
}

// The text without an entry of a table or list in brackets, and without one of the commas beside it.
std::string withoutInBrackets(const std::string& text, std::size_t begin, std::size_t end) {
    if (begin == nowhere || end == nowhere) return {};
    const std::size_t after = text.find_first_not_of(" \t\r\n", end);
    if (after != nowhere && text[after] == ',') {
        const std::size_t next = text.find_first_not_of(' ', after + 1);
        return replaced(text, begin, next == nowhere ? after + 1 : next, "");
    }
    const std::size_t before = begin == 0 ? nowhere : text.find_last_not_of(" \t\r\n", begin - 1);
    if (before != nowhere && text[before] == ',') return replaced(text, before, end, "");
    return replaced(text, begin, end, "");
}

std::string without(const std::string& text, const Layout& layout, const Node& parent, const Node& node) {
    const bool isItem = parent.kind == Node::Kind::list;
    const std::size_t end = layout.end(node);
    std::size_t begin = isItem ? layout.begin(node) : layout.offset(node.keyMark);
    if (layout.inBrackets(parent)) return withoutInBrackets(text, begin, end);
    if (begin == nowhere || end == nowhere) return {};
    if (isItem) {
        begin = begin == 0 ? nowhere : text.rfind('-', begin - 1);
        if (begin == nowhere) return {};
    }
    const bool isLast = isItem ? parent.items.size() == 1 : parent.entries.size() == 1;
    if (isLast && !parent.path.empty()) return withValue(text, layout, parent, isItem ? "[]" : "{}");
    if (layout.isBlank(layout.lineStart(begin), begin))
        return replaced(text, layout.lineStart(begin), layout.nextLine(end), "");
    // The first key of a list item, after the dash: the next key takes its place.
    if (isItem || &parent.entries.front().value != &node) return {};
    const std::size_t next = text.find_first_not_of(" \t", layout.nextLine(end));  // a key, or a line of comment
    return replaced(text, begin, next, "");
}

std::string checked(const std::string& result, const std::string& file, const Node& wanted,
                    const std::string& instead) {
    Problems problems;
    if (!result.empty() || wanted.entries.empty()) {
        const Node found = parseDictionary(result, file, problems);
        if (problems.empty() && emit(found) == emit(wanted)) return result;
    }
    throw Failure(ExitCode::invalidCase, instead);
}

Node parsed(const std::string& text, const std::string& file) {
    Problems problems;
    Node root = parseDictionary(text, file, problems);
    problems.throwIfAny();
    return root;
}

void compare(const Node* first, const Node* second, const std::string& path, std::vector<EntryDifference>& found) {
    const auto textOf = [](const Node* node) { return node ? emitInLine(*node) : std::string(); };
    if (first && second && first->kind == second->kind && first->kind != Node::Kind::scalar) {
        if (first->kind == Node::Kind::table) {
            for (const auto& [key, value] : first->entries)
                compare(&value, second->find(key), fmt::format("{}/{}", path, key), found);
            for (const auto& [key, value] : second->entries)
                if (!first->find(key)) compare(nullptr, &value, fmt::format("{}/{}", path, key), found);
            return;
        }
        if (first->items.size() == second->items.size()) {
            for (std::size_t i = 0; i < first->items.size(); ++i)
                compare(&first->items[i], &second->items[i], fmt::format("{}/{}", path, i), found);
            return;
        }
    }
    if (textOf(first) != textOf(second)) found.push_back({path, textOf(first), textOf(second)});
}

}  // namespace

const Node* entryAt(const Node& root, const std::string& path) {
    const std::vector<std::string> words = wordsOf(path);
    const std::vector<const Node*> chain = chainTo(root, words);
    return chain.size() == words.size() + 1 ? chain.back() : nullptr;
}

const Node& requiredEntry(const Node& root, const std::string& file, const std::string& path) {
    const std::vector<std::string> words = wordsOf(path);
    const std::vector<const Node*> chain = chainTo(root, words);
    const Node& last = *chain.back();
    if (chain.size() == words.size() + 1) return last;
    const std::string& word = words[chain.size() - 1];
    std::string there = "this is " + last.kindText();
    if (last.kind == Node::Kind::list) there = fmt::format("its items are 0 to {}", std::ssize(last.items) - 1);
    if (last.kind == Node::Kind::table) {
        std::vector<std::string> keys;
        for (const auto& [key, value] : last.entries) keys.push_back(key);
        there = keys.empty() ? "this table is empty" : fmt::format("there are {}{}", joinWords(keys), ".");
        there += didYouMean(word, keys);
    }
    throw Failure(ExitCode::invalidCase, fmt::format("{}: {}: there is no '{}'; {}", file, path, word, there));
}

std::string withEntry(const std::string& text, const Override& change) {
    const Node before = parsed(text, change.file);
    Node wanted = before;
    Problems problems;
    applyOverride(wanted, change, problems);
    problems.throwIfAny();
    const std::vector<std::string> words = wordsOf(change.path);
    const std::vector<const Node*> chain = chainTo(before, words);
    const Node& last = *chain.back();
    const Layout layout(text);
    std::string result;
    if (chain.size() == words.size() + 1) {
        result = withValue(text, layout, last, change.value);
    } else {
        const std::string entry = nested(words, chain.size() - 1, change.value);
        if (last.kind == Node::Kind::table)
            result = withNewEntry(text, layout, last, entry);
        else if (last.kind == Node::Kind::scalar)  // "kernel: lucy" is short for "kernel: {type: lucy}"
            result =
                withValue(text, layout, last,
                          last.isNothing() ? "{" + entry + "}" : "{type: " + emitInLine(last) + ", " + entry + "}");
    }
    return checked(
        result, change.file, wanted,
        fmt::format("{}:{}: '{}' cannot be written there without changing more of the file than this entry; quote "
                    "the value if it holds one of , [ ] {{ }} #, or edit {} by hand.",
                    change.file, change.path, change.value, change.file));
}

std::string withoutEntry(const std::string& text, const std::string& file, const std::string& path) {
    const Node before = parsed(text, file);
    const std::vector<std::string> words = wordsOf(path);
    if (words.empty())
        throw Failure(ExitCode::invalidCase, fmt::format("{}:{}: the whole file is no entry; delete it.", file, path));
    requiredEntry(before, file, path);
    Node wanted = before;
    removeEntry(wanted, words);
    const std::vector<const Node*> chain = chainTo(before, words);
    return checked(without(text, Layout(text), *chain[chain.size() - 2], *chain.back()), file, wanted,
                   fmt::format("{}:{}: this entry cannot be taken out without changing more of the file; edit {} by "
                               "hand.",
                               file, path, file));
}

std::vector<EntryDifference> differences(const Node& first, const Node& second) {
    std::vector<EntryDifference> found;
    compare(&first, &second, "", found);
    return found;
}

}  // namespace corpuscle
