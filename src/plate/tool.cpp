#include "relievo/plate/tool.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/angle.h"
#include "core/number.h"
#include "geometry/image_filters.h"
#include "geometry/weld.h"
#include "plate/height_field.h"
#include "relievo/core/length.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

constexpr float nowhere = -std::numeric_limits<float>::infinity();

std::unexpected<Error> fail(std::string_view text) {
  return option_error("tool",
                      cat("expected ball:DIAMETER or flat:DIAMETER with 0.01 to 1000 mm, v:ANGLE with 1 to "
                          "170 degrees, or v:ANGLE:TIP with a diameter in mm, found '",
                          text, "'"));
}

std::optional<double> in_range(double value, double least, double most) {
  return value >= least && value <= most ? std::optional(value) : std::nullopt;
}

std::optional<double> length_in(std::string_view text, LengthUnit bare, double least_mm) {
  const Result<double> mm = parse_length(text, bare);
  return mm ? in_range(*mm, least_mm, 1000) : std::nullopt;
}

std::optional<double> angle_in(std::string_view text) {
  const auto [value, end, error] = parse_double(text);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  return is_whole ? in_range(value, 1, 170) : std::nullopt;
}

double half_angle(const Tool& tool) {
  return to_radians(tool.angle_deg / 2);
}

// Returns the largest radius of the tool between its tip and the height `height_mm` above the tip.
double radius_of(const Tool& tool, double height_mm) {
  if (tool.kind != Tool::Kind::v) return tool.diameter_mm / 2;
  return tool.tip_mm / 2 + height_mm * std::tan(half_angle(tool));
}

struct Span {
  float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
};

Span span_of(const std::vector<float>& heights) {
  Span span;
  for (const float z : heights)
    if (z == z) span.lowest = std::min(span.lowest, z), span.highest = std::max(span.highest, z);
  return span;
}

constexpr double least_reach_tolerance_mm = .01;

// Sums over the samples of a block.
struct Count {
  std::size_t front = 0, reached = 0;
  float largest = 0;
};

Count count_reached(const Image<float>& residual, double tolerance_mm) {
  return parallel_reduce(
      residual.pixels.size(), Count{},
      [&](std::size_t begin, std::size_t end) {
        Count count;
        for (std::size_t i = begin; i < end; ++i) {
          const float left = residual.pixels[i];
          if (left != left) continue;
          ++count.front;
          count.reached += static_cast<double>(left) <= tolerance_mm;
          count.largest = std::max(count.largest, left);
        }
        return count;
      },
      [](const Count& a, const Count& b) {
        return Count{a.front + b.front, a.reached + b.reached, std::max(a.largest, b.largest)};
      });
}

Image<float> difference(const Image<float>& a, const Image<float>& b) {
  Image<float> out = a;
  for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] -= b.pixels[i];
  return out;
}

}  // namespace

Result<Tool> parse_tool(std::string_view text, LengthUnit bare) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return fail(text);
  const std::string_view kind = text.substr(0, colon);
  std::string_view size = text.substr(colon + 1), tip = "0";
  if (kind == "v" && size.find(':') != std::string_view::npos) {
    tip = size.substr(size.find(':') + 1);
    size = size.substr(0, size.find(':'));
  }
  Tool tool;
  if (kind == "v") {
    const auto angle = angle_in(size), tip_mm = length_in(tip, bare, 0);
    if (!angle || !tip_mm) return fail(text);
    tool = {Tool::Kind::v, 0, *angle, *tip_mm};
  } else {
    const auto diameter = length_in(size, bare, .01);
    if (!diameter || (kind != "ball" && kind != "flat")) return fail(text);
    tool = {kind == "ball" ? Tool::Kind::ball : Tool::Kind::flat, *diameter};
  }
  return tool;
}

std::string text_of(const Tool& tool) {
  if (tool.kind != Tool::Kind::v)
    return cat(tool.kind == Tool::Kind::ball ? "ball:" : "flat:", tool.diameter_mm, "mm");
  return cat("v:", tool.angle_deg, tool.tip_mm > 0 ? cat(":", tool.tip_mm, "mm") : std::string());
}

double tool_profile(const Tool& tool, double distance_mm) {
  const double r = std::abs(distance_mm);
  const auto ball = [&](double radius) { return radius - std::sqrt(std::max(0.0, radius * radius - r * r)); };
  if (tool.kind == Tool::Kind::v) {
    // The cone begins where it touches the ball at the tip.
    const double tip = tool.tip_mm / 2, angle = half_angle(tool), touching = tip * std::cos(angle);
    if (r <= touching) return ball(tip);
    return tip * (1 - std::sin(angle)) + (r - touching) / std::tan(angle);
  }
  if (r > tool.diameter_mm / 2) return std::numeric_limits<double>::infinity();
  return tool.kind == Tool::Kind::flat ? 0 : ball(tool.diameter_mm / 2);
}

Image<float> close_by_tool(const Image<float>& heights, double step_mm, const Tool& tool) {
  const Span span = span_of(heights.pixels);
  if (!(span.highest >= span.lowest)) return heights;
  const double radius = radius_of(tool, static_cast<double>(span.highest - span.lowest));
  const int reach =
      std::min(static_cast<int>(radius / step_mm + 1e-9), std::max(heights.width, heights.height) / 2);
  const Profile profile(reach, [&](int x, int y) {
    // Rounding could make the distance of a sample at the radius slightly larger than the radius. The factor
    // 1 - 1e-12 prevents that.
    const double distance = std::hypot(x, y) * step_mm * (1 - 1e-12);
    return distance > radius ? std::numeric_limits<float>::infinity()
                             : static_cast<float>(tool_profile(tool, distance));
  });
  // The lowest height of the tool's tip at each position. The positions extend beyond the image on all sides.
  Image<float> hanging = dilate(heights, profile, reach);
  // The tool skips positions that have no heights near them.
  for (float& z : hanging.pixels) z = z > nowhere ? -z : nowhere;
  const Image<float> left = dilate(hanging, profile, -reach);
  Image<float> closed = heights;
  for (std::size_t i = 0; i < closed.pixels.size(); ++i)
    if (closed.pixels[i] == closed.pixels[i]) closed.pixels[i] = std::max(closed.pixels[i], -left.pixels[i]);
  return closed;
}

ToolReach measure_reach(const Solid& solid, const Tool& tool) {
  const Box box = used_box(solid.points, std::span(solid.triangles).first(solid.front_triangles));
  ToolReach reach;
  if (box.is_empty()) return reach;
  HeightField field = front_samples(solid, box, tool);
  reach.mm_per_sample = field.mm_per_pixel;
  reach.tolerance_mm = std::max(least_reach_tolerance_mm, field.mm_per_pixel / 8);
  reach.heights_mm = std::move(field.z);
  reach.residual_mm =
      difference(close_by_tool(reach.heights_mm, reach.mm_per_sample, tool), reach.heights_mm);
  const Count count = count_reached(reach.residual_mm, reach.tolerance_mm);
  reach.largest_residual_mm = static_cast<double>(count.largest);
  if (count.front > 0)
    reach.reached_share = static_cast<double>(count.reached) / static_cast<double>(count.front);
  return reach;
}

}  // namespace relievo
