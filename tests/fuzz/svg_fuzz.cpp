// Fuzz target of drawings. It reads SVG files, and computes the points of walls along small drawings.
#include <cstdlib>

#include "fuzz/fuzz_program.h"
#include "lettering/ornament_shapes.h"
#include "relievo/io/svg.h"

void run_target(std::string_view input) {
  using namespace relievo;
  auto outlines = read_svg(input, "a.svg");
  if (!outlines) {
    if (outlines.error().input != "a.svg" || outlines.error().expected.empty()) std::abort();
    return;
  }
  std::size_t corners = 0;
  for (const auto& outline : *outlines) corners += outline.size();
  constexpr std::size_t most_corners = 2000;
  if (corners > most_corners) return;
  Ornament drawing;
  drawing.kind = OrnamentKind::drawing;
  drawing.outlines = *std::move(outlines);
  drawing.size_mm = 20;
  const OrnamentFrame frame{.inner = {{0, 0}, {50, 0}, {50, 50}, {0, 50}}};
  const auto shapes = ornament_shapes({&drawing, 1}, frame);
  if (!shapes) return;
  const ShapePoints points = points_of(shapes->front());
  for (const Vec3& p : points.points)
    if (!p.allFinite() || !(p.z() >= 0 && p.z() <= points.most_mm)) std::abort();
  for (const auto& [a, b] : points.edges)
    if (a >= points.points.size() || b >= points.points.size()) std::abort();
}
