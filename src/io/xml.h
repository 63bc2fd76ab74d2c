// Reads the XML in E57, 3MF and SVG files: elements, attributes and texts, as views of the given bytes. A
// document type is skipped, and entities are not replaced.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "io/readers.h"

namespace relievo::io {

struct XmlElement {
  std::string_view name;        // including its prefix: "nor:normalX"
  std::string_view attributes;  // the text between the name and the end of the tag
  std::string_view text;        // first text or CDATA section, without blanks at its ends
  std::size_t end = 0;          // index of the first element after this one and its descendants

  // Returns the value of an attribute; no text if there is none.
  std::string_view attribute(std::string_view wanted) const;
};

// The elements in the order of the text, beginning with the root. The descendants of element i are i + 1 to
// elements[i].end - 1. The text must outlive the elements.
using XmlElements = std::vector<XmlElement>;

// Reads a whole document. Errors name `source` and the line of the XML.
Result<XmlElements> parse_xml(std::string_view text, const Source& source);

// Returns the name without its namespace prefix, which documents choose: "color" for "m:color".
inline std::string_view local_name(std::string_view name) {
  return name.substr(name.find(':') + 1);
}

// Returns the index of the child with that name. Returns 0 if there is none; the root, element 0, is never a
// child.
std::size_t find_child(const XmlElements& elements, std::size_t parent, std::string_view name);

}  // namespace relievo::io
