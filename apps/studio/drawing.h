// Draws the model that is shown: makes its frames and pictures, and knows its facts.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relievo/options.h"
#include "relievo/picture/render.h"
#include "studio/curve_samples.h"
#include "studio/frame_cache.h"

namespace relievo::app::studio {

// Facts about a model that hold as long as it is shown.
struct ModelFacts {
  std::size_t input_points = 0, visible_points = 0, points = 0, triangles = 0, hull = 0;
  Vec2 size = Vec2::Zero();  // of the relief, in the scan's units
  double area = 0;           // of the relief without its ground, in those units squared
  double noise = 0;          // that was removed, in sampling distances
  double rho = 0, delta = 0;
  Mat3 rotation = Mat3::Identity();
  std::vector<std::string> remarks;
  std::vector<std::size_t> histogram;  // of sqrt(|k|), from 0 to 1
};

struct PictureRequest {
  ReliefOptions options;     // its view is ignored
  std::optional<double> u;   // of the compression, in place of a height, which then follows the shape
  bool is_original = false;  // shows the model itself in place of its relief
  RenderOptions render;      // its lengths are set from the options
};

struct PictureAnswer {
  Picture picture;
  std::uint64_t scene = 0;  // number of what the picture shows besides the relief: plate, camera, light ...
  double drawing_s = 0;

  // The rest tells how a relief was made; a picture of the model itself leaves it at its defaults.
  Compression compression;  // that was found
  double height_mm = 0;
  bool is_height_met = true;
  FrameTimes times;
  CurveSamples curve;
};

// A line on the plate, in mm from the middle of the relief.
struct SectionLine {
  Vec2 from, to;
  std::size_t samples = 400;
};

// Keeps a tone curve as long as its points do, so that frames with the same curve are known to be the same.
class SharedToneCurve {
 public:
  // Returns the shape, see relievo::shape_of().
  Shape shape_of(const ReliefOptions& options);

 private:
  std::shared_ptr<const ToneCurve> curve_;  // null before the first
};

// Everything that needs a walk over all points is computed once, here. Not for concurrent use.
class Drawing {
 public:
  // Shares the model. `left_out` is the number of the scan's outliers.
  Drawing(std::shared_ptr<const ReliefModel> model, std::size_t left_out);

  const ModelFacts& facts() const { return facts_; }

  // Keeps showing the last frame, whatever is asked for, until another model is drawn.
  void freeze(bool is_frozen) { is_frozen_ = is_frozen; }

  // Draws a frame, with one solve unless the picture is to be fine.
  PictureAnswer picture(const PictureRequest& request);

  // Returns heights in mm, see FrameRenderer::profile().
  std::vector<float> profile(const PictureRequest& request, const SectionLine& line);

 private:
  RenderOptions render_options(const PictureRequest& request) const;
  double mm_per_unit(const ReliefOptions& options) const;
  FrameOptions frame_options(const PictureRequest& request);
  CachedFrame frame(const PictureRequest& request, bool is_exact);
  std::uint64_t number_of_scene(const RenderOptions& render);
  void render(const Shown& shown, const RenderOptions& render, PictureAnswer& answer);

  std::shared_ptr<const ReliefModel> model_;
  ModelFacts facts_;
  FrameRenderer renderer_;
  FrameCache frames_;
  SharedToneCurve tone_curve_;
  bool is_frozen_ = false;
  std::uint64_t scene_ = 0;
  RenderOptions scene_options_;  // of the scene of that number
};

}  // namespace relievo::app::studio
