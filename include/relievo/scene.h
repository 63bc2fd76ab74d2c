// Arranges several models in one relief, and samples the points of all models that the viewer sees.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/scan/depth_image.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/view.h"
#include "relievo/view_sample.h"

namespace relievo {

class Progress;
struct MadeRelief;
struct ReliefOptions;

// The placement of a model in a scene. The model is mirrored, scaled and rotated about the centre of its
// bounding box, which excludes outliers, and then translated.
struct Pose {
  Vec3 rotate_deg = Vec3::Zero();  // about x, then y, then z, which are fixed axes; 90 about z maps x to y
  std::optional<Vec3> translate = {};  // in the units of the files; default: see place_models()
  double scale = 1;                    // > 0
  bool is_mirrored = false;            // whether x is reversed before scaling and rotating
  // The height of the model's highest point above the surface behind it, as a share of the relief's height,
  // in [0.01, 0.9]; see OwnHeights. If not given, the relief's method determines it.
  std::optional<double> height = {};

  bool operator==(const Pose& other) const;
};

inline constexpr double least_own_height = .01, most_own_height = .9;

// Returns the rotation of a pose, preceded by a reflection if the pose is mirrored.
Mat3 turn_of(const Pose& pose);

// The use of each pixel of a depth image, and how its values were interpreted.
struct PixelUses {
  Image<PixelUse> uses;  // see DepthCloud
  int reduction = 1;
  DepthValues values = DepthValues::depth;
  Vec2 pixel_shape = Vec2::Ones();  // see DepthImage::pixel_shape()
};

struct SceneModel {
  std::string name;                       // name for errors and notes
  std::shared_ptr<const CloudFile> file;  // not null
  Pose pose = {};
  std::vector<std::string> remarks = {};         // messages about parts of the file that were not read
  std::shared_ptr<const PixelUses> pixels = {};  // null if the file is not a depth image
};

// A scene of at least one model. If no pose has a `translate`, the models are arranged for the view, see
// place_models().
struct Scene {
  std::vector<SceneModel> models;
};

// Maps a point p of the file to scale * turn * p + offset in the scene.
struct PlacedModel {
  Mat3 turn = Mat3::Identity();  // see turn_of()
  double scale = 1;
  Vec3 offset = Vec3::Zero();

  Vec3 operator()(const Vec3& p) const { return scale * (turn * p) + offset; }
};

// Returns the placement of each model.
// - If any pose has a `translate`, the poses place all models; models from files with common axes then fit
// together.
// - A single model does not move.
// - Otherwise the models are arranged for the view: side by side from left to right on a common ground line,
// with their centres at the same depth, and with gaps of 8 % of their height. The first model keeps its size
// and, unless it is rotated, its position. Each other model is scaled to the height of the first. If it would
// then be wider than one and a half times that height, it is scaled to that width instead. The `scale` of
// its pose multiplies this size: with 0.5 it is half as high as the first.
// Errors: kind option for a scene without models, for a scale not in [1e-6, 1e6], and for angles and
// translations that are not finite.
Result<std::vector<PlacedModel>> place_models(const Scene& scene, const View& view);

// Returns the best side of the scene for a relief, see rank_views(). If there are several models, or a pose
// moves the only model, the best side is always the front, because models are arranged to be viewed from the
// front. At most a million points are examined.
ViewGuess best_side(const Scene& scene);

// Returns the view, rotated so that it shows the given side.
View on_side(View view, const ViewGuess& side);

// Returns the view. If View::is_best is set, it is rotated to the best side.
View chosen_view(const Scene& scene, const View& view);

// Returns the default number of visible points: 300,000. For a scene of only meshes it is 15 per triangle if
// that is less, because meshes have no finer detail than their triangles. It is at least 100,000, for smooth
// outlines.
double usual_points(const Scene& scene);

// Returns the points of all placed models, in the scene's axes. `points` is the wanted number of points, by
// default usual_points().
// - All meshes together give about the wanted number of points, and none on hidden parts. Outliers of clouds
// are left out.
// - All models get about the same sampling distance. A scene with meshes gets the distance at which the
// wanted number of points is visible. A scene of only clouds gets that distance or the distance of the finest
// cloud, whichever is larger. Clouds that are finer than the scene are subsampled to this distance. Clouds
// that are much coarser keep only their visible points, and points are added between these.
// - Normals are estimated or oriented separately for each model.
// - If any model has colours, models without colours become white.
// - A single cloud that is not moved keeps all points of its file but outliers.
// Errors: those of place_models() and sample_mesh(); kind geometry, naming the model, if a cloud has fewer
// than 4 points or if most of its points are equal; kind cancelled.
Result<ViewSample> sample_for_view(const Scene& scene, const View& view, std::optional<double> points,
                                   Progress* progress = nullptr);

// Returns the plate with the relief of the scene, like make_relief() for a file. Frees the clouds as soon as
// their points are sampled, unless the caller owns them, too.
Result<MadeRelief> make_relief(Scene scene, const ReliefOptions& options, Progress* progress = nullptr);

}  // namespace relievo
