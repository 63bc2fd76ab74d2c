#include "common/relief_files.h"

#include "common/export_file.h"
#include "common/files.h"
#include "relievo/io/write.h"
#include "relievo/picture/height_map.h"
#include "relievo/picture/preview.h"
#include "relievo/plate/draft_in_file.h"
#include "relievo/relief/draft.h"

namespace relievo::app {
namespace {

// Returns the solid as a file. Conversion to inches rounds the coordinates again, which can tilt very narrow
// triangles. So the draft angle is enforced a second time.
Result<std::vector<std::byte>> solid_file(const ReliefFiles& files, const Solid& solid,
                                          std::optional<double> draft_deg) {
  const auto write = find_solid_format(ending_of(files.solid))->write_solid;
  if (files.unit == solid.unit) return write(solid);
  Solid other = in_unit(solid, files.unit);
  if (draft_deg) RELIEVO_CHECK(enforce_draft_in_float(other, slope_at_draft(*draft_deg)));
  return write(other);
}

Result<HeightMapOrder> map_order(const ReliefFiles& files) {
  HeightMapOrder order;
  order.longer_side_px = files.heightmap_px;
  order.is_tiff = ending_of(files.heightmap) != "png";
  order.unit = files.unit;
  RELIEVO_CHECK(take_texts(files.map, order));
  return order;
}

}  // namespace

Result<void> check_outputs(const ReliefFiles& files, std::vector<std::string> inputs, bool has_tool) {
  using Endings = std::vector<std::string_view>;
  std::vector<std::string> taken = std::move(inputs);
  for (const auto& [path, endings] : {std::pair<std::string, Endings>{files.solid, solid_endings()},
                                      {files.preview, {".png"}},
                                      {files.heightmap, {".png", ".tif", ".tiff"}},
                                      {files.tool_picture, {".png"}},
                                      {files.report, {}}}) {
    if (path.empty()) continue;
    RELIEVO_CHECK(check_output(path, endings, taken));
    taken.push_back(path);
  }
  if (!files.tool_picture.empty() && !has_tool)
    return option_error("tool-picture", "expected a tool, which it shows");
  if (files.heightmap.empty() && files.map != HeightMapTexts())
    return option_error("heightmap", "expected a height map, as options of one are given");
  RELIEVO_CHECK(map_order(files));
  return {};
}

Result<MadeFiles> relief_files(const ReliefFiles& to, const MadeRelief& made,
                               std::optional<double> draft_deg) {
  MadeFiles out;
  const auto add = [&](const std::string& path, std::vector<std::byte> bytes) {
    out.files.push_back({path, std::move(bytes)});
  };
  if (!to.solid.empty()) {
    RELIEVO_TRY(std::vector<std::byte> solid, solid_file(to, made.solid, draft_deg));
    add(to.solid, std::move(solid));
  }
  if (!to.heightmap.empty()) {
    RELIEVO_TRY(const HeightMapOrder order, map_order(to));
    RELIEVO_TRY(HeightMapFile map, height_map_file(made, order));
    add(to.heightmap, std::move(map.bytes));
    out.height_map = std::move(map.facts);
  }
  if (!to.preview.empty()) add(to.preview, write_png(preview_of(made, {to.preview_px})));
  if (!to.tool_picture.empty()) add(to.tool_picture, write_png(render_reach(*made.report.reach, 1600)));
  return out;
}

OutputFile report_file(const ReliefFiles& files, const FinishedRelief& relief,
                       const nlohmann::json& height_map) {
  nlohmann::json report = relief.report(files.unit);
  if (!height_map.is_null()) report["height_map"] = height_map;
  // JSON must be UTF-8, but names of files need not be UTF-8. So their other bytes are replaced.
  const auto replace = nlohmann::json::error_handler_t::replace;
  return {files.report, bytes_of(report.dump(2, ' ', false, replace) + "\n")};
}

}  // namespace relievo::app
