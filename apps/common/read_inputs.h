// What the commands read: clouds, meshes, depth images and scenes of them, with the flags that depth images
// need.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "relievo/depth_image.h"
#include "relievo/io.h"
#include "relievo/options.h"
#include "relievo/scan/surface.h"
#include "relievo/scene.h"

namespace relievo::cli {

struct InputArguments {
  DepthOptions depth;
  std::string camera;            // of a depth image: numbers, or a file with them
  double stream_above_mb = 512;  // larger files are read piece by piece where that is possible
};

// What was read, and what the user should know of it, in a line for each.
struct Input {
  CloudFile file;
  std::vector<std::string> remarks;
};

// Adds the flags of InputArguments.
void add_input_flags(CLI::App& command, InputArguments& arguments);

// Makes of a file's bytes what read_input() makes of the file.
Result<Input> parse_input(std::span<const std::byte> bytes, const std::string& path,
                          const InputArguments& arguments, double points, Progress* progress);

// Models to make one relief of, and what the user should know of their files, in a line for each.
struct SceneInput {
  Scene scene;
  std::vector<std::string> remarks;
};

// Whether that is a scene file, by its ending: .json.
bool is_scene_file(const std::string& path);

// Reads the files of those paths, one or several models, or one scene file (.json): of depth images and very
// large files what the view and the number of points in `relief` ask for. Errors: those of read_file(),
// read_cloud(), stream_front(), parse_camera(), depth_cloud(), read_scene_file(); kind option for a scene
// file among others.
Result<SceneInput> read_scene(const std::vector<std::string>& paths, const InputArguments& arguments,
                              const ReliefOptions& relief, Progress* progress);

// The paths, in one line.
std::string joined(const std::vector<std::string>& paths);

// What is looked at, and the side of it that is.
struct SceneArguments {
  std::vector<std::string> paths;
  std::string view = "front", up;
  InputArguments in;
};

// Adds INPUT, --view, --up and the flags of InputArguments.
void add_scene_flags(CLI::App& command, SceneArguments& arguments);

// Reads the inputs and finds the surface seen in their view, as `make` does. Errors: also those of
// parse_view(), seen_points() and find_surface().
Result<Surface> read_surface(const SceneArguments& arguments, Progress* progress);

}  // namespace relievo::cli
