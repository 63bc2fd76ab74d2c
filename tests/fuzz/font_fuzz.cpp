// Fuzz target of fonts: sets texts of several scripts in a font that consists of the input's bytes.
#include <cstdlib>
#include <memory>

#include "fuzz/fuzz_program.h"
#include "lettering/ornament_shapes.h"

void run_target(std::string_view input) {
  using namespace relievo;
  const auto bytes = std::as_bytes(std::span(input));
  const auto font =
      std::make_shared<const FontFile>("a.ttf", std::vector<std::byte>(bytes.begin(), bytes.end()));
  for (const char* const text : {"AV fi", "سلام 12", "क्षि"}) {
    const auto line = shape_line({.text = text, .font = font}, .01);
    if (!line && line.error().expected.empty()) std::abort();
    if (!line) continue;
    for (const GlyphCluster& cluster : line->clusters)
      for (const auto& outline : cluster.outlines)
        for (const Vec2& p : outline)
          if (!p.allFinite()) std::abort();
  }
}
