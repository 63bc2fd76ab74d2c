// Reads the inputs of a relief from disk: clouds, meshes, depth images, and scenes that consist of these.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <map>
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

// A program in WebAssembly has at most 4 GiB of memory. About three million visible points fill it.
constexpr double most_points_at_once = sizeof(void*) == 4 ? 3e6 : std::numeric_limits<double>::infinity();

struct InputArguments {
  DepthOptions depth;
  double stream_above_mb = 512;  // larger files are read in blocks where that is possible
  bool are_pipes_fine = false;   // whether inputs may be pipes, as on a command line
  bool keeps_doubtful = false;   // see ReadOptions
  bool is_lithophane = false;    // the brightness of a picture then becomes thickness instead of height
  // Files with more points than this and without triangles are read in blocks, too.
  double most_points = most_points_at_once;

  bool operator==(const InputArguments&) const = default;
};

// The view of the scene, and the number of points to keep of a file that has more.
struct PointsWanted {
  View view;
  double points = MeshSampling{}.points;
};

// A file whose bytes came from an archive, with its name for messages.
struct UnpackedFile {
  std::vector<std::byte> bytes;
  std::string name;  // "a.npz/points.npy"
};

// If the bytes are an archive whose name ends in .npz or that contains only NumPy arrays, returns the array that
// find_array() chooses. Returns nothing for any other file.
Result<std::optional<UnpackedFile>> unpack_array(std::span<const std::byte> bytes, const std::string& path);

// Reads the bytes of a cloud or mesh as read_cloud() does. Also reads the files in the folder of `path` to
// which the model refers. The bytes may also be a ZIP archive with one model and the files to which it
// refers.
Result<CloudFile> read_cloud_at(std::span<const std::byte> bytes, const std::string& path,
                                bool keeps_doubtful = false);

// If the value of an option such as `camera` is the path of a file, replaces it by the file's text. A relative path
// starts at the folder. Any other value stays as it is. Errors: kind input if the file exists but cannot be read.
Result<void> take_text_of_file(std::string_view option, const std::string& folder, OptionValues& values);

// Returns the points of a depth image. Errors and remarks call it `name`. Errors: those of depth_cloud().
Result<SceneModel> take_depths(const DepthImage& image, const std::string& name,
                               const InputArguments& arguments, double points, Progress* progress);

// Reads the model in the bytes of the file at `path`. The ending of `path` determines the format.
Result<SceneModel> parse_input(std::span<const std::byte> bytes, const std::string& path,
                               const InputArguments& arguments, double points, Progress* progress);

std::vector<std::string> remarks_of(const Scene& scene);

// Returns whether the path ends in .json, as those of scene files do.
bool is_scene_file(const std::string& path);

// Reads the files at the paths: one or several models, or one scene file (.json). From depth images and very
// large files keeps only the points that are `wanted`. Errors: those of read_file(), read_cloud(),
// stream_front(), depth_cloud(), read_scene_file(); kind option for a scene file together
// with other files.
Result<Scene> read_scene(const std::vector<std::string>& paths, const InputArguments& arguments,
                         const PointsWanted& wanted, Progress* progress);

// Sets the height map of a base. Errors: kind option if the base has kind image and `image` is null, or if it
// has another kind and `image` is not null.
Result<void> take_base_image(std::shared_ptr<const Image<float>> image, BaseOptions& base);

// Returns the height map in the file of that path; null for an empty path. Errors: kind input.
Result<std::shared_ptr<const Image<float>>> read_base_image(const std::string& path);

// Returns the texts joined to one text, with `between` as the separator.
std::string joined(const std::vector<std::string>& texts, std::string_view between = ", ");

// Returns the result. If it is an error that names no input, the error gets this name.
template <typename T>
Result<T> naming(const std::string& name, Result<T> result) {
  if (!result && result.error().input.empty()) result.error().input = name;
  return result;
}

// The bytes of the fonts and drawings that a project contains, by their names in the project.
using OrnamentFiles = std::map<std::string, std::vector<std::byte>, std::less<>>;

// Returns the ornaments in a JSON text. Error messages call it `name`. Relative paths start at `folder`:
//   {"ornaments": [{"kind": "text", "text": "LIBERTAS", "arc": "top", "size": 3}, {"kind": "beads"},
//                  {"kind": "drawing", "file": "crest.svg", "size": 20, "at": [0, 30]}]}
// The list may also stand alone. docs/lettering.md lists all keys. Errors: kind input for a text that is not JSON,
// unknown keys, values of another type, and files that cannot be read.
Result<std::vector<Ornament>> parse_ornaments(std::string_view text, const std::string& name,
                                              const std::string& folder, const OrnamentFiles& inside = {});

// Returns whether the value of `ornaments` is JSON itself, an object or a list, and not a path.
bool is_ornament_json(std::string_view value);

// Replaces the path of each font and each drawing by the result of change(path). `font` and `ornaments` are the
// values of these options; either may be null. If `ornaments` is the path of a list, that path is replaced.
void change_ornament_paths(std::string* font, std::string* ornaments,
                           const std::function<std::string(const std::string&)>& change);

// Calls the function above with the values of `font` and `ornaments` in `options`.
void change_ornament_paths(OptionValues& options,
                           const std::function<std::string(const std::string&)>& change);

// Reads the files that the options `font` and `ornaments` name. A file that `inside` contains is taken from there. A
// font that other options still refer to is not read again, unless its file has changed. Errors: those of
// read_file() and parse_ornaments().
Result<void> read_ornaments(ReliefOptions& options, const OrnamentFiles& inside = {});

}  // namespace relievo::app
