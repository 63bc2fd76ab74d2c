// What the commands read: clouds, meshes and depth images, with the flags that depth images need.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "relievo/depth_image.h"
#include "relievo/io.h"
#include "relievo/options.h"
#include "relievo/surface.h"

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

// Reads the file of that path: of a depth image or a very large file what the view and the number of points
// in `relief` ask for. Errors: those of read_file(), read_cloud(), stream_front(), parse_camera(),
// depth_cloud().
Result<Input> read_input(const std::string& path, const InputArguments& arguments,
                         const ReliefOptions& relief, Progress* progress);

// A scan and the side of it that is looked at.
struct SceneArguments {
  std::string path, view = "front", up;
  InputArguments in;
};

// Adds INPUT, --view, --up and the flags of InputArguments.
void add_scene_flags(CLI::App& command, SceneArguments& arguments);

// Reads a scan and finds the surface seen in its view, as `make` does. Errors: also those of parse_view(),
// sample_mesh() and find_surface().
Result<Surface> read_surface(const SceneArguments& arguments, Progress* progress);

}  // namespace relievo::cli
