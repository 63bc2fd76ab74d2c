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

// Returns the solid as a file. In inches the coordinates are rounded again, which tilts needle-shaped
// triangles, so the draft angle is enforced again.
Result<std::vector<std::byte>> solid_file(const ReliefFiles& files, const Solid& solid,
                                          std::optional<double> draft_deg) {
  const auto write = find_solid_format(ending_of(files.solid))->write_solid;
  if (files.unit == solid.unit) return write(solid);
  Solid other = in_unit(solid, files.unit);
  if (draft_deg) RELIEVO_CHECK(enforce_draft_in_float(other, slope_at_draft(*draft_deg)));
  return write(other);
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
  return {};
}

Result<std::vector<OutputFile>> relief_files(const ReliefFiles& to, const MadeRelief& made,
                                             std::optional<double> draft_deg) {
  std::vector<OutputFile> files;
  if (!to.solid.empty()) {
    RELIEVO_TRY(std::vector<std::byte> solid, solid_file(to, made.solid, draft_deg));
    files.push_back({to.solid, std::move(solid)});
  }
  const HeightMapOrder map{to.heightmap_px, ending_of(to.heightmap) != "png", to.unit};
  if (!to.heightmap.empty()) files.push_back({to.heightmap, height_map_file(made, map)});
  if (!to.preview.empty()) files.push_back({to.preview, write_png(preview_of(made, {to.preview_px}))});
  if (!to.tool_picture.empty())
    files.push_back({to.tool_picture, write_png(render_reach(*made.report.reach, 1600))});
  return files;
}

OutputFile report_file(const ReliefFiles& files, const FinishedRelief& relief) {
  // Names of files need not be UTF-8, but JSON is.
  const auto replace = nlohmann::json::error_handler_t::replace;
  return {files.report, bytes_of(relief.report(files.unit).dump(2, ' ', false, replace) + "\n")};
}

}  // namespace relievo::app
