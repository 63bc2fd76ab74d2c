#include "common/input_files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/files.h"
#include "common/project_file.h"
#include "common/read_inputs.h"
#include "common/scene_file.h"
#include "relievo/option_table.h"

namespace relievo::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Returns the text of an escaped URI, in which "%20" stands for a space.
std::string without_escapes(std::string_view uri) {
  std::string plain;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const std::string_view digits = uri.substr(i + 1, 2);
    unsigned char byte = 0;
    const bool is_escape =
        uri[i] == '%' && digits.size() == 2 &&
        std::from_chars(digits.data(), digits.data() + 2, byte, 16).ptr == digits.data() + 2;
    plain += is_escape ? static_cast<char>(byte) : uri[i];
    if (is_escape) i += 2;
  }
  return plain;
}

// Returns the JSON of a glTF or GLB file. In a GLB file the JSON is the first part.
std::string gltf_text(const std::string& path) {
  if (!file_size(path)) return {};  // a pipe can be read only once
  std::ifstream file(path, std::ios::binary);
  std::array<unsigned char, 20> head{};
  file.read(reinterpret_cast<char*>(head.data()), head.size());
  if (!file || std::string_view(reinterpret_cast<const char*>(head.data()), 4) != "glTF")
    return text_of_file(path);
  const auto byte = [&](std::size_t i) { return std::size_t{head[i]}; };
  const std::size_t stated = byte(12) | byte(13) << 8 | byte(14) << 16 | byte(15) << 24;
  std::string text(std::min<std::size_t>(stated, file_size(path).value_or(0)), ' ');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

// Calls take() with the first word of each line and the rest of the line. Reads only the first megabyte: programs
// write `mtllib` at the top of an OBJ file, which may have gigabytes of points, and material files are small.
template <typename Take>
void for_each_line(const std::string& path, const Take& take) {
  constexpr std::size_t most = 1 << 20;
  std::string head(std::min<std::size_t>(file_size(path).value_or(0), most), ' ');
  std::ifstream(path, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
  std::istringstream lines(head);
  for (std::string line; std::getline(lines, line);) {
    line.erase(std::min(line.find('#'), line.size()));
    line.erase(line.find_last_not_of(" \t\r") + 1);
    std::istringstream words(line);
    std::string keyword;
    if (words >> keyword >> std::ws && !words.eof())
      take(keyword, line.substr(static_cast<std::size_t>(words.tellg())));
  }
}

// Returns the name of the file in a line of an OBJ or material file. Options with their numbers may precede the name
// of a texture.
std::string name_in(const std::string& rest, bool is_texture) {
  std::string name = is_texture && rest.starts_with('-') ? rest.substr(rest.find_last_of(" \t") + 1) : rest;
  std::ranges::replace(name, '\\', '/');
  return name;
}

class Finder {
 public:
  void add(const std::string& path) {
    files_.push_back({path});
    const std::string ending = ending_of(path);
    if (ending == "json") add_models(path);
    if (ending == "relievo") add_project(path);
    if (ending == "gltf" || ending == "glb") add_buffers(path);
    if (ending == "obj") add_materials(path);
  }

  std::vector<InputFile> files() && { return std::move(files_); }

 private:
  void add_models(const std::string& path) {
    const auto entries = read_scene_file(text_of_file(path), path);
    for (std::size_t i = 0; entries && i < entries->size(); ++i)
      if (ending_of((*entries)[i].path) != "json") add((*entries)[i].path);
  }

  void add_project(const std::string& path) {
    const auto bytes = read_file(path);
    const auto packed = bytes ? list_project(*bytes, path) : std::unexpected(bytes.error());
    const auto project = packed ? read_project(packed->text, path) : std::unexpected(packed.error());
    if (!project) return;
    const std::string folder = fs::path(path).parent_path().string();
    const std::string& scan = project->input.path;
    if (!packed->has_scan && !scan.empty() && ending_of(scan) != "relievo") add(path_in(folder, scan));
    if (!packed->has_base_image && !project->base_image_path.empty())
      files_.push_back({path_in(folder, project->base_image_path)});
    for (const auto& [option, value] : project->options)
      if (const auto* const text = std::get_if<std::string>(&value); text && !text->empty())
        for (std::string& file : files_in_option(option, *text, folder)) files_.push_back({std::move(file)});
  }

  void add_buffers(const std::string& path) {
    const Json json = Json::parse(gltf_text(path), nullptr, false);
    for (const char* const list : {"buffers", "images"}) {
      if (!json.is_object() || !json.contains(list) || !json[list].is_array()) continue;
      for (const Json& each : json[list]) {
        const auto uri = each.is_object() ? each.find("uri") : each.end();
        if (uri == each.end() || !uri->is_string()) continue;
        const std::string& text = uri->get_ref<const std::string&>();
        if (!text.starts_with("data:"))
          add_beside(path, without_escapes(text), std::string_view(list) == "images");
      }
    }
  }

  void add_materials(const std::string& path) {
    for_each_line(path, [&](const std::string& keyword, const std::string& rest) {
      if (keyword != "mtllib") return;
      const std::string library = add_beside(path, name_in(rest, false), false);
      if (library.empty()) return;
      for_each_line(library, [&](const std::string& key, const std::string& name) {
        if (key == "map_Kd") add_beside(path, name_in(name, true), true);
      });
    });
  }

  // Returns the path of the added file; "" if it was added before.
  std::string add_beside(const std::string& path, const std::string& name, bool is_texture) {
    const std::string file = (fs::path(path).parent_path() / name).string();
    if (std::ranges::find(files_, file, &InputFile::path) != files_.end()) return {};
    files_.push_back({file, is_texture});
    return file;
  }

  std::vector<InputFile> files_;
};

}  // namespace

std::vector<InputFile> files_read_with(const std::string& path) {
  Finder finder;
  finder.add(path);
  return std::move(finder).files();
}

std::vector<std::string> files_in_option(const std::string& option, const std::string& value,
                                         const std::string& folder) {
  std::vector<std::string> files;
  std::string list = value, start = folder;
  if (const std::string path = path_in(folder, value); !is_ornament_json(value) && is_path(option, path)) {
    files.push_back(path);
    if (option != "ornaments") return files;
    list = text_of_file(path);
    list.erase(0, list.find_first_of("{["));
    start = fs::path(path).parent_path().string();
  }
  if (option != "ornaments" || !is_ornament_json(list)) return files;
  change_ornament_paths(nullptr, &list, [&](const std::string& name) {
    files.push_back(path_in(start, name));
    return name;
  });
  return files;
}

std::vector<std::string> paths_read_by(const MakeOrder& order) {
  std::vector<std::string> paths{order.base_image_path};
  const auto add = [&](const std::string& input) {
    for (InputFile& file : files_read_with(input)) paths.push_back(std::move(file.path));
  };
  for (const std::string& input : order.inputs) add(input);
  if (!order.scan_path.empty()) add(order.scan_path);
  for (const auto& [option, value] : order.values)
    if (const auto* const text = std::get_if<std::string>(&value); text && !text->empty())
      for (std::string& file : files_in_option(option, *text)) paths.push_back(std::move(file));
  std::erase_if(paths, [](const std::string& path) { return !is_there(path); });
  return paths;
}

bool is_path(const std::string& option, const std::string& value) {
  std::error_code ignored;
  const OptionRow* const row = find_option(option);
  const bool may_be_file =
      option == "base-image" || option == "camera" || (row && (row->unit == "FILE" || row->unit == "JSON"));
  return may_be_file && fs::is_regular_file(value, ignored);
}

}  // namespace relievo::app
