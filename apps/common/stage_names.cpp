#include "common/stage_names.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "common/export_file.h"
#include "relievo/core/version.h"
#include "relievo/io/read.h"
#include "relievo/samples/sample.h"

namespace relievo::app {
namespace {

struct StageName {
  std::string_view stage, text;
};

constexpr std::array stage_names{
    StageName{"waiting", "Getting ready"},
    StageName{"upload", "Taking in the file"},
    StageName{"read", "Reading the scan"},
    StageName{"first look", "Reading the scan: a first look"},
    StageName{"extent", "Reading the scan: its extent"},
    StageName{"front", "Reading the scan: the side that is seen"},
    StageName{"means", "Reading the scan: averaging its points"},
    StageName{"depths", "Turning depths into points"},
    StageName{"smooth depths", "Smoothing depths"},
    StageName{"models", "Placing the models"},
    StageName{"mesh", "Looking at the mesh"},
    StageName{"mesh samples", "Sampling the mesh"},
    StageName{"view", "Turning the model"},
    StageName{"spacing", "Measuring the spacing"},
    StageName{"normals", "Looking at normals"},
    StageName{"visible points", "Finding what is seen"},
    StageName{"curvature", "Measuring curvature"},
    StageName{"triangulation", "Connecting the points"},
    StageName{"boundary", "Finding the outline"},
    StageName{"layers", "Splitting the normals in layers"},
    StageName{"factorisation", "Preparing live work"},
    StageName{"reference heights", "Computing reference reliefs"},
    StageName{"control points", "Placing control points"},
    StageName{"relief", "Computing the relief"},
    StageName{"solid", "Building the solid"},
    StageName{"simplify", "Simplifying the mesh"},
    StageName{"files", "Writing files"},
    StageName{"comparison", "Comparing methods"},
};

}  // namespace

std::string_view name_of_stage(std::string_view stage) {
  const auto found = std::ranges::find(stage_names, stage, &StageName::stage);
  return found != stage_names.end() ? found->text : stage;
}

nlohmann::json program_facts() {
  nlohmann::json all = nlohmann::json::array(), stages;
  for (const SampleInfo& sample : samples())
    all.push_back({{"name", sample.name}, {"description", sample.description}});
  for (const auto& [stage, text] : stage_names) stages[std::string(stage)] = text;
  return {{"version", version},
          {"stages", stages},
          {"formats", format_list()},
          {"endings", readable_endings()},
          {"samples", all}};
}

}  // namespace relievo::app
