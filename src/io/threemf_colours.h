// Reads the colours of 3MF documents: base materials, and colour groups of the materials extension. Tested by
// tests/io/threemf_test.cpp.
#pragma once

#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "io/xml.h"
#include "relievo/core/types.h"

namespace relievo::io {

class ThreeMfColours {
 public:
  // Adds the colours of a resource, if it is a group of base materials or colours. The document must outlive
  // this object.
  void take(const XmlElements& elements, std::size_t resource);

  bool is_empty() const { return groups_.empty(); }

  // Returns the colour of a corner, 0 to 2, of a triangle in an object; nothing if its colour is missing or
  // unknown.
  std::optional<Colour> of_corner(const XmlElement& object, const XmlElement& triangle,
                                  std::size_t corner) const;

 private:
  std::map<std::string_view, std::vector<Colour>> groups_;  // by resource id
};

}  // namespace relievo::io
