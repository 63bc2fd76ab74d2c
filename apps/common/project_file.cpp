#include "common/project_file.h"

#include <zip.h>

#include <filesystem>

#include "common/archive.h"
#include "common/files.h"
#include "common/read_inputs.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"

namespace relievo::app {
namespace {

constexpr const char* project_name = "project.json";
constexpr const char *scan_folder = "scan/", *base_folder = "base/";

using ZipArchive = std::unique_ptr<zip_t, decltype([](zip_t* archive) { zip_discard(archive); })>;
using ZipSource =
    std::unique_ptr<zip_source_t, decltype([](zip_source_t* source) { zip_source_free(source); })>;

std::unexpected<Error> not_packed() {
  return std::unexpected(Error{ErrorKind::output, "project", {}, "expected memory for the packed scan"});
}

// Adds bytes to be compressed, which must live until the archive is closed.
bool add(zip_t* archive, const std::string& name, std::span<const std::byte> bytes) {
  ZipSource source(zip_source_buffer(archive, bytes.data(), bytes.size(), 0));
  const zip_int64_t index = zip_file_add(archive, name.c_str(), source.get(), ZIP_FL_ENC_UTF_8);
  if (index < 0) return false;
  (void)source.release();                             // belongs to the archive now
  const zip_uint16_t midnight = 0, first_day = 0x21;  // so that the same project gives the same bytes
  return zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), midnight, first_day, 0) == 0;
}

// Returns the only file of a folder of the archive; null if there is none.
Result<std::shared_ptr<const PackedFile>> file_in(const Archive& archive, std::string_view folder) {
  for (const std::string& entry : archive.names()) {
    if (!entry.starts_with(folder)) continue;
    RELIEVO_TRY(std::vector<std::byte> bytes, archive.content(entry));
    return std::make_shared<const PackedFile>(std::filesystem::path(entry).filename().string(),
                                              std::move(bytes));
  }
  return nullptr;
}

// Reads the height map of a project's base from within its file, or from the place that the project names.
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
  const ZipSource memory(zip_source_buffer_create(nullptr, 0, 0, nullptr));
  ZipArchive archive(memory ? zip_open_from_source(memory.get(), ZIP_TRUNCATE, nullptr) : nullptr);
  if (!archive) return not_packed();
  zip_source_keep(memory.get());  // the archive frees it, too
  const bool is_added =
      add(archive.get(), project_name, std::as_bytes(std::span(text))) &&
      add(archive.get(), cat(scan_folder, scan.name), scan.bytes) &&
      (!base_image || add(archive.get(), cat(base_folder, base_image->name), base_image->bytes));
  if (!is_added || zip_close(archive.get()) != 0) return not_packed();
  (void)archive.release();
  zip_stat_t stat;
  if (zip_source_stat(memory.get(), &stat) != 0 || zip_source_open(memory.get()) != 0) return not_packed();
  std::vector<std::byte> bytes(stat.size);
  const zip_int64_t got = zip_source_read(memory.get(), bytes.data(), bytes.size());
  zip_source_close(memory.get());
  if (got != static_cast<zip_int64_t>(bytes.size())) return not_packed();
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

Result<Scene> load_project_scan(const StoredProject& stored, const std::function<bool()>& is_unwanted) {
  ScanSource source = stored.project.input;
  if (!stored.located.empty()) {
    source.path = stored.located;
    return load_input(source, {}, is_unwanted);
  }
  if (stored.packed) return load_scan(source, stored.packed->bytes, stored.packed->name, is_unwanted);
  Result<Scene> scene = load_input(source, stored.folder, is_unwanted);
  const std::string path = (std::filesystem::path(stored.folder) / source.path).string();
  if (!scene && source.sample.empty() && !is_there(path))
    scene.error().expected += cat("; name the place of ", source.name, " with --scan");
  return scene;
}

}  // namespace relievo::app
