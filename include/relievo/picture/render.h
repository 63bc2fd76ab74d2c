// Draws pictures of frames on the CPU, in milliseconds, for programs that show a relief while the user edits
// it. For pictures of a finished solid see render_preview().
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "relievo/core/image.h"
#include "relievo/core/progress.h"
#include "relievo/picture/material.h"
#include "relievo/plate/solid.h"
#include "relievo/relief/frame.h"
#include "relievo/scan/surface.h"

namespace relievo {

struct Picture {
  Image8 image;  // 4 channels
  // The scale of the plate's plane in the front view. CloudRenderer writes the pixels per unit of the scan.
  double pixels_per_mm = 1;
};

// A camera that is rotated first about the vertical axis of the picture, then about the horizontal one.
// Without rotation it shows the plate from the front.
struct Camera {
  double yaw_deg = 0, pitch_deg = 0;
  double zoom = 1;          // at zoom 1 the plate just fits into the picture
  Vec2 pan = Vec2::Zero();  // point of the plate's plane, in mm, at the centre of the picture

  bool operator==(const Camera&) const = default;
};

struct RenderOptions {
  int width = 800, height = 600;  // size of the picture in pixels, see has_size()
  double mm_per_unit = 1;         // millimetres per unit of the model
  double margin_mm = 5, thickness_mm = 3;
  Camera camera;
  Material material = Material::plaster;
  Vec3f light = upper_left_lamp;  // direction to the lamp, in the axes of the plate; not zero
  bool has_shadows = true;        // whether the relief casts shadows on itself, and hollows are darker
  bool is_fine = false;           // nine samples per pixel and finer shadows; takes five times as long

  // Returns whether width and height are in [1, 8192]. If not, pictures are empty.
  bool has_size() const { return std::min(width, height) >= 1 && std::max(width, height) <= 8192; }

  bool operator==(const RenderOptions&) const = default;
};

// Detail of the normals that is finer than the points of a coarse surface: -(n_x, n_y) on a grid of square
// cells over the view plane. The first row is the lowest. Cells are NaN where the scan has no points and
// along silhouettes and depth jumps.
struct SurfaceDetail {
  Vec2f corner = Vec2f::Zero();  // lower left corner of the grid, in the coordinates of the surface's points
  float cell = 1;
  Image<Vec2f> xy;
  std::vector<Vec2f> own;  // per point of the surface: -(n_x, n_y) of the point's normal
};

// The heights and normals for drawing a surface, one per point.
struct Shown {
  std::span<const float> heights;                  // above the ground, in the model's units
  std::span<const Vec3f> normals;                  // unit length
  float stretch = 1;                               // factor of heights and normals in the picture, > 0
  std::optional<std::array<float, 2>> range = {};  // lowest and highest height; determined if not given
  // The detail is multiplied by the gains, one per point, and added to the slopes interpolated between the
  // points, see FrameMaker::write_gains().
  const SurfaceDetail* detail = nullptr;
  std::span<const float> gains = {};
  // If not empty: a share in [0, 1] per point, which colours the relief from blue (0) to orange (1).
  std::span<const float> tint = {};
};

// The size of the plate with its relief, and the position of the relief's middle relative to the plate's
// middle. If the plate is bent around a wrap, the position is that before bending.
struct PlacedRelief {
  Vec3 size_mm = Vec3::Zero();
  Vec2 middle_mm = Vec2::Zero();
};

// Draws frames of one model on a plate. The plate is rectangular without a rim; render_on() draws other
// plates. The background is transparent (opacity 0) except for the plate's soft shadow. For the front view
// the visible triangle of each pixel is cached: if only heights or light change, a picture takes one look-up
// per pixel, about 10 ms for 500,000 pixels on two cores. Other views take three times as long. Not for
// concurrent use.
class FrameRenderer {
 public:
  // Shares ownership of the surface. Uses its points, their normals, the triangles with their hull, and
  // Boundary::is_inside. The second constructor draws the surface of a model.
  explicit FrameRenderer(std::shared_ptr<const Surface> surface);
  explicit FrameRenderer(const std::shared_ptr<const ReliefModel>& model);
  FrameRenderer(FrameRenderer&&) noexcept;
  ~FrameRenderer();

  // Overwrites the picture; it gets no pixels if options.has_size() is false. `shown` has an entry for
  // each point of the model's surface. After cancellation the picture is unfinished.
  void render(const Shown& shown, const RenderOptions& options, Picture& picture,
              const Progress* progress = nullptr);

  // Draws `shown` on a plate of any outline and base, bent around the wrap of `plate`, with or without a rim,
  // mirrored or as a die. Of the lengths in `options`, only mm_per_unit is used. There must be no ornaments,
  // and a plate without ground must have a plane base and no wrap. The plate is kept for the next picture. If
  // only the height of the rim has changed since the plate was made, pictures that are not fine show the old
  // bevel of the rim. Errors: those of make_plate() and wrap_plate().
  Result<PlacedRelief> render_on(const PlateOptions& plate, const Shown& shown, const RenderOptions& options,
                                 Picture& picture, const Progress* progress = nullptr);

  // Returns the uncompressed model: its depths above its lowest visible point.
  Shown original() const;

  // Returns `samples` heights in mm above the ground. They are evenly spaced along the line between two
  // positions in the plate's plane. The positions are in mm from the middle of the relief. Outside the relief
  // the height is 0.
  std::vector<float> profile(const Shown& shown, const RenderOptions& options, const Vec2& from,
                             const Vec2& to, std::size_t samples);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Draws a cloud from any direction, for choosing a view. Points are drawn as overlapping discs.
class CloudRenderer {
 public:
  // Copies at most 250,000 of the cloud's points. Estimates normals if there are none.
  explicit CloudRenderer(const Cloud& cloud);

  // Overwrites the picture with the cloud in that view, on a transparent background.
  void render(const View& view, int width, int height, Picture& picture) const;

 private:
  Cloud cloud_;
  Vec3 centre_ = Vec3::Zero();
  double radius_ = 1, spacing_ = 0;
  bool has_signed_normals_ = true;
};

}  // namespace relievo
