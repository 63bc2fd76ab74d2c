// Reads E57 1.0 (ASTM E2807-11): the points of all scans, transformed by the poses of the scans. Pictures and
// intensities are not read.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "io/e57/pages.h"
#include "io/formats.h"
#include "io/text.h"
#include "io/xml.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// The description of one scan in the XML of an E57 file.
struct E57Scan {
  using Triple = std::array<std::size_t, 3>;  // indices of columns

  E57Section section;
  std::vector<PackedColumn> columns;
  Triple position = {};  // columns of x, y and z, or of range, azimuth and elevation
  bool is_spherical = false;
  std::optional<Triple> normal, colour;  // colours scaled to [0, 255]
  std::optional<std::size_t> invalid;    // column that is not 0 where the scanner could not measure a point
  // Rotation from the scanner's axes to the file's axes.
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  Vec3 origin = Vec3::Zero();  // translation after the rotation
};

// Parses the description of a scan, a child of the element data3D. Errors name the element.
class ScanParser {
 public:
  ScanParser(const Source& source, const XmlElements& elements, std::size_t scan)
      : source_(source), elements_(elements), element_(scan) {}

  Result<E57Scan> parse() {
    const std::size_t points = find_child(elements_, element_, "points");
    const std::size_t prototype = points == 0 ? 0 : find_child(elements_, points, "prototype");
    if (prototype == 0) return error("points", "expected a compressed vector with a prototype, found none");
    RELIEVO_TRY(scan_.section.physical_offset, count_in(points, "fileOffset"));
    RELIEVO_TRY(scan_.section.rows, count_in(points, "recordCount"));
    for (std::size_t i = prototype + 1; i < elements_[prototype].end; ++i)
      if (elements_[i].end == i + 1) RELIEVO_CHECK(add_column(i));
    RELIEVO_CHECK(choose_columns());
    scale_colours();
    take_pose();
    return std::move(scan_);
  }

 private:
  std::unexpected<Error> error(std::string_view element, std::string expected) const {
    return source_.error(cat("element ", printable(element)), std::move(expected));
  }

  Result<std::uint64_t> count_in(std::size_t element, std::string_view attribute) const {
    const std::string_view text = elements_[element].attribute(attribute);
    const std::optional<std::int64_t> number = parse_integer(text);
    if (number && *number >= 0) return static_cast<std::uint64_t>(*number);
    return error(elements_[element].name,
                 cat("expected a number as ", attribute, ", found ", in_quotes(text)));
  }

  Result<std::int64_t> limit(std::size_t element, std::string_view attribute, std::int64_t unset) const {
    const std::string_view text = elements_[element].attribute(attribute);
    if (text.empty()) return unset;
    if (const std::optional<std::int64_t> number = parse_integer(text)) return *number;
    return error(elements_[element].name,
                 cat("expected an integer as ", attribute, ", found ", in_quotes(text)));
  }

  Result<void> add_column(std::size_t i) {
    const XmlElement& element = elements_[i];
    const std::string_view type = element.attribute("type");
    PackedColumn column{.name = element.name};
    if (type == "Float") {
      const bool is_single = element.attribute("precision") == "single";
      column.kind = is_single ? PackedColumn::Kind::float32 : PackedColumn::Kind::float64;
      column.bits = is_single ? 32 : 64;
    } else if (type == "Integer" || type == "ScaledInteger") {
      using Limits = std::numeric_limits<std::int64_t>;
      RELIEVO_TRY(column.minimum, limit(i, "minimum", Limits::min()));
      RELIEVO_TRY(const std::int64_t maximum, limit(i, "maximum", Limits::max()));
      if (maximum < column.minimum)
        return error(element.name, cat("expected a maximum that is not below the minimum, ", column.minimum,
                                       ", found ", maximum));
      column.bits = static_cast<unsigned>(
          std::bit_width(static_cast<std::uint64_t>(maximum) - static_cast<std::uint64_t>(column.minimum)));
      if (type == "ScaledInteger") {
        column.scale = parse_number(element.attribute("scale")).value_or(1);
        column.shift = parse_number(element.attribute("offset")).value_or(0);
      }
    } else {
      return error(element.name,
                   cat("expected a type Integer, ScaledInteger or Float, found ", in_quotes(type)));
    }
    scan_.columns.push_back(std::move(column));
    elements_of_columns_.push_back(i);
    return {};
  }

  std::optional<std::size_t> find(std::string_view name, bool with_any_prefix = false) const {
    for (std::size_t i = 0; i < scan_.columns.size(); ++i) {
      const std::string_view own = scan_.columns[i].name;
      if ((with_any_prefix ? local_name(own) : own) == name) return i;
    }
    return std::nullopt;
  }

  std::optional<E57Scan::Triple> find_triple(const std::array<const char*, 3>& names,
                                             bool with_prefix = false) {
    E57Scan::Triple triple{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = find(names[i], with_prefix);
      if (!found) return std::nullopt;
      triple[i] = *found;
    }
    for (const std::size_t column : triple) scan_.columns[column].is_wanted = true;
    return triple;
  }

  std::string names() const {
    std::string all;
    for (const PackedColumn& column : scan_.columns)
      all += (all.empty() ? "" : ", ") + std::string(column.name);
    return all.empty() ? "none" : printable(all, 80);
  }

  Result<void> choose_columns() {
    auto position = find_triple({"cartesianX", "cartesianY", "cartesianZ"});
    scan_.is_spherical = !position;
    if (!position) position = find_triple({"sphericalRange", "sphericalAzimuth", "sphericalElevation"});
    if (!position)
      return error("prototype",
                   "expected cartesianX, Y and Z or sphericalRange, Azimuth and Elevation, found " + names());
    scan_.position = *position;
    scan_.normal = find_triple({"normalX", "normalY", "normalZ"}, true);
    scan_.colour = find_triple({"colorRed", "colorGreen", "colorBlue"});
    scan_.invalid = find(scan_.is_spherical ? "sphericalInvalidState" : "cartesianInvalidState");
    if (scan_.invalid) scan_.columns[*scan_.invalid].is_wanted = true;
    unsigned bits = 0;
    for (const std::size_t column : scan_.position) bits += scan_.columns[column].bits;
    if (bits == 0 && scan_.section.rows > 0)
      return error("prototype", "expected coordinates that differ, found a single point");
    return {};
  }

  // Returns the number in the element named `child` within element `parent`; `unset` if there is none. An
  // empty element means 0.
  double number_in(std::size_t parent, std::string_view child, double unset) const {
    const std::size_t element = parent == 0 ? 0 : find_child(elements_, parent, child);
    if (element == 0) return unset;
    return elements_[element].text.empty() ? 0 : parse_number(elements_[element].text).value_or(unset);
  }

  // Scales colours to [0, 255]. The element colorLimits states their range; if it is missing, the limits of
  // the columns state the range. Floating-point columns without limits are in [0, 1].
  void scale_colours() {
    if (!scan_.colour) return;
    const std::size_t limits = find_child(elements_, element_, "colorLimits");
    for (const std::size_t i : *scan_.colour) {
      PackedColumn& column = scan_.columns[i];
      const XmlElement& element = elements_[elements_of_columns_[i]];
      const double lowest = parse_number(element.attribute("minimum")).value_or(0),
                   highest = parse_number(element.attribute("maximum"))
                                 .value_or(column.kind == PackedColumn::Kind::integer ? 255 : 1),
                   from =
                       number_in(limits, cat(column.name, "Minimum"), column.scale * lowest + column.shift),
                   to = number_in(limits, cat(column.name, "Maximum"), column.scale * highest + column.shift);
      const double factor = to > from ? 255 / (to - from) : 0;
      column.scale *= factor;
      column.shift = (column.shift - from) * factor;
    }
  }

  void take_pose() {
    const std::size_t pose = find_child(elements_, element_, "pose");
    if (pose == 0) return;
    const std::size_t rotation = find_child(elements_, pose, "rotation"),
                      translation = find_child(elements_, pose, "translation");
    const Eigen::Quaterniond turn(number_in(rotation, "w", 1), number_in(rotation, "x", 0),
                                  number_in(rotation, "y", 0), number_in(rotation, "z", 0));
    if (turn.norm() > 0 && turn.coeffs().allFinite()) scan_.turn = turn.normalized();
    scan_.origin = {number_in(translation, "x", 0), number_in(translation, "y", 0),
                    number_in(translation, "z", 0)};
  }

  const Source& source_;
  const XmlElements& elements_;
  std::size_t element_;
  std::vector<std::size_t> elements_of_columns_;
  E57Scan scan_;
};

Vec3 triple_at(const E57Scan& scan, const E57Scan::Triple& triple, std::size_t row) {
  return {scan.columns[triple[0]].value(row), scan.columns[triple[1]].value(row),
          scan.columns[triple[2]].value(row)};
}

Vec3 position_at(const E57Scan& scan, std::size_t row) {
  const Vec3 p = triple_at(scan, scan.position, row);
  if (!scan.is_spherical) return p;
  return p[0] * Vec3(std::cos(p[2]) * std::cos(p[1]), std::cos(p[2]) * std::sin(p[1]), std::sin(p[2]));
}

// Returns a colour value as a byte. Floats are scaled here; integers are scaled already.
std::uint8_t as_byte(const PackedColumn& column, std::size_t row) {
  double value = column.value(row);
  if (column.kind != PackedColumn::Kind::integer) value = column.scale * value + column.shift;
  return io::as_byte(value);
}

void decode_rows(const E57Scan& scan, std::size_t begin, std::size_t end, Cloud& cloud, std::size_t first) {
  const Mat3 turn = scan.turn.toRotationMatrix();
  for (std::size_t row = begin; row < end; ++row) {
    const bool is_valid = !scan.invalid || scan.columns[*scan.invalid].value(row) == 0;
    cloud.points[first + row] = is_valid ? Vec3(turn * position_at(scan, row) + scan.origin)
                                         : Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    if (cloud.has_normals())
      cloud.normals[first + row] = unit_normal(turn * triple_at(scan, *scan.normal, row));
    if (!cloud.has_colours()) continue;
    for (std::size_t c = 0; c < 3; ++c)
      cloud.colours[first + row][c] = as_byte(scan.columns[(*scan.colour)[c]], row);
  }
}

// Returns whether the description of a scan names coordinates of points. Some scans have only intensities.
bool has_coordinates(const XmlElements& elements, std::size_t scan) {
  for (std::size_t i = scan + 1; i < elements[scan].end; ++i)
    if (elements[i].name == "cartesianX" || elements[i].name == "sphericalRange") return true;
  return false;
}

// Returns the scans that have points. If no scan has coordinates, returns the error about the first scan.
Result<std::vector<E57Scan>> parse_scans(const Source& source, const E57Pages& pages, RawCloud& raw) {
  RELIEVO_TRY(const XmlElements elements, parse_xml(pages.xml, source));
  std::vector<std::size_t> with, without;
  const std::size_t all = find_child(elements, 0, "data3D");
  for (std::size_t i = all + 1; all != 0 && i < elements[all].end; i = elements[i].end)
    (has_coordinates(elements, i) ? with : without).push_back(i);
  std::vector<E57Scan> scans;
  for (const std::size_t i : with.empty() ? without : with) {
    RELIEVO_TRY(E57Scan scan, ScanParser(source, elements, i).parse());
    if (scan.section.rows > 0) scans.push_back(std::move(scan));
  }
  if (!without.empty())
    raw.remarks.push_back(cat("left out ", without.size(), without.size() == 1 ? " scan" : " scans",
                              " without coordinates, such as intensities alone"));
  return scans;
}

// Returns whether all scans have the given part, such as colours. Adds a remark if only some scans have it.
bool have_all(const std::vector<E57Scan>& scans, std::optional<E57Scan::Triple> E57Scan::*part,
              std::string_view name, RawCloud& raw) {
  const auto count = static_cast<std::size_t>(
      std::ranges::count_if(scans, [&](const E57Scan& scan) { return (scan.*part).has_value(); }));
  if (count > 0 && count < scans.size())
    raw.remarks.push_back(
        cat("left out the ", name, ", which only ", count, " of ", scans.size(), " scans have"));
  return count == scans.size();
}

}  // namespace

bool is_e57(const Source& source) {
  return source.bytes.starts_with("ASTM-E57") || has_ending(source.name, ".e57");
}

Result<RawCloud> read_e57(const Source& source) {
  E57Pages pages;
  RELIEVO_CHECK(read_e57_pages(source, pages));
  RawCloud raw;
  RELIEVO_TRY(std::vector<E57Scan> scans, parse_scans(source, pages, raw));
  raw.format = cat("E57, ", scans.size(), scans.size() == 1 ? " scan" : " scans");
  const bool has_normals = have_all(scans, &E57Scan::normal, "normals", raw);
  const bool has_colours = have_all(scans, &E57Scan::colour, "colours", raw);
  for (E57Scan& scan : scans) {
    RELIEVO_CHECK(read_packed_columns(source, pages, scan.section, scan.columns));
    const std::size_t first = raw.cloud.size(), rows = scan.section.rows;
    if (rows >= no_index - first)
      return source.error({}, cat("expected fewer than ", no_index, " points, found ", first + rows));
    raw.cloud.points.resize(first + rows);
    if (has_normals) raw.cloud.normals.resize(first + rows);
    if (has_colours) raw.cloud.colours.resize(first + rows);
    parallel_ranges(rows, default_grain, [&](std::size_t begin, std::size_t end) {
      decode_rows(scan, begin, end, raw.cloud, first);
    });
    scan.columns.clear();
  }
  return raw;
}

}  // namespace relievo::io
