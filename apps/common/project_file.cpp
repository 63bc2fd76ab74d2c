#include "common/project_file.h"

#include <algorithm>
#include <filesystem>

#include "common/archive.h"
#include "common/files.h"
#include "common/read_inputs.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"
#include "relievo/io/write.h"

namespace relievo::app {
namespace {

constexpr const char* project_name = "project.json";
constexpr const char *scan_folder = "scan/", *base_folder = "base/", *ornament_folder = "ornaments/";

// Returns the file in that folder of the archive; null if there is none. The folder has at most one file.
Result<std::shared_ptr<const PackedFile>> file_in(const Archive& archive, std::string_view folder) {
  for (const std::string& entry : archive.names()) {
    if (!entry.starts_with(folder)) continue;
    RELIEVO_TRY(std::vector<std::byte> bytes, archive.content(entry));
    return std::make_shared<const PackedFile>(std::filesystem::path(entry).filename().string(),
                                              std::move(bytes));
  }
  return nullptr;
}

// Reads the height map of a project's base: from the project's own file if it is packed there, otherwise from
// the path that the project names.
Result<std::shared_ptr<const Image<float>>> read_base_image_of(const Project& project,
                                                               const PackedFile* packed,
                                                               const std::string& folder) {
  if (project.base_image_path.empty()) return nullptr;
  if (!packed) return read_base_image((std::filesystem::path(folder) / project.base_image_path).string());
  RELIEVO_TRY(DepthImage image, read_depth_image(packed->bytes, packed->name));
  return std::make_shared<const Image<float>>(std::move(image.values));
}

// Checks that the files are fonts and drawings. Otherwise a malicious project could name any file of the user, and
// saving the project would pack that file into it.
Result<void> check_packed(const std::string* font, const std::string* ornaments, const OrnamentFiles& files) {
  ReliefOptions options;
  if (font) options.font_name = *font;
  if (ornaments) options.ornament_source = *ornaments;
  RELIEVO_CHECK(read_ornaments(options, files));
  std::vector<std::shared_ptr<const FontFile>> fonts{options.font};
  for (const Ornament& ornament : options.ornaments) fonts.push_back(ornament.font);
  for (const auto& each : fonts)
    if (auto ok = each ? check_text({.text = "A", .font = each}) : Result<void>();
        !ok && ok.error().input == "font")
      return ok;
  return {};
}

}  // namespace

Result<ProjectFile> unpack_project(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view text = text_in(bytes);
  if (!text.starts_with("PK")) return ProjectFile{std::string(text), nullptr, nullptr, {}};
  RELIEVO_TRY(const Archive archive, Archive::open(bytes, name));
  RELIEVO_TRY(const std::vector<std::byte> json, archive.content(project_name));
  ProjectFile file{std::string(text_in(json)), nullptr, nullptr, {}};
  RELIEVO_TRY(file.scan, file_in(archive, scan_folder));
  RELIEVO_TRY(file.base_image, file_in(archive, base_folder));
  for (const std::string& entry : archive.names())
    if (entry.starts_with(ornament_folder)) {
      RELIEVO_TRY(file.ornaments[entry], archive.content(entry));
    }
  return file;
}

Result<ProjectListing> list_project(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view text = text_in(bytes);
  if (!text.starts_with("PK")) return ProjectListing{std::string(text)};
  RELIEVO_TRY(const Archive archive, Archive::open(bytes, name));
  RELIEVO_TRY(const std::vector<std::byte> json, archive.content(project_name));
  const std::vector<std::string> names = archive.names();
  const auto has = [&](const char* folder) {
    return std::ranges::any_of(names, [&](const std::string& entry) { return entry.starts_with(folder); });
  };
  return ProjectListing{std::string(text_in(json)), has(scan_folder), has(base_folder)};
}

Result<std::vector<std::byte>> pack_project(const ProjectFile& file) {
  std::vector<ZipEntry> entries{{project_name, std::as_bytes(std::span(file.text))}};
  if (file.scan) entries.push_back({cat(scan_folder, file.scan->name), file.scan->bytes});
  if (file.base_image) entries.push_back({cat(base_folder, file.base_image->name), file.base_image->bytes});
  for (const auto& [name, content] : file.ornaments) entries.push_back({name, content});
  std::vector<std::byte> bytes = write_zip(entries, 0);
  if (bytes.empty())
    return std::unexpected(Error{ErrorKind::output, "project", {}, "expected memory for the packed scan"});
  return bytes;
}

Result<OrnamentFiles> pack_ornaments(std::string* font, std::string* ornaments) {
  if (ornaments && !ornaments->empty() && !is_ornament_json(*ornaments)) {
    RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(*ornaments));
    const std::string folder = std::filesystem::path(*ornaments).parent_path().string();
    *ornaments = text_in(bytes);
    change_ornament_paths(nullptr, ornaments, [&](const std::string& path) { return path_in(folder, path); });
  }
  OrnamentFiles files;
  std::optional<Error> failed;
  change_ornament_paths(font, ornaments, [&](const std::string& path) {
    Result<std::vector<std::byte>> bytes = read_file(path);
    if (!bytes) {
      failed = bytes.error();
      return path;
    }
    const std::string hash = hash_of(text_in(*bytes)), digits = hash.substr(hash.find(':') + 1);
    std::string name = cat(ornament_folder, digits, "/", std::filesystem::path(path).filename().string());
    files[name] = *std::move(bytes);
    return name;
  });
  if (failed) return std::unexpected(*std::move(failed));
  RELIEVO_CHECK(check_packed(font, ornaments, files));
  return files;
}

Result<std::optional<StoredProject>> find_project(const std::vector<std::string>& inputs,
                                                  const std::string& located) {
  if (inputs.size() != 1 || ending_of(inputs[0]) != "relievo") {
    if (!located.empty()) return option_error("scan", "expected one project to go with it");
    return std::nullopt;
  }
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(inputs[0]));
  RELIEVO_TRY(ProjectFile file, unpack_project(bytes, inputs[0]));
  RELIEVO_TRY(Project project, read_project(file.text, inputs[0]));
  std::string folder = std::filesystem::path(inputs[0]).parent_path().string();
  project.base_image = read_base_image_of(project, file.base_image.get(), folder);
  return StoredProject{std::move(project), std::move(folder), std::move(file.scan), located,
                       std::move(file.ornaments)};
}

Result<std::shared_ptr<const Image<float>>> base_image_for(const BaseOptions& base,
                                                           const std::string& given_path,
                                                           const std::optional<Project>& project) {
  if (!given_path.empty() || !project || base.kind != BaseKind::image) return read_base_image(given_path);
  return project->base_image;
}

Result<Scene> load_project_scan(const StoredProject& stored, const LoadOptions& options) {
  ScanSource source = stored.project.input;
  if (!stored.located.empty()) {
    source.path = stored.located;
    return load_input(source, {}, options);
  }
  if (stored.packed) return load_scan(source, stored.packed->bytes, stored.packed->name, options);
  Result<Scene> scene = load_input(source, stored.folder, options);
  const std::string path = (std::filesystem::path(stored.folder) / source.path).string();
  if (!scene && source.sample.empty() && !is_there(path))
    scene.error().expected += cat("; name the place of ", source.name, " with --scan");
  return scene;
}

}  // namespace relievo::app
