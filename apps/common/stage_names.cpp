#include "common/stage_names.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/export_file.h"
#include "relievo/core/version.h"
#include "relievo/io/read.h"
#include "relievo/samples/sample.h"

namespace relievo::app {
namespace {

using StageName = std::pair<std::string_view, std::string_view>;  // the library's name, the users' name

constexpr StageName stage_names[] = {
    {"waiting", "Getting ready"},
    {"upload", "Taking in the file"},
    {"read", "Reading the scan"},
    {"first look", "Reading the scan: a first look"},
    {"extent", "Reading the scan: its extent"},
    {"front", "Reading the scan: the side that is seen"},
    {"means", "Reading the scan: averaging its points"},
    {"depths", "Turning depths into points"},
    {"smooth depths", "Smoothing depths"},
    {"models", "Placing the models"},
    {"mesh", "Looking at the mesh"},
    {"mesh samples", "Sampling the mesh"},
    {"view", "Turning the model"},
    {"spacing", "Measuring the spacing"},
    {"normals", "Looking at normals"},
    {"visible points", "Finding what is seen"},
    {"curvature", "Measuring curvature"},
    {"triangulation", "Connecting the points"},
    {"boundary", "Finding the outline"},
    {"layers", "Splitting the normals in layers"},
    {"factorisation", "Preparing live work"},
    {"reference heights", "Computing reference reliefs"},
    {"control points", "Placing control points"},
    {"relief", "Computing the relief"},
    {"solid", "Building the solid"},
    {"simplify", "Simplifying the mesh"},
    {"files", "Writing files"},
    {"comparison", "Comparing methods"},
};

}  // namespace

std::string_view name_of_stage(std::string_view stage) {
  const auto found = std::ranges::find(stage_names, stage, &StageName::first);
  return found != std::end(stage_names) ? found->second : stage;
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
