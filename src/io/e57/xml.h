// A reader of the XML in E57 files: elements, attributes and texts, as views of the given bytes. It knows neither
// document types nor entities, which the numbers that are read do not need.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "io/readers.h"

namespace relievo::io {

struct XmlElement {
  std::string_view name;        // with its prefix, "nor:normalX"
  std::string_view attributes;  // the text between the name and the end of the tag
  std::string_view text;        // the first text or CDATA section in it, without blanks at its ends
  std::size_t end = 0;          // the number of the first element after it and all that it contains

  // Returns the value of the attribute, empty if there is none.
  std::string_view attribute(std::string_view wanted) const;
};

// The elements in the order of the text, the root first. The elements that element i contains are i + 1 to
// elements[i].end - 1. `text` must outlive it.
using XmlElements = std::vector<XmlElement>;

// Reads a whole document. Errors name `source` and the line of the XML.
Result<XmlElements> parse_xml(std::string_view text, const Source& source);

// Returns the number of the child of that name, or 0, which no child has.
std::size_t find_child(const XmlElements& elements, std::size_t parent, std::string_view name);

}  // namespace relievo::io
