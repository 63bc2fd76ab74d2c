#include "common/archive.h"

#include <zip.h>

#include <algorithm>
#include <array>

#include "common/files.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"

namespace relievo::app {
namespace {

constexpr zip_uint64_t most_unpacked = zip_uint64_t{4} << 30;

using ArchiveEntry = std::unique_ptr<zip_file_t, decltype([](zip_file_t* file) { zip_fclose(file); })>;
using ArchiveSource =
    std::unique_ptr<zip_source_t, decltype([](zip_source_t* source) { zip_source_free(source); })>;

std::unexpected<Error> broken(std::string_view name, std::string expected) {
  return input_error(std::string(name), {}, std::move(expected));
}

// Returns the message for an archived file that libzip cannot unpack. `code` is libzip's error code.
std::string not_unpacked(const zip_stat_t& file, int code) {
  if (file.encryption_method != ZIP_EM_NONE)
    return "expected a file without a password, found an encrypted one; unpack the archive first";
  if (file.size > most_unpacked)
    return cat("expected at most 4294967296 bytes, found ", file.size, "; unpack the archive first");
  if (code == ZIP_ER_COMPNOTSUPP)
    return cat("expected a file that is stored or packed by deflate, found method ", file.comp_method,
               "; unpack the archive first");
  const char* const found = code == ZIP_ER_CRC ? "content that its checksum does not fit" : "damaged content";
  return cat("expected a whole file, found ", found, "; get the archive anew");
}

// Replaces backslashes with slashes. Some programs separate folders by backslashes.
std::string with_slashes(std::string name) {
  std::ranges::replace(name, '\\', '/');
  return name;
}

// Returns the name of a file of the archive; empty if the file has no readable name.
const char* name_at(zip* archive, zip_uint64_t i) {
  const char* const name = zip_get_name(archive, i, 0);
  return name ? name : "";
}

bool is_hidden(const std::string& name) {
  return name.empty() || name.contains("__MACOSX/") || name.starts_with('.') || name.contains("/.") ||
         name.ends_with('/');
}

bool is_readable(const std::string& name) {
  const auto endings = readable_endings();
  return !is_hidden(name) && std::ranges::find(endings, "." + ending_of(name)) != endings.end();
}

bool is_text(const std::string& ending) {
  return ending == "txt" || ending == "csv";
}

// Returns whether the file is a model and not a licence, a texture or a preview, which often lie beside
// models.
bool is_model(const std::string& name) {
  constexpr std::array pictures = {"png", "tif", "tiff", "jpg", "jpeg", "npy",
                                   "pfm", "pgm", "ppm",  "bmp", "dat"};
  const std::string ending = ending_of(name);
  return is_readable(name) && !is_text(ending) && std::ranges::find(pictures, ending) == pictures.end();
}

}  // namespace

void Archive::Discard::operator()(zip* archive) const {
  zip_discard(archive);
}

Result<Archive> Archive::open(std::span<const std::byte> bytes, std::string_view name) {
  Archive made;
  made.name_ = name;
  ArchiveSource source(zip_source_buffer_create(bytes.data(), bytes.size(), 0, nullptr));
  made.zip_.reset(source ? zip_open_from_source(source.get(), ZIP_RDONLY, nullptr) : nullptr);
  if (!made.zip_) return broken(name, "expected a whole archive, found a damaged one; get it anew");
  (void)source.release();  // the archive owns the source now, and frees it
  return made;
}

std::vector<std::string> Archive::names() const {
  std::vector<std::string> all;
  for (zip_int64_t i = 0; i < zip_get_num_entries(zip_.get(), 0); ++i)
    all.push_back(with_slashes(name_at(zip_.get(), static_cast<zip_uint64_t>(i))));
  return all;
}

Result<std::vector<std::byte>> Archive::content(const std::string& name) const {
  const std::vector<std::string> all = names();
  const auto found = std::ranges::find(all, with_slashes(name));
  if (found == all.end()) return broken(name_, cat("expected an archive with ", name, ", found none in it"));
  const auto index = static_cast<zip_uint64_t>(found - all.begin());
  zip_stat_t stat;
  zip_stat_init(&stat);
  const auto fail = [&](zip_error_t* why) {
    return broken(cat(name_, "/", name), not_unpacked(stat, zip_error_code_zip(why)));
  };
  if (zip_stat_index(zip_.get(), index, 0, &stat) != 0) return fail(zip_get_error(zip_.get()));
  const ArchiveEntry entry(stat.size > most_unpacked ? nullptr : zip_fopen_index(zip_.get(), index, 0));
  if (!entry) return fail(zip_get_error(zip_.get()));
  std::vector<std::byte> bytes;
  // A damaged archive may state any size, so the file is read in blocks. The last call of zip_fread() returns
  // no bytes; in that call libzip compares the checksum.
  constexpr std::size_t piece = 1 << 20;
  for (std::size_t filled = 0; bytes.size() <= stat.size;) {
    bytes.resize(filled + std::min<std::size_t>(piece, stat.size + 1 - filled));
    const zip_int64_t got = zip_fread(entry.get(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0) return fail(zip_file_get_error(entry.get()));
    filled += static_cast<std::size_t>(got);
    bytes.resize(filled);
    if (got == 0) break;
  }
  if (bytes.size() != stat.size) return fail(zip_file_get_error(entry.get()));
  return bytes;
}

bool is_archive(std::span<const std::byte> bytes) {
  constexpr std::string_view mark = "PK\x03\x04";
  return text_in(bytes).starts_with(mark);
}

Result<std::string> find_model(const std::vector<std::string>& names, std::string_view archive) {
  std::vector<std::string> models;
  std::ranges::copy_if(names, std::back_inserter(models), is_model);
  // A text file counts as a model only if the archive has no other file.
  std::vector<std::string> files;
  std::ranges::copy_if(names, std::back_inserter(files), [](const auto& name) { return !is_hidden(name); });
  if (files.size() == 1 && is_text(ending_of(files[0]))) models = files;
  if (models.empty()) {
    const auto is_other = [](const auto& name) { return is_readable(name) && !is_text(ending_of(name)); };
    const auto other = std::ranges::find_if(names, is_other);
    return broken(archive, cat("expected an archive with a cloud or a mesh, found none in it",
                               other == names.end() ? "" : cat(", but ", *other, "; unpack it first")));
  }
  // In a 3MF file, the other models are parts of the main model.
  for (const std::string& model : models)
    if (model == "3D/3dmodel.model" || model == "3D/3DModel.model") return model;
  if (models.size() > 1)
    return broken(archive, cat("expected an archive with one cloud or mesh, found ", models.size(), ": ",
                               models[0], " and others; unpack it first"));
  return models[0];
}

bool has_arrays_alone(const std::vector<std::string>& names) {
  return !names.empty() && std::ranges::all_of(names, [](const auto& name) {
    return is_hidden(name) || name.ends_with(".npy");
  });
}

Result<std::string> find_array(const std::vector<std::string>& names, std::string_view archive) {
  constexpr std::array usual = {"points", "pts3d",  "point_map", "pointmap",      "world_points", "xyz",
                                "depth",  "depths", "depth_map", "inverse_depth", "disparity",    "heights"};
  std::vector<std::string> arrays;
  std::ranges::copy_if(names, std::back_inserter(arrays),
                       [](const auto& name) { return name.ends_with(".npy"); });
  for (const char* const name : usual)
    if (std::ranges::find(arrays, cat(name, ".npy")) != arrays.end()) return cat(name, ".npy");
  if (arrays.size() == 1) return arrays[0];
  return broken(archive, arrays.empty() ? "expected an archive with an array, found none in it"
                                        : cat("expected an array named points, pts3d, depth or alike, found ",
                                              arrays.size(), " others, such as ", arrays[0],
                                              "; np.save writes one of them as NPY"));
}

}  // namespace relievo::app
