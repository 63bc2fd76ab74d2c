// Reads .splat: Gaussian splats in rows of 32 bytes, without a header. A row has the position and the scales
// as floats, then red, green, blue and opacity, and a rotation, as bytes.
#include "io/ply.h"

#include <Eigen/Geometry>
#include <cmath>

#include "io/formats.h"
#include "io/numbers.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::size_t row_bytes = 32, scales_at = 12, colour_at = 24, opacity_at = 27, rotation_at = 28;

Vec3f axis_of_row(const char* row) {
  Vec3 log_scales;
  std::array<double, 4> rotation{};
  for (std::size_t i = 0; i < 3; ++i)
    log_scales[static_cast<Eigen::Index>(i)] = std::log(double{little<float>(row + scales_at + 4 * i)});
  for (std::size_t i = 0; i < 4; ++i) rotation[i] = little<std::uint8_t>(row + rotation_at + i) - 128.;
  return splat_axis(log_scales, rotation);
}

Records records_of(std::uint64_t file_bytes, bool keeps_doubtful) {
  using enum NumberType;
  Records records;
  records.count = file_bytes / row_bytes;
  records.stride = row_bytes;
  records.position = {{{float32, 0}, {float32, 4}, {float32, 8}}};
  records.colour = {{{uint8, colour_at}, {uint8, colour_at + 1}, {uint8, colour_at + 2}}};
  records.axis = axis_of_row;
  if (keeps_doubtful) return records;
  records.left_out = LeftOutRows{[](const char* row) { return little<std::uint8_t>(row + opacity_at) < 128; },
                                 what_splats_leave_out};
  return records;
}

}  // namespace

Vec3f splat_axis(const Vec3& log_scales, const std::array<double, 4>& rotation) {
  constexpr double least_ratio = 1.5;  // least ratio of the middle to the smallest scale
  const auto& [w, x, y, z] = rotation;
  const Eigen::Quaterniond turn(w, x, y, z);
  Eigen::Index thinnest = 0;
  const double smallest = log_scales.minCoeff(&thinnest);
  Vec3 others = log_scales;
  others[thinnest] = log_scales.maxCoeff();
  // The logarithm of the smallest scale may be minus infinity, see no_depth.
  const bool is_flat = others.minCoeff() - smallest >= std::log(least_ratio);
  if (!is_flat || !std::isfinite(turn.norm()) || !(turn.norm() > 0)) return Vec3f::Zero();
  return (turn.normalized() * Vec3::Unit(thinnest)).cast<float>();
}

bool is_splat(const Source& source) {
  return has_ending(source.name, ".splat");
}

Result<RawCloud> read_splat(const Source& source) {
  const std::size_t size = source.bytes.size();
  if (size % row_bytes != 0)
    return source.error_at_byte(size - size % row_bytes,
                                cat("expected a splat of 32 bytes, found ", size % row_bytes));
  const Records records = records_of(size, source.keeps_doubtful);
  RawCloud raw{decode_all(records, source.bytes.data()), "splat, Gaussian splats"};
  raw.leave_out(count_left_out(records, source.bytes.data(), records.count), what_splats_leave_out);
  return raw;
}

}  // namespace relievo::io
