#include "common/project_file.h"

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
constexpr const char *scan_folder = "scan/", *base_folder = "base/";

// Returns the file of the archive that is in that folder; null if there is none. The folder has at most one.
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

}  // namespace

Result<ProjectFile> unpack_project(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view text = text_in(bytes);
  if (!text.starts_with("PK")) return ProjectFile{std::string(text), nullptr, nullptr};
  RELIEVO_TRY(const Archive archive, Archive::open(bytes, name));
  RELIEVO_TRY(const std::vector<std::byte> json, archive.content(project_name));
  ProjectFile file{std::string(text_in(json)), nullptr, nullptr};
  RELIEVO_TRY(file.scan, file_in(archive, scan_folder));
  RELIEVO_TRY(file.base_image, file_in(archive, base_folder));
  return file;
}

Result<std::vector<std::byte>> pack_project(std::string_view text, const PackedFile& scan,
                                            const PackedFile* base_image) {
  std::vector<ZipEntry> entries{{project_name, std::as_bytes(std::span(text))},
                                {cat(scan_folder, scan.name), scan.bytes}};
  if (base_image) entries.push_back({cat(base_folder, base_image->name), base_image->bytes});
  std::vector<std::byte> bytes = write_zip(entries, 0);
  if (bytes.empty())
    return std::unexpected(Error{ErrorKind::output, "project", {}, "expected memory for the packed scan"});
  return bytes;
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
  return StoredProject{std::move(project), std::move(folder), std::move(file.scan), located};
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
