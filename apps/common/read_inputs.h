// Reads the inputs of a relief from disk: clouds, meshes, depth images, and scenes that consist of these.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/io/read.h"
#include "relievo/option_table.h"
#include "relievo/options.h"
#include "relievo/scan/depth_image.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scene.h"

namespace relievo::app {

// The 4 GiB of memory that a program in WebAssembly has at most are filled by about three million points
// that the view shows.
constexpr double most_points_at_once = sizeof(void*) == 4 ? 3e6 : std::numeric_limits<double>::infinity();

struct InputArguments {
  DepthOptions depth;
  double stream_above_mb = 512;  // larger files are read in blocks where that is possible
  bool are_pipes_fine = false;   // whether inputs may be pipes, as on a command line
  bool keeps_doubtful = false;   // as in ReadOptions
  bool is_lithophane = false;    // whether the brightness of a picture becomes thickness, not height
  // Clouds of more points, without triangles, are read in blocks, too.
  double most_points = most_points_at_once;

  bool operator==(const InputArguments&) const = default;
};

// The view and the number of points to take from a file with more points than are needed.
struct PointsWanted {
  View view;  // the view of the scene
  double points = MeshSampling{}.points;
};

// Reads the bytes of a cloud or mesh as read_cloud() does, and the files beside `path` that it names. The
// bytes may also be a ZIP archive with one cloud or mesh and the files that it names.
Result<CloudFile> read_cloud_at(std::span<const std::byte> bytes, const std::string& path,
                                bool keeps_doubtful = false);

// Replaces the value of an option that names a file, such as `camera`, by the file's text. Errors: kind input, if
// it cannot be read.
Result<void> take_text_of_file(std::string_view option, OptionValues& values);

// Returns the points of a depth image, called `name` in errors and remarks. Errors: those of depth_cloud().
Result<SceneModel> take_depths(const DepthImage& image, const std::string& name,
                               const InputArguments& arguments, double points, Progress* progress);

// Reads the model in the bytes of the file at `path`. The ending of `path` determines the format.
Result<SceneModel> parse_input(std::span<const std::byte> bytes, const std::string& path,
                               const InputArguments& arguments, double points, Progress* progress);

// Returns the remarks of all models.
std::vector<std::string> remarks_of(const Scene& scene);

// Returns whether the path is that of a scene file, which ends in .json.
bool is_scene_file(const std::string& path);

// Reads the files of those paths: one or several models, or one scene file (.json). Depth images and very
// large files are reduced to the points that are `wanted`. Errors: those of read_file(), read_cloud(),
// stream_front(), depth_cloud(), read_scene_file(); kind option for a scene file together
// with other files.
Result<Scene> read_scene(const std::vector<std::string>& paths, const InputArguments& arguments,
                         const PointsWanted& wanted, Progress* progress);

// Sets the height map of a base of kind image; for other kinds `image` must be null. Errors: kind option if
// base and image do not fit together.
Result<void> take_base_image(std::shared_ptr<const Image<float>> image, BaseOptions& base);

// Returns the height map in the file of that path; null for an empty path. Errors: kind input.
Result<std::shared_ptr<const Image<float>>> read_base_image(const std::string& path);

// Returns the texts as one text, with `between` between them.
std::string joined(const std::vector<std::string>& texts, std::string_view between = ", ");

// Returns the result. If it is an error that names no input, the error gets this name.
template <typename T>
Result<T> naming(const std::string& name, Result<T> result) {
  if (!result && result.error().input.empty()) result.error().input = name;
  return result;
}

// Returns the ornaments of a JSON text, called `name` in errors. Relative paths start at the folder:
//   {"ornaments": [{"kind": "text", "text": "LIBERTAS", "arc": "top", "size": 3}, {"kind": "beads"},
//                  {"kind": "drawing", "file": "crest.svg", "size": 20, "at": [0, 30]}]}
// docs/lettering.md has all keys. Errors: kind input for a text that is not JSON, unknown keys, values of another
// type, and files that cannot be read.
Result<std::vector<Ornament>> parse_ornaments(std::string_view text, const std::string& name,
                                              const std::string& folder);

// Makes relative paths of the options `font` and `ornaments` of a project start at the project's folder.
void find_ornament_files(OptionValues& own, const std::string& folder);

// Reads the files that the options `font` and `ornaments` name. The text of `ornaments` is JSON itself if it begins
// with a brace. Errors: those of read_file() and parse_ornaments().
Result<void> read_ornaments(ReliefOptions& options);

}  // namespace relievo::app
