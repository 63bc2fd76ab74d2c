// The colours of 3MF documents: base materials, and the groups of colours of the materials extension. Tested by
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
  // Takes the colours of a resource; other resources than the two change nothing. The document must outlive this.
  void take(const XmlElements& elements, std::size_t resource);

  bool is_empty() const { return groups_.empty(); }

  // Returns the colour of a corner, from 0 to 2, of a triangle in an object; nothing if it has none that is known.
  std::optional<Colour> of_corner(const XmlElement& object, const XmlElement& triangle,
                                  std::size_t corner) const;

 private:
  std::map<std::string_view, std::vector<Colour>> groups_;  // by the ids of the resources
};

}  // namespace relievo::io
