#include <filesystem>
#include <nlohmann/json.hpp>

#include "batch/jobs.h"
#include "common/files.h"
#include "common/project.h"
#include "common/scene_file.h"

namespace relievo::app::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Appends a file, and the files to which that file refers, to `files`.
void add_file(const std::string& path, std::vector<std::string>& files) {
  files.push_back(path);
  const std::string ending = ending_of(path);
  const fs::path folder = fs::path(path).parent_path();
  if (ending == "json") {
    const auto entries = read_scene_file(text_of_file(path), path);
    for (std::size_t i = 0; entries && i < entries->size(); ++i)
      if (ending_of((*entries)[i].path) != "json") add_file((*entries)[i].path, files);
  }
  if (ending == "relievo") {
    const auto project = read_project(text_of_file(path), path);
    if (project && project->input.sample.empty() && ending_of(project->input.path) != "relievo")
      add_file((folder / project->input.path).string(), files);
    if (project && !project->base_image_path.empty())
      files.push_back((folder / project->base_image_path).string());
    for (const auto& [option, value] : project ? project->options : OptionValues())
      if (const auto* const text = std::get_if<std::string>(&value))
        if (const std::string file = (folder / *text).string(); is_path(option, file)) files.push_back(file);
  }
  if (ending == "gltf") {
    const Json json = Json::parse(text_of_file(path), nullptr, false);
    if (!json.is_object() || !json.contains("buffers") || !json["buffers"].is_array()) return;
    for (const Json& buffer : json["buffers"]) {
      const Json uri = buffer.is_object() ? buffer.value("uri", Json()) : Json();
      if (uri.is_string() && !uri.get<std::string>().starts_with("data:"))
        files.push_back((folder / uri.get<std::string>()).string());
    }
  }
}

}  // namespace

std::vector<std::string> files_of(const Job& job) {
  std::vector<std::string> files;
  add_file(job.file, files);
  for (const auto& [option, value] : job.options)
    if (is_path(option, value)) files.push_back(value);
  return files;
}

}  // namespace relievo::app::batch
