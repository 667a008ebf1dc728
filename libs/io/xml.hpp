// A small, strict reader of XML: elements, attributes and the first text of each element, as VTK's files need them.
//
// Only names and attributes are copied: `text` points into the given bytes. Reading ends at the element AppendedData,
// since any bytes may follow its underscore; its text is everything behind that underscore. Throws XmlFault with the
// line for anything that is not well-formed, for more than 64 levels or 100,000 elements, and for any document type
// other than `rawByDefault`.
#pragma once
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle::io {

// The one document type that is read: the element AppendedData is raw without saying so (vtpWriter.hpp).
inline constexpr std::string_view rawByDefault = "<!DOCTYPE VTKFile [<!ATTLIST AppendedData encoding CDATA \"raw\">]>";

struct XmlElement {
    std::string name;
    std::map<std::string, std::string> attributes;
    std::vector<XmlElement> children;
    std::string_view text;  // the first that is not blank
    int line = 0;

    // Null where there is none of this name.
    const XmlElement* child(std::string_view childName) const;
    const std::string* attribute(const std::string& attributeName) const;
};

struct XmlFault : std::runtime_error {
    explicit XmlFault(const std::string& text) : std::runtime_error(printable(text)) {}
};

XmlElement parseXml(std::string_view bytes);

}  // namespace corpuscle::io
