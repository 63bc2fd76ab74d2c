// A reader of the XML in E57 and 3MF files: elements, attributes and texts, as views of the given bytes. Document
// types and entities are not supported, because the numbers that are read do not need them.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "io/readers.h"

namespace relievo::io {

struct XmlElement {
  std::string_view name;        // with its prefix, "nor:normalX"
  std::string_view attributes;  // the text between the name and the end of the tag
  std::string_view text;        // its first text or CDATA section, without blanks at the ends
  std::size_t end = 0;          // index of the first element after this one and its descendants

  // Returns the value of the attribute; empty if there is none.
  std::string_view attribute(std::string_view wanted) const;
};

// The elements in the order of the text, the root first. The descendants of element i are i + 1 to
// elements[i].end - 1. The text must outlive the elements.
using XmlElements = std::vector<XmlElement>;

// Reads a whole document. Errors name `source` and the line of the XML.
Result<XmlElements> parse_xml(std::string_view text, const Source& source);

// Returns the index of the child of that name; 0 if there is none, because element 0 is the root and no
// child.
std::size_t find_child(const XmlElements& elements, std::size_t parent, std::string_view name);

}  // namespace relievo::io
