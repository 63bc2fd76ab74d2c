// Prepares the files of a finished relief, which `relievo make` and Python's save() write.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/export_file.h"
#include "common/make_order.h"
#include "common/output_files.h"
#include "relievo/core/length.h"
#include "relievo/make_relief.h"

namespace relievo::app {

// Paths of the files to write. A file with an empty path is not written.
struct ReliefFiles {
  std::string solid, preview, heightmap, tool_picture, report;
  HeightMapTexts map = {};
  int heightmap_px = 1024;  // longer side of the height map, unless `map` gives the size of a pixel
  int preview_px = 1200;    // longer side of each of the two views of the preview
  LengthUnit unit = LengthUnit::mm;
};

// Checks, before the work begins, that the outputs have different paths and that each can be written. Errors:
// those of check_output() and take_texts(); kind option if a picture of the tool is wanted without a tool, or if
// options of a height map are given without a height map.
Result<void> check_outputs(const ReliefFiles& files, std::vector<std::string> inputs, bool has_tool);

struct MadeFiles {
  std::vector<OutputFile> files;
  nlohmann::json height_map;  // the facts of HeightMapFile; null if no height map is made
};

// Returns the contents of all files except the report; writes nothing. `draft_deg` is the draft angle of the
// relief. Errors: those of enforce_draft_in_float() and height_map_file().
Result<MadeFiles> relief_files(const ReliefFiles& files, const MadeRelief& made,
                               std::optional<double> draft_deg);

// Returns the report as a file; writes nothing.
OutputFile report_file(const ReliefFiles& files, const FinishedRelief& relief,
                       const nlohmann::json& height_map);

}  // namespace relievo::app
