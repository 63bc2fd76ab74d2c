#include "io/xyz.h"

#include <algorithm>
#include <vector>

#include "io/formats.h"

namespace relievo::io {
namespace {

class XyzReader {
 public:
  XyzReader(const Source& source, const XyzLayout& layout)
      : source_(source),
        layout_(layout),
        lines_(source.bytes, layout.data_offset, layout.first_line - 1),
        slots_(layout.columns, XyzLayout::most_wanted) {
    const std::size_t wanted = layout.has_normals ? XyzLayout::most_wanted : 3;
    for (std::size_t i = 0; i < wanted; ++i) slots_[layout.wanted[i]] = i;
  }

  Result<Cloud> read() {
    while (const auto raw = lines_.next()) {
      const std::string_view line = without_comment(*raw);
      if (line.empty()) continue;
      if (cloud_.points.empty()) make_room(source_.bytes.size() / (line.size() + 1));
      if (const auto taken = take(line); !taken) return std::unexpected(taken.error());
    }
    if (layout_.promised_points.value_or(0) > static_cast<std::int64_t>(cloud_.size())) {
      return source_.error_in_line(
          lines_.number() + 1, "expected " + std::to_string(*layout_.promised_points) + " points as line " +
                                   std::to_string(layout_.promising_line) +
                                   " says, found the end of the file after " + std::to_string(cloud_.size()));
    }
    return std::move(cloud_);
  }

 private:
  void make_room(std::size_t points) {
    cloud_.points.reserve(points);
    if (layout_.has_normals) cloud_.normals.reserve(points);
  }

  Result<void> take(std::string_view line) {
    Fields fields(line, layout_.separator);
    std::size_t column = 0;
    for (auto field = fields.next(); field; field = fields.next(), ++column) {
      const std::size_t slot = column < layout_.columns ? slots_[column] : XyzLayout::most_wanted;
      if (slot == XyzLayout::most_wanted) continue;
      const auto value = parse_field(*field, layout_);
      if (!value)
        return fail("expected a number in column " + std::to_string(column + 1) + ", found " +
                    in_quotes(*field));
      values_[slot] = *value;
    }
    if (column != layout_.columns) {
      return fail("expected " + std::to_string(layout_.columns) + " columns as in line " +
                  std::to_string(layout_.first_line) + ", found " + std::to_string(column));
    }
    cloud_.points.emplace_back(values_[0], values_[1], values_[2]);
    if (layout_.has_normals) cloud_.normals.push_back(unit_normal(Vec3(values_[3], values_[4], values_[5])));
    return {};
  }

  Result<void> fail(std::string expected) const {
    return source_.error_in_line(lines_.number(), std::move(expected));
  }

  const Source& source_;
  const XyzLayout& layout_;
  Lines lines_;
  std::vector<std::size_t> slots_;  // where the value of each column goes; most_wanted if it is not read
  std::array<double, XyzLayout::most_wanted> values_ = {};
  Cloud cloud_;
};

std::string to_string(const XyzLayout& layout) {
  return (layout.promised_points ? "PTS text, " : "XYZ text, ") + std::to_string(layout.columns) +
         (layout.has_normals ? " columns with normals" : " columns");
}

}  // namespace

bool is_text(const Source& source) {
  return foreign_format(source).empty();
}

Result<RawCloud> read_text(const Source& source) {
  const auto layout = find_layout(source);
  if (!layout) return std::unexpected(layout.error());
  auto cloud = XyzReader(source, *layout).read();
  if (!cloud) return std::unexpected(std::move(cloud.error()));
  return RawCloud{std::move(*cloud), to_string(*layout)};
}

}  // namespace relievo::io
