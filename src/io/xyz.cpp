#include "io/xyz.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/formats.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// Returns colours as bytes. The largest value determines their range: 1, 255 or 65535. Returns no colours if
// it is larger.
std::vector<Colour> in_bytes(const std::vector<Vec3f>& values) {
  float largest = 0;
  for (const Vec3f& value : values) largest = std::max(largest, value.maxCoeff());
  if (!(largest <= 65535)) return {};
  const float scale = largest <= 1 ? 255.F : largest <= 255 ? 1.F : 1 / 257.F;
  std::vector<Colour> colours(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    for (Eigen::Index c = 0; c < 3; ++c) {
      const float value = std::clamp(scale * values[i][c], 0.F, 255.F);
      colours[i][static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(value));
    }
  return colours;
}

class XyzReader {
 public:
  XyzReader(const Source& source, const XyzLayout& layout)
      : layout_(layout),
        lines_(source, layout.data_offset, layout.first_line - 1),
        slots_(layout.columns, XyzLayout::most_wanted) {
    const auto take_slots = [&](std::size_t first) {
      for (std::size_t i = first; i < first + 3; ++i) slots_[layout.wanted[i]] = i;
    };
    take_slots(0);
    if (layout.has_normals) take_slots(XyzLayout::first_normal);
    if (layout.has_colours) take_slots(XyzLayout::first_colour);
  }

  Result<Cloud> read() {
    while (const auto raw = lines_.next()) {
      const std::string_view line = without_comment(*raw);
      if (line.empty()) continue;
      if (cloud_.points.empty()) make_room(lines_.source().bytes.size() / (line.size() + 1));
      RELIEVO_CHECK(take(line));
    }
    if (layout_.promised_points.value_or(0) > static_cast<std::int64_t>(cloud_.size()))
      return lines_.fail_at_end(
          cat(*layout_.promised_points, " points as line ", layout_.promising_line, " says"),
          cat(" after ", cloud_.size()));
    if (layout_.has_colours) cloud_.colours = in_bytes(colours_);
    return std::move(cloud_);
  }

 private:
  void make_room(std::size_t points) {
    cloud_.points.reserve(points);
    if (layout_.has_normals) cloud_.normals.reserve(points);
    if (layout_.has_colours) colours_.reserve(points);
  }

  Result<void> take(std::string_view line) {
    Fields fields(line, layout_.separator);
    std::size_t column = 0;
    for (auto field = fields.next(); field; field = fields.next(), ++column) {
      const std::size_t slot = column < layout_.columns ? slots_[column] : XyzLayout::most_wanted;
      if (slot == XyzLayout::most_wanted) continue;
      const auto value = parse_field(*field, layout_);
      const bool is_colour = slot >= XyzLayout::first_colour;  // a point without colour is black
      if (!value && !is_colour)
        return lines_.fail(cat("expected a number in column ", column + 1, ", found ", in_quotes(*field)));
      values_[slot] = value.value_or(0);
    }
    if (column != layout_.columns)
      return lines_.fail(
          cat("expected ", layout_.columns, " columns as in line ", layout_.first_line, ", found ", column));
    cloud_.points.emplace_back(values_[0], values_[1], values_[2]);
    if (layout_.has_normals) cloud_.normals.push_back(unit_normal(Vec3(values_[3], values_[4], values_[5])));
    if (layout_.has_colours) colours_.push_back(Vec3(values_[6], values_[7], values_[8]).cast<float>());
    return {};
  }

  const XyzLayout& layout_;
  SourceLines lines_;
  std::vector<std::size_t> slots_;  // index in values_ of each column; most_wanted if it is not read
  std::array<double, XyzLayout::most_wanted> values_ = {};
  Cloud cloud_;
  std::vector<Vec3f> colours_;  // as in the file
};

std::string to_string(const XyzLayout& layout) {
  const std::string with = layout.has_normals && layout.has_colours ? " with normals and colours"
                           : layout.has_normals                     ? " with normals"
                           : layout.has_colours                     ? " with colours"
                                                                    : "";
  return (layout.promised_points ? "PTS text, " : "XYZ text, ") + std::to_string(layout.columns) +
         " columns" + with;
}

}  // namespace

bool is_text(const Source& source) {
  return foreign_format(source).empty();
}

Result<RawCloud> read_text(const Source& source) {
  RELIEVO_TRY(const auto layout, find_layout(source));
  RELIEVO_TRY(auto cloud, XyzReader(source, layout).read());
  return RawCloud{std::move(cloud), to_string(layout)};
}

}  // namespace relievo::io
