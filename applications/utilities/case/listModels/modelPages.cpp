#include "modelPages.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <regex>
#include <sstream>

#include "core/atomicFile.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

constexpr std::array leftOut{"README.md", "architecture.md", "changes.md", "dictionaries.md"};

// As GitHub and the website name the headings of a page.
std::string anchorOf(const std::string& heading, std::map<std::string, int>& seen) {
    std::string anchor;
    for (const char c : heading) {
        const auto letter = static_cast<unsigned char>(c);
        if (std::isalnum(letter) || c == '-' || c == '_')
            anchor += static_cast<char>(std::tolower(letter));
        else if (c == ' ')
            anchor += '-';
    }
    const int before = seen[anchor]++;
    return before == 0 ? anchor : anchor + "-" + std::to_string(before);
}

// Separates the code marks of a line from its text.
void addLine(const std::string& line, Section& section) {
    std::istringstream parts(line);
    bool isCode = false;
    for (std::string part; std::getline(parts, part, '`'); isCode = !isCode) {
        if (isCode)
            section.code.push_back(part);
        else
            section.text += part;
        section.text += ' ';
    }
}

void readPage(const fs::path& file, const std::string& shownAs, std::vector<Section>& sections) {
    std::istringstream lines(readFile(file));
    std::map<std::string, int> seen;
    bool inBlock = false;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t level = line.find_first_not_of('#');
        if (line.starts_with("```")) {
            inBlock = !inBlock;
        } else if (!inBlock && line.starts_with('#') && level != std::string::npos && line[level] == ' ') {
            std::string heading = line.substr(level + 1);
            std::erase(heading, '`');
            sections.push_back({shownAs, heading, anchorOf(heading, seen), "", {}});
            addLine(line.substr(level + 1), sections.back());
        } else if (!sections.empty() && sections.back().page == shownAs) {
            if (inBlock)
                sections.back().code.push_back(line);
            else
                addLine(line, sections.back());
        }
    }
}

std::vector<fs::path> pagesOf(const fs::path& folder) {
    std::vector<fs::path> pages;
    if (!fs::is_directory(folder)) return pages;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() == ".md" && std::find(leftOut.begin(), leftOut.end(), name) == leftOut.end())
            pages.push_back(entry.path());
    }
    std::sort(pages.begin(), pages.end());
    return pages;
}

std::string anyOf(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : "|") + word;
    return text;
}

}  // namespace

std::vector<Section> readSections(const fs::path& docs, const fs::path& root) {
    std::vector<Section> sections;
    for (const fs::path& folder : {docs / "theory", docs})
        for (const fs::path& page : pagesOf(folder)) readPage(page, page.lexically_relative(root).string(), sections);
    return sections;
}

std::vector<const Section*> sectionsAbout(const std::vector<Section>& sections, const ModelId& model,
                                          const ModelNames& names) {
    const std::string name = model.second + "(?![A-Za-z0-9_])";
    const std::string keys = names.keys.empty() ? "(?!)" : "\\b(" + anyOf(names.keys) + ")\\b";
    const std::regex ofFamily("\\b" + model.first + "s?\\b|" + keys, std::regex::icase);
    const std::regex asValue(keys + ": *(\\{ *type: *)?" + name), alone("^" + name + "$|\\btype: *" + name);
    std::vector<const Section*> about;
    for (const Section& section : sections) {
        const auto contains = [&](const std::regex& pattern) {
            return std::any_of(section.code.begin(), section.code.end(),
                               [&](const std::string& code) { return std::regex_search(code, pattern); });
        };
        const auto isOfFamily = [&] {
            return !names.isShared || std::regex_search(section.text, ofFamily) || contains(ofFamily);
        };
        if (contains(asValue) || (contains(alone) && isOfFamily())) about.push_back(&section);
    }
    return about;
}

}  // namespace corpuscle
