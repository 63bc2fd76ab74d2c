// The native engine behind the page: one scan, its relief, and pictures of both.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "export_file.h"
#include "project.h"
#include "relievo/make_relief.h"
#include "relievo/picture/render.h"
#include "relievo/session.h"

namespace relievo::studio {

// What is going on, for the page. `model` counts the models that were shown; 0 is none yet.
struct EngineStatus {
  bool is_busy = false;
  std::string stage;
  double fraction = 0;
  std::optional<Error> error;  // of the last opening or change of view
  Input input;                 // of the scan that is shown
  Input wanted;                // of the scan that was last asked for, and its view
  std::string view, up;
  std::uint64_t model = 0;
};

// What does not change while a model is shown.
struct ModelFacts {
  std::size_t input_points = 0, visible_points = 0, points = 0, triangles = 0, hull = 0;
  Vec2 size = Vec2::Zero();  // of the relief, in the scan's units
  double rho = 0, delta = 0;
  Mat3 rotation = Mat3::Identity();
  std::vector<std::string> remarks;
  std::vector<std::size_t> histogram;  // of sqrt(|k|), from 0 to 1
};

struct PictureRequest {
  ReliefOptions options;     // its view is not looked at
  std::optional<double> u;   // of the compression, in place of a height: then the height follows the shape
  bool is_original = false;  // the model itself in place of its relief
  RenderOptions render;      // lengths come from the options
};

struct PictureAnswer {
  Picture picture;
  Compression compression;  // that was found
  double height_mm = 0;
  bool is_height_met = true;
  FrameTimes times;
  double drawing_s = 0;
};

// Every method may be called from any thread. Those that draw take turns.
class Engine {
 public:
  Engine();
  ~Engine();

  // Reads the scan and prepares the view in the background; the old relief stays until the new one is ready.
  void open(const Input& input, const std::string& view, const std::string& up);

  // Prepares another view of the scan in the background. Errors: those of parse_view(); kind geometry if
  // there is no scan.
  Result<void> choose_view(const std::string& view, const std::string& up);

  void cancel();

  EngineStatus status() const;

  // Errors of the following: kind geometry if there is no relief yet.
  Result<ModelFacts> facts() const;
  Result<PictureAnswer> picture(const PictureRequest& request);
  Result<std::vector<float>> profile(const PictureRequest& request, const Vec2& from, const Vec2& to,
                                     std::size_t samples);

  // Draws the scan itself as it looks in a view.
  Result<Picture> scan_picture(const View& view, int width, int height);

  // The six sides, the one that shows most first.
  Result<std::vector<std::string>> suggest_views();

  // Returns a file of the relief: format as is_format() has them. The same bytes as `relievo
  // make` writes. Errors: those of make_relief(); kind option for another format, or if the view that the
  // options ask for is not the one prepared.
  Result<ExportedFile> make_file(const ReliefOptions& options, const std::string& format, int heightmap_px);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo::studio
