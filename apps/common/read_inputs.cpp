#include "common/read_inputs.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <map>

#include "common/archive.h"
#include "common/descriptor.h"
#include "common/files.h"
#include "common/scene_file.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"
#include "relievo/io/stream.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/view.h"
#include "relievo/scene.h"

namespace relievo::app {
namespace {

std::string remark_on_missing(const std::string& path, std::uint64_t points) {
  return cat(path, ": the file ends early; ", points, " points that its header promises are missing");
}

std::string remark_on(const DepthImage& image, const DepthCloud& made) {
  std::string line =
      cat(image.values.width, " x ", image.values.height, " depths, ", made.missing, " missing");
  if (made.marked > 0) line += cat(", ", made.marked, " of them at ", made.marker, ", where nothing is");
  if (made.background > 0)
    line += cat(", ", made.background,
                " points of background taken out, behind a depth jump (--background keep keeps them)");
  if (made.blur > 0)
    line += cat(", ", made.blur, " on blurred or ragged outlines taken out (--blur keep keeps them)");
  return line + cat(", smoothed within ", std::round(100 * made.noise) / 100, " pixels");
}

// Returns what the values of a depth image mean by default: heights in formats for terrain, and depths in all
// other formats.
DepthValues usual_values(const DepthImage& image) {
  const bool has_heights = image.pixel_size.x() > 0 || image.format.starts_with("table of heights");
  return has_heights ? DepthValues::height : DepthValues::depth;
}

// Reads a picture. If `options.values` is `automatic`, sets it to `luminance` for a coloured picture, and to
// usual_values() for all other pictures.
Result<DepthImage> read_values(std::span<const std::byte> bytes, const std::string& path,
                               DepthOptions& options) {
  const auto read = [&](bool is_luminance_wanted) {
    return read_depth_image(bytes, path, {is_luminance_wanted, options.channel});
  };
  if (options.values != DepthValues::automatic) return read(options.values == DepthValues::luminance);
  Result<DepthImage> image = read(false);
  if (image) options.values = usual_values(*image);
  if (image || options.channel > 0) return image;
  options.values = DepthValues::luminance;
  Result<DepthImage> bright = read(true);
  return bright ? std::move(bright) : std::move(image);
}

Result<SceneModel> read_depths(std::span<const std::byte> bytes, const std::string& path,
                               const InputArguments& asked, double points, Progress* progress) {
  InputArguments arguments = asked;
  RELIEVO_TRY(const DepthImage image, read_values(bytes, path, arguments.depth));
  return take_depths(image, path, arguments, points, progress);
}

class FileSource : public ByteSource {
 public:
  FileSource(const std::string& path, std::uint64_t size)
      : path_(path), size_(size), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}

  std::uint64_t size() const override { return size_; }
  Result<void> read(std::uint64_t offset, std::span<std::byte> to) override {
    while (!to.empty()) {
      const ssize_t got = ::pread(file_.number(), to.data(), to.size(), static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return input_error(path_, cat("byte ", offset), "expected a file that can be read");
      offset += static_cast<std::uint64_t>(got);
      to = to.subspan(static_cast<std::size_t>(got));
    }
    return {};
  }

 private:
  const std::string& path_;
  std::uint64_t size_;
  Descriptor file_;
};

// Returns the size of the file in bytes if it is so large that it may have to be read in blocks; nothing for
// smaller files. `most_points` is compared with the number of bytes, as each point takes at least one byte.
std::optional<std::uint64_t> large_size(const std::string& path, const InputArguments& arguments) {
  const std::optional<std::uint64_t> size = file_size(path);
  const double most = std::min(1e6 * arguments.stream_above_mb, arguments.most_points);
  if (!size || static_cast<double>(*size) <= most) return std::nullopt;
  return size;
}

// Returns whether the file that begins with `head` is a cloud with more points than can be read at once.
bool has_too_many_points(std::span<const std::byte> head, const std::string& path, std::uint64_t bytes,
                         double most_points) {
  const ScanSize size = scan_size(head, path, bytes);
  return size.is_stated && size.triangles == 0 && static_cast<double>(size.points) > most_points;
}

// Reads a large file in blocks. Returns nothing for small files and for formats that cannot be read in
// blocks.
Result<std::optional<SceneModel>> read_large(const std::string& path, const InputArguments& arguments,
                                             const PointsWanted& seen, Progress* progress) {
  const std::optional<std::uint64_t> size = large_size(path, arguments);
  if (!size) return std::nullopt;
  const bool is_large = static_cast<double>(*size) > 1e6 * arguments.stream_above_mb;
  FileSource source(path, *size);
  std::vector<std::byte> head(static_cast<std::size_t>(std::min<std::uint64_t>(*size, 1 << 20)));
  if (!source.read(0, head) || !can_stream(head, path)) return std::nullopt;
  if (!is_large && !has_too_many_points(head, path, *size, arguments.most_points)) return std::nullopt;
  RELIEVO_TRY(auto streamed,
              stream_front(source, path, seen.view, {seen.points, arguments.keeps_doubtful}, progress));
  SceneModel input{path, nullptr};
  input.remarks.push_back(
      cat(path, ": ", streamed.cloud.size(), " points for the ", streamed.input_points, " of the file"));
  for (const std::string& remark : streamed.remarks) input.remarks.push_back(cat(path, ": ", remark));
  if (streamed.missing_points > 0) input.remarks.push_back(remark_on_missing(path, streamed.missing_points));
  if (streamed.ignored_faces > 0)
    input.remarks.push_back(
        cat(path, ": left out the ", streamed.ignored_faces,
            " faces of the mesh, as it is read piece by piece; stream-above sets from which size"));
  input.file = std::make_shared<const CloudFile>(std::move(streamed.cloud), streamed.format);
  return input;
}

Result<SceneModel> read_input(const std::string& path, const InputArguments& arguments,
                              const PointsWanted& seen, Progress* progress) {
  RELIEVO_CHECK(begin_stage(progress, "read", 0));
  RELIEVO_TRY(std::optional<SceneModel> large, read_large(path, arguments, seen, progress));
  if (large) return *std::move(large);
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(path, arguments.are_pipes_fine));
  return parse_input(bytes, path, arguments, seen.points, progress);
}

Result<std::vector<SceneEntry>> entries_of(const std::vector<std::string>& paths) {
  if (paths.size() == 1 && is_scene_file(paths[0])) {
    RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(paths[0]));
    return read_scene_file(text_in(bytes), paths[0]);
  }
  std::vector<SceneEntry> entries;
  for (const std::string& path : paths) {
    if (is_scene_file(path)) return option_error(path, "expected a scene file alone, or models without one");
    entries.push_back({path});
  }
  return entries;
}

// Transforms the view of the scene into the coordinates of a model's file. If the pose mirrors the model, the
// x axis of the view is reversed; the view still shows the same points.
View seen_by_model(const View& view, const Pose& pose) {
  View own{view.R_view_model * turn_of(pose)};
  if (pose.is_mirrored) own.R_view_model.row(0) = -own.R_view_model.row(0);
  return own;
}

// Reads the only model of an archive, together with the files of the archive to which the model refers.
Result<CloudFile> read_archived_cloud(std::span<const std::byte> bytes, const std::string& path,
                                      bool keeps_doubtful) {
  RELIEVO_TRY(const Archive archive, Archive::open(bytes, path));
  const Result<std::string> found = find_model(archive.names(), path);
  // Formats such as USDZ are archives themselves. The reader knows which of their files to read.
  if (!found && ending_of(path) != "zip") return read_cloud(bytes, path, ReadOptions{{}, keeps_doubtful});
  RELIEVO_TRY(const std::string model, found);
  RELIEVO_TRY(const std::vector<std::byte> content, archive.content(model));
  const std::string folder = model.substr(0, model.find_last_of('/') + 1);
  const auto beside = [&](const std::string& file) { return archive.content(folder + file); };
  return read_cloud(content, cat(path, "/", model), ReadOptions{beside, keeps_doubtful});
}

// The points of a depth image, and the meaning of its values.
struct ReadDepths {
  DepthCloud made;
  DepthValues values;
};

SceneModel model_of(const std::string& name, const DepthImage& image, const std::string& remark,
                    ReadDepths read) {
  auto& [made, values] = read;
  auto pixels =
      std::make_shared<const PixelUses>(std::move(made.uses), made.reduction, values, image.pixel_shape());
  return {name,
          std::make_shared<const CloudFile>(std::move(made.cloud), image.format),
          {},
          {remark},
          std::move(pixels)};
}

// Returns the model of a picture whose brightness determines the thickness of a lithophane.
Result<SceneModel> take_picture(const DepthImage& image, const std::string& name,
                                const DepthOptions& options) {
  RELIEVO_TRY(DepthCloud made, naming(name, picture_cloud(image, options)));
  std::string remark = cat(name, ": ", image.values.width, " x ", image.values.height,
                           " pixels, whose brightness becomes thickness");
  if (made.missing > 0) remark += cat("; ", made.missing, " without a value are white");
  return model_of(name, image, remark, {std::move(made), options.values});
}

}  // namespace

bool is_scene_file(const std::string& path) {
  return ending_of(path) == "json";
}

Result<std::optional<UnpackedFile>> unpack_array(std::span<const std::byte> bytes, const std::string& path) {
  if (!is_archive(bytes)) return std::nullopt;
  RELIEVO_TRY(const Archive archive, Archive::open(bytes, path));
  const std::vector<std::string> names = archive.names();
  if (ending_of(path) != "npz" && !has_arrays_alone(names)) return std::nullopt;
  RELIEVO_TRY(const std::string name, find_array(names, path));
  RELIEVO_TRY(std::vector<std::byte> content, archive.content(name));
  return UnpackedFile{std::move(content), cat(path, "/", name)};
}

Result<CloudFile> read_cloud_at(std::span<const std::byte> bytes, const std::string& path,
                                bool keeps_doubtful) {
  if (is_archive(bytes)) return read_archived_cloud(bytes, path, keeps_doubtful);
  const auto beside = [&](const std::string& name) {
    return read_file((std::filesystem::path(path).parent_path() / name).string());
  };
  return read_cloud(bytes, path, ReadOptions{beside, keeps_doubtful});
}

Result<void> take_text_of_file(std::string_view option, const std::string& folder, OptionValues& values) {
  const auto found = values.find(option);
  std::string* const text = found == values.end() ? nullptr : std::get_if<std::string>(&found->second);
  if (!text || text->empty()) return {};
  const std::string path = path_in(folder, *text);
  if (!is_there(path)) return {};  // parsing the option will report the error
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(path));
  *text = text_in(bytes);
  return {};
}

Result<SceneModel> take_depths(const DepthImage& image, const std::string& name,
                               const InputArguments& arguments, double points, Progress* progress) {
  DepthOptions options = arguments.depth;
  options.points = points;
  if (arguments.is_lithophane && options.values == DepthValues::luminance)
    return take_picture(image, name, options);
  RELIEVO_TRY(DepthCloud made, naming(name, depth_cloud(image, options, progress)));
  const std::string remark = cat(name, ": ", remark_on(image, made));
  return model_of(name, image, remark, {std::move(made), options.values});
}

Result<SceneModel> parse_input(std::span<const std::byte> bytes, const std::string& path,
                               const InputArguments& arguments, double points, Progress* progress) {
  RELIEVO_TRY(const std::optional<UnpackedFile> array, unpack_array(bytes, path));
  if (array) return parse_input(array->bytes, array->name, arguments, points, progress);
  if (is_picture(bytes)) return read_depths(bytes, path, arguments, points, progress);
  RELIEVO_TRY(CloudFile file, read_cloud_at(bytes, path, arguments.keeps_doubtful));
  std::vector<std::string> remarks = remarks_on(file);
  for (std::string& line : remarks) line = cat(path, ": ", line);
  return SceneModel{path, std::make_shared<const CloudFile>(std::move(file)), {}, std::move(remarks)};
}

std::vector<std::string> remarks_of(const Scene& scene) {
  std::vector<std::string> all;
  for (const SceneModel& model : scene.models)
    all.insert(all.end(), model.remarks.begin(), model.remarks.end());
  return all;
}

Result<Scene> read_scene(const std::vector<std::string>& paths, const InputArguments& arguments,
                         const PointsWanted& wanted, Progress* progress) {
  RELIEVO_TRY(const std::vector<SceneEntry> entries, entries_of(paths));
  Scene made;
  std::map<std::string, std::shared_ptr<const CloudFile>> known;  // a file is read once for all its poses
  for (const SceneEntry& entry : entries) {
    if (known.contains(entry.path)) {
      made.models.push_back({entry.path, known[entry.path], entry.pose});
      continue;
    }
    RELIEVO_TRY(
        SceneModel model,
        read_input(entry.path, arguments, {seen_by_model(wanted.view, entry.pose), wanted.points}, progress));
    if (!large_size(entry.path, arguments)) known[entry.path] = model.file;
    model.pose = entry.pose;
    made.models.push_back(std::move(model));
  }
  return made;
}

Result<void> take_base_image(std::shared_ptr<const Image<float>> image, BaseOptions& base) {
  const bool is_image = base.kind == BaseKind::image;
  if (is_image && !image) return option_error("base", "expected base-image with image, found none");
  if (!is_image && image)
    return option_error("base-image",
                        cat("expected base image with it, found ", name_in(base_choices, base.kind)));
  base.image = std::move(image);
  return {};
}

Result<std::shared_ptr<const Image<float>>> read_base_image(const std::string& path) {
  if (path.empty()) return nullptr;
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(path, true));
  RELIEVO_TRY(DepthImage image, read_depth_image(bytes, path));
  return std::make_shared<const Image<float>>(std::move(image.values));
}

std::string joined(const std::vector<std::string>& texts, std::string_view between) {
  std::string all;
  for (const std::string& text : texts) all += cat(all.empty() ? "" : between, text);
  return all;
}

}  // namespace relievo::app
