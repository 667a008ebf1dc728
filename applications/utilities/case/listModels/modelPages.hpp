// Sections of the documentation that are about a model: those that name it in code marks or in blocks of code.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "modelUses.hpp"

namespace corpuscle {

// A section of a page, up to its next heading.
struct Section {
    std::string page, heading, anchor;  // "docs/theory/membrane.md", "Laws", "laws"
    std::string text;                   // without code
    std::vector<std::string> code;      // content of code marks, lines of blocks
};

// Sections of all pages of a folder, those on theory first; the generated reference and pages for developers are left
// out. Pages are shown as paths within `root`.
std::vector<Section> readSections(const std::filesystem::path& docs, const std::filesystem::path& root);

// Which words of a family's models are its own.
struct ModelNames {
    std::vector<std::string> keys;  // by which dictionaries choose a model of the family
    bool isShared = false;          // the model's name also has another meaning: of another family, or of a key
};

// The sections that name a model: as a value of one of the family's keys, or by its name alone. A name with several
// meanings counts alone only where the section also names the family or one of its keys.
std::vector<const Section*> sectionsAbout(const std::vector<Section>& sections, const ModelId& model,
                                          const ModelNames& names);

}  // namespace corpuscle
