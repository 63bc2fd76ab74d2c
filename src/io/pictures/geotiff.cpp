// Reads tags and keys of OGC GeoTIFF 1.1.
#include "io/pictures/geotiff.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace relievo::io {
namespace {

constexpr std::uint32_t pixel_scale_tag = 33550, tie_point_tag = 33922, matrix_tag = 34264, keys_tag = 34735;
constexpr std::uint16_t model_type_key = 1024, length_unit_key = 3076;
constexpr std::uint16_t geographic_model = 2, foot = 9002, us_survey_foot = 9003;

// Returns the numbers of a tag; nothing if the tag is missing or has numbers of another type.
template <typename T>
std::span<const T> numbers_of(TIFF* tiff, std::uint32_t tag, TIFFDataType type) {
  const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
  std::uint32_t count = 0;
  const T* numbers = nullptr;
  if (!field || TIFFFieldDataType(field) != type || !TIFFFieldPassCount(field)) return {};
  if (TIFFGetField(tiff, tag, &count, &numbers) != 1 || !numbers) return {};
  return {numbers, count};
}

// Returns the value of a key. The key directory begins with four numbers. Then there are four numbers for
// each key: the key, the tag with the value, the number of values, and the value if there is no tag.
std::uint16_t value_of_key(TIFF* tiff, std::uint16_t key) {
  const auto keys = numbers_of<std::uint16_t>(tiff, keys_tag, TIFF_SHORT);
  for (std::size_t i = 4; i + 4 <= keys.size(); i += 4)
    if (keys[i] == key && keys[i + 1] == 0) return keys[i + 3];
  return 0;
}

// The size of a pixel in the file's unit, and the second coordinate of the middle row.
struct PixelPlace {
  Vec2 size;
  double middle_row = 0;
};

std::optional<PixelPlace> find_place(TIFF* tiff, std::uint32_t rows) {
  const double half = rows / 2.0;
  const auto scale = numbers_of<double>(tiff, pixel_scale_tag, TIFF_DOUBLE),
             tie = numbers_of<double>(tiff, tie_point_tag, TIFF_DOUBLE),
             matrix = numbers_of<double>(tiff, matrix_tag, TIFF_DOUBLE);
  if (scale.size() >= 2) {
    const double middle = tie.size() >= 6 ? tie[4] - (half - tie[1]) * scale[1] : 0;
    return PixelPlace{Vec2(scale[0], scale[1]), middle};
  }
  if (matrix.size() < 16) return std::nullopt;
  const Vec2 size(std::hypot(matrix[0], matrix[4]), std::hypot(matrix[1], matrix[5]));
  return PixelPlace{size, matrix[7] + half * matrix[5]};
}

}  // namespace

Vec2 metres_of_degrees(const Vec2& degrees, double latitude_deg) {
  // The radius is a mean, because the earth is not a sphere.
  constexpr double earth_radius_m = 6371008.8, steepest_deg = 89;
  constexpr double radians = std::numbers::pi / 180;
  const double latitude = radians * std::clamp(latitude_deg, -steepest_deg, steepest_deg);
  return earth_radius_m * radians * Vec2(degrees.x() * std::cos(latitude), degrees.y());
}

Vec2 geotiff_pixel_size(TIFF* tiff, std::uint32_t rows) {
  const auto place = find_place(tiff, rows);
  if (!place || !place->size.allFinite() || !std::isfinite(place->middle_row)) return Vec2::Zero();
  if (value_of_key(tiff, model_type_key) == geographic_model)
    return metres_of_degrees(place->size, place->middle_row);
  const std::uint16_t unit = value_of_key(tiff, length_unit_key);
  return (unit == foot ? .3048 : unit == us_survey_foot ? 1200.0 / 3937 : 1) * place->size;
}

}  // namespace relievo::io
