#include "common/wording.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "relievo/core/text.h"

namespace relievo::app {
namespace {

std::string left_out(std::size_t points) {
  return cat("left out ", points, " points far outside the model");
}

std::string repeated_text(std::size_t points) {
  return cat("left out ", points, " points that repeat others");
}

std::string text_of(const SampleNote& note) {
  using Kind = SampleNote::Kind;
  switch (note.kind) {
    case Kind::outliers:
      return left_out(note.points);
    case Kind::repeated:
      return repeated_text(note.points);
    case Kind::estimated_normals:
      return "has no normals: they were estimated";
    case Kind::turned_normals:
      return "normals point inwards: they were turned";
    case Kind::mesh:
      return cat("the mesh has ", note.of, " triangles: ", note.points, " points taken");
    case Kind::coarse:
      return "coarser than the scene: points taken between its points";
    case Kind::fine:
      return cat("finer than the scene: ", note.points, " of ", note.of, " points kept");
  }
  return {};
}

std::string reach_text(const Tool& tool, const ToolReach& reach) {
  const auto rounded = [](double value) { return std::round(1e3 * value) / 1e3; };
  return cat("the tool ", relievo::text_of(tool), " reaches ", std::floor(1e3 * reach.reached_share) / 10,
             " % of the front within ", reach.tolerance_mm, " mm and leaves at most ",
             rounded(reach.largest_residual_mm), " mm (sampled every ", rounded(reach.mm_per_sample), " mm)");
}

std::string wrap_text(const ReliefReport::Wrapped& wrap) {
  constexpr double half_turn_deg = 180;
  const double half_angle = std::min(wrap.turn_deg, half_turn_deg) / 2 * std::numbers::pi / 180;
  return cat("the ground has a diameter of ", wrap.diameter_mm, " mm, goes around by ", wrap.turn_deg,
             " degrees, which leaves it ", wrap.diameter_mm * std::sin(half_angle), " mm wide, and has ",
             wrap.mm_per_degree, " mm in a degree");
}

Remark remark_on(const ScanReport::FoundPlane& plane) {
  const std::string what = cat("a ", name_in(plane_kinds, plane.kind), ", ", std::lround(100 * plane.share),
                               " % of the visible points");
  return plane.is_left_out ? Remark{cat("left out ", what), "plane", "keep", "keeps it"}
                           : Remark{cat("found ", what), "plane", "drop", "leaves it out"};
}

// Returns the number of letters that must be inserted, removed or changed to turn one text into the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string line_of(const Remark& remark) {
  if (remark.effect.empty()) return remark.text;
  return cat(remark.text, "; --", remark.option, " ", remark.value, " ", remark.effect);
}

// Adds remarks on texts, borders and drawings, such as lines that are too thin to be printed.
void add_ornament_remarks(const ReliefReport& report, std::vector<std::string>& lines) {
  const auto& [highest_mm, thinnest_mm] = report.ornaments;
  constexpr double usual_nozzle_mm = .4;
  const double least_mm = !report.tool                         ? usual_nozzle_mm
                          : report.tool->kind == Tool::Kind::v ? report.tool->tip_mm
                                                               : report.tool->diameter_mm;
  const auto in_mm = [](double mm) { return cat(std::round(1e3 * mm) / 1e3, " mm"); };
  if (thinnest_mm < least_mm)
    lines.push_back(cat("the thinnest stroke of the ornaments is ", in_mm(thinnest_mm), " wide, less than ",
                        report.tool ? "the tool of " : "a usual nozzle of ", in_mm(least_mm),
                        ": larger letters, a bolder font, or a ",
                        report.tool ? "thinner tool" : "printer for resin", " can make it"));
  if (report.rim_height_mm && highest_mm > *report.rim_height_mm)
    lines.push_back(cat("the ornaments reach ", in_mm(highest_mm), ", and the rim only ",
                        in_mm(*report.rim_height_mm), ": rim-height or text-height change that"));
}

}  // namespace

std::vector<Remark> remarks_on(const ScanReport& scan, std::size_t outliers) {
  std::vector<Remark> all;
  if (scan.has_estimated_normals) all.push_back({"the scan has no normals: they were estimated"});
  if (scan.has_turned_normals) all.push_back({"the scan's normals point inwards: they were turned"});
  if (outliers > 0) all.push_back({left_out(outliers)});
  if (scan.repeated_points > 0) all.push_back({repeated_text(scan.repeated_points)});
  const std::size_t facing = scan.visible_points + scan.removed_points;
  if (50 * scan.removed_points > facing)
    all.push_back({cat("left out ", 100 * scan.removed_points / facing,
                       " % of the points that face the viewer, as small groups far from others")});
  if (scan.crumbs > 0)
    all.push_back({cat("left out ", scan.crumbs, scan.crumbs == 1 ? " small piece" : " small pieces",
                       " of the surface"),
                   "crumbs", "keep", "leaves in all but single specks"});
  if (scan.plane) all.push_back(remark_on(*scan.plane));
  if (scan.lacks_plane) all.push_back({"found no table or background to leave out", "plane"});
  if (scan.removed_noise > 0 && scan.removed_noise == scan.measured_noise)
    all.push_back(
        {cat("removed noise of ", std::round(100 * scan.removed_noise) / 100, " sampling distances"),
         "denoise", "0", "keeps it"});
  return all;
}

std::vector<std::string> remarks_on(const ReliefReport& report) {
  std::vector<std::string> lines;
  if (report.height_usual_mm)
    lines.push_back(cat("no height was asked for; it is ", std::round(1e3 * report.height_mm) / 1e3, " mm, ",
                        report.height_mm < .999 * *report.height_usual_mm ? "which is what the view reaches"
                                                                          : "5 % of the width"));
  for (const auto& [name, reason] : report.idle_options)
    lines.push_back(cat(name, " has no effect ", reason));
  if (report.has_needed_steps)
    lines.push_back(cat("slopes alone do not reach the height: depth jumps take ",
                        std::lround(100 * report.steps), " % of it"));
  for (const Remark& remark : remarks_on(static_cast<const ScanReport&>(report)))
    lines.push_back(line_of(remark));
  add_ornament_remarks(report, lines);
  if (report.tool && report.reach) lines.push_back(reach_text(*report.tool, *report.reach));
  if (report.simplification_error_mm)
    lines.push_back(cat("the front has ", report.front_triangles, " triangles, the full relief ",
                        report.full_triangles, ", and is off by at most ",
                        std::ceil(1e4 * *report.simplification_error_mm) / 1e4, " mm"));
  if (report.wrap) lines.push_back(wrap_text(*report.wrap));
  for (const SampleNote& note : report.sample)
    lines.push_back(note.model.empty() ? text_of(note) : cat(note.model, ": ", text_of(note)));
  return lines;
}

std::string as_sentence(std::string line) {
  if (!line.empty()) line[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(line[0])));
  return line + ".";
}

std::string found(const nlohmann::json& value) {
  if (value.is_null()) return ", found none";
  std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > 32) text.replace(32, text.size(), "...");
  return ", found " + text;
}

std::string nearest_name(std::string_view typed, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, typed.size() / 3) + 1;
  for (const std::string& name : names) {
    const bool is_begun = typed.size() > 3 && name.starts_with(typed);
    if (const std::size_t distance = is_begun ? 1 : edit_distance(typed, name); distance < least)
      least = distance, nearest = name;
  }
  return nearest;
}

}  // namespace relievo::app
