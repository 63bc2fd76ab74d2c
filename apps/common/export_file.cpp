#include "common/export_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/files.h"
#include "relievo/core/choice.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/io/write.h"

namespace relievo::app {
namespace {

std::vector<std::byte> as_3mf(const Solid& solid) {
  const std::pair<std::string, std::string> metadata[] = {{"Title", "Relief"},
                                                          {"Application", cat("relievo ", version)}};
  return write_3mf(solid, metadata);
}

constexpr std::array<FileFormat, 7> formats{
    {{"stl", ".stl", "model/stl", "STL", "printing and milling, in millimetres", write_stl},
     {"3mf", ".3mf", "model/3mf", "3MF", "printing, with units", as_3mf},
     {"ply", ".ply", "application/octet-stream", "PLY", "smaller than STL: corners are shared", write_ply},
     {"obj", ".obj", "model/obj", "OBJ", "as text, for 3D programs", write_obj},
     {"heightmap", "-heights.png", "image/png", "Height map", "16-bit PNG for CNC and engraving"},
     {"tiff", "-heights.tif", "image/tiff", "Heights in mm", "32-bit TIFF"},
     {"preview", ".png", "image/png", "Picture", "front and oblique view"}}};

constexpr int most_px = 16384;  // largest width and height of a map, as for the option heightmap-size
constexpr std::array<Choice<bool>, 2> high_choices{{{"white", false}, {"black", true}}};
constexpr std::array<Choice<int>, 3> bits_choices{{{"8", 8}, {"16", 16}, {"32", 32}}};

constexpr double mm_per_ten_inches = 254;  // a whole number, so that 254 dpi are exactly 0.1 mm

using Scale = std::vector<std::pair<std::string, std::string>>;

Result<void> take_pixel(const HeightMapTexts& texts, HeightMapOrder& order) {
  const bool has_dpi = !texts.dpi.empty();
  if (has_dpi && !texts.pixel.empty()) return option_error("dpi", "expected no pixel beside it, found both");
  const std::string_view text = has_dpi ? texts.dpi : texts.pixel;
  if (text.empty()) return {};
  const bool is_number = text.find_first_not_of("0123456789.,") == std::string_view::npos;
  const double length = parse_length(text, has_dpi ? LengthUnit::mm : order.unit).value_or(0);
  const double mm = !has_dpi ? length : is_number && length > 0 ? mm_per_ten_inches / (10 * length) : 0;
  constexpr double least_mm = .001, most_mm = 100;
  if (!(mm >= least_mm && mm <= most_mm))
    return has_dpi ? option_error("dpi", cat("expected a number from 0.254 to 25400, found '", text, "'"))
                   : option_error("pixel", cat("expected a length from 0.001 to 100 mm, found '", text, "'"));
  order.mm_per_pixel = mm;
  return {};
}

template <typename E, std::size_t n>
Result<void> take_choice(const char* flag, const std::string& text, const std::array<Choice<E>, n>& choices,
                         E& to) {
  if (text.empty()) return {};
  RELIEVO_TRY(to, parse_choice(flag, text, choices));
  return {};
}

// Returns the scale of the map, under the keys that the files use for it.
Scale scale_of(const HeightMap& map, const MadeRelief& made, LengthUnit unit) {
  Scale scale{{"mm_per_pixel", cat(map.mm_per_pixel)}, {"mm_per_grey", cat(map.mm_per_grey)}};
  if (unit == LengthUnit::inch) {
    scale.emplace_back("in_per_pixel", cat(map.mm_per_pixel / mm_per_inch));
    scale.emplace_back("in_per_grey", cat(map.mm_per_grey / mm_per_inch));
  }
  if (const auto& wrap = made.report.wrap) {
    scale.emplace_back("diameter_mm", cat(wrap->diameter_mm));
    scale.emplace_back("mm_per_degree", cat(wrap->mm_per_degree));
  }
  return scale;
}

std::vector<std::byte> grey_file(const HeightMap& map, const Scale& scale, bool is_tiff) {
  if (is_tiff) {
    std::string description = "heights in greys";
    for (const auto& [key, value] : scale) description += cat(", ", key, "=", value);
    return write_tiff(map, description);
  }
  const PngLabel label{scale, map.mm_per_pixel};
  return map.bits == 8 ? write_labelled_png(in_8_bits(map), label) : write_png(map.image, label);
}

std::vector<std::byte> millimetre_file(HeightsMm heights, const MadeRelief& made) {
  if (const auto& wrap = made.report.wrap)
    heights.note = cat("diameter_mm=", wrap->diameter_mm, ", mm_per_degree=", wrap->mm_per_degree);
  return write_tiff(heights);
}

nlohmann::json facts_of(const HeightsMm& heights, int bits) {
  return {{"pixels", {heights.image.width, heights.image.height}},
          {"mm_per_pixel", heights.mm_per_pixel},
          {"bits", bits},
          {"area", name_in(map_area_choices, heights.options.area)},
          {"zero", name_in(map_zero_choices, heights.options.zero)},
          {"high", name_in(high_choices, heights.options.is_inverted)},
          {"span_mm", heights.span_mm}};
}

Result<void> check_size(const MadeRelief& made, const HeightMapOrder& order) {
  if (!(order.mm_per_pixel > 0)) return {};
  const Vec3 size = Box::of((made.report.wrap ? made.flat : made.solid).points).size();
  const double least = std::max(size.x(), size.y()) / most_px;
  if (order.mm_per_pixel >= least) return {};
  return option_error("pixel", cat("expected at least ", std::ceil(least * 1e4) / 1e4, " mm for at most ",
                                   most_px, " pixels, found ", order.mm_per_pixel));
}

}  // namespace

std::span<const FileFormat> file_formats() {
  return formats;
}

Result<const FileFormat*> find_format(std::string_view name) {
  std::vector<std::string_view> names;
  for (const FileFormat& format : file_formats()) {
    if (format.name == name) return &format;
    names.push_back(format.name);
  }
  return not_one_of("format", names, name);
}

const FileFormat* find_solid_format(std::string_view ending) {
  const Result<const FileFormat*> format = find_format(ending);
  return format && (*format)->write_solid ? *format : nullptr;
}

std::vector<std::string_view> solid_endings() {
  std::vector<std::string_view> endings;
  for (const FileFormat& format : formats)
    if (format.write_solid) endings.push_back(format.ending);
  return endings;
}

nlohmann::json format_list() {
  nlohmann::json list = nlohmann::json::array();
  for (const FileFormat& format : formats)
    list.push_back({{"name", format.name},
                    {"label", format.label},
                    {"use", format.use},
                    {"ending", format.ending},
                    {"type", format.type}});
  return list;
}

Image8 preview_of(const MadeRelief& made, PreviewOptions options) {
  const bool is_lithophane = made.report.form == Form::lithophane;
  if (is_lithophane && options.material == Material::plaster) options.material = Material::porcelain;
  const std::optional<ReliefReport::Wrapped>& wrap = made.report.wrap;
  if (wrap && (wrap->is_inside || is_lithophane)) options.flat = &made.flat;
  constexpr double half_turn_deg = 180;
  if (!wrap || !wrap->is_inside || wrap->turn_deg <= half_turn_deg)
    return render_preview(made.solid, options);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : made.solid.points) {
    const double across = wrap->across.dot(p.head<2>());
    low = std::min(low, across), high = std::max(high, across);
  }
  options.nearest_mm = (high - low) / 2;  // cuts at the wrap's axis, and shows only the farther half
  return render_preview(made.solid, options);
}

Result<ExportedFile> export_file(const MadeRelief& made, const FileFormat& format, const ExportOrder& order) {
  const auto bytes = [&]() -> Result<std::vector<std::byte>> {
    if (format.write_solid) return format.write_solid(made.solid);
    if (format.name == "preview") return write_png(preview_of(made, {.material = order.material}));
    RELIEVO_TRY(HeightMapFile map, height_map_file(made, order.map));
    return std::move(map.bytes);
  };
  RELIEVO_TRY(const std::vector<std::byte> content, bytes());
  return ExportedFile{std::string(text_in(content)), std::string(format.type)};
}

Result<void> take_texts(const HeightMapTexts& texts, HeightMapOrder& order) {
  RELIEVO_CHECK(take_pixel(texts, order));
  RELIEVO_CHECK(take_choice("heightmap-bits", texts.bits, bits_choices, order.bits));
  RELIEVO_CHECK(take_choice("heightmap-area", texts.area, map_area_choices, order.area));
  RELIEVO_CHECK(take_choice("heightmap-zero", texts.zero, map_zero_choices, order.zero));
  RELIEVO_CHECK(take_choice("heightmap-high", texts.high, high_choices, order.is_inverted));
  if (!order.is_tiff && order.bits == 32)
    return option_error("heightmap-bits", "expected 8 or 16 for a .png, found 32");
  return {};
}

Result<HeightMapTexts> height_map_texts(const nlohmann::json& json) {
  HeightMapTexts texts;
  for (const HeightMapFlag& flag : height_map_flags) {
    const auto found = json.find(flag.name);
    if (found == json.end()) continue;
    if (!found->is_string()) return option_error(flag.name, "expected a text");
    texts.*flag.text = found->get<std::string>();
  }
  return texts;
}

Result<HeightMapFile> height_map_file(const MadeRelief& made, const HeightMapOrder& order) {
  RELIEVO_CHECK(check_size(made, order));
  const HeightsMm heights = make_heights_mm(made.report.wrap ? made.flat : made.solid, order);
  if (heights.span_mm <= 0 && order.zero == MapZero::ground)
    return option_error("heightmap-zero",
                        "expected lowest, as nothing of this piece lies above its ground, found ground");
  const int bits = order.effective_bits();
  nlohmann::json facts = facts_of(heights, bits);
  if (bits == 32) return HeightMapFile{millimetre_file(heights, made), std::move(facts)};
  const HeightMap map = grey_levels(heights, bits);
  facts["mm_per_grey"] = map.mm_per_grey;
  facts["greys"] = count_greys(map);
  return HeightMapFile{grey_file(map, scale_of(map, made, order.unit), order.is_tiff), std::move(facts)};
}

std::string line_of(const nlohmann::json& map) {
  const auto& pixels = map.at("pixels");
  const std::string size = cat(pixels.at(0).get<int>(), " x ", pixels.at(1).get<int>(), " pixels of ",
                               map.at("mm_per_pixel").get<double>(), " mm, ");
  if (!map.contains("greys")) return cat("height map: ", size, "heights in mm");
  return cat("height map: ", size, map.at("bits").get<int>(), " bits, ", map.at("greys").get<int>(),
             " greys used, ", map.at("mm_per_grey").get<double>(), " mm each");
}

}  // namespace relievo::app
