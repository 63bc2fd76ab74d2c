// Defines the view (stage 2), which is the side of the model that the relief shows.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

struct Cloud;

// A part of a model, as shares of its bounding box in view coordinates: x from left to right, y from bottom
// to top, and depth from the nearest to the farthest point.
struct Crop {
  Vec2 least = Vec2::Zero(), most = Vec2::Ones();
  double nearest = 0, farthest = 1;

  bool operator==(const Crop&) const = default;
};

// A direction of view, and the part of the model to show. R_view_model maps the model's axes to the view's:
// p_view = R_view_model p_model. In the view, x points to the right, y up, and z towards the viewer, who
// looks along -z.
struct View {
  Mat3 R_view_model = Mat3::Identity();
  Crop crop = {};
  bool has_crumbs = false;  // whether small parts of the surface (crumbs) are shown, see find_surface()
  int most_pieces = 0;      // number of the largest connected parts that are shown; 0 for all
  bool has_plane = true;    // whether a table or background is shown, see find_support_plane()
  // The widest gap, in rho, that is closed between two surfaces that turn away from the viewer, such as
  // fingers. Sampling leaves gaps of up to 2.4 rho there. For meshes the exact gaps are known, and `gap` is
  // ignored.
  double gap = 2.4;
  std::optional<double> denoise = {};  // noise to remove, in rho, [0, 1]; default: the measured noise
  // Whether the surface is found by the rules of Nie et al. alone, for Method::paper (src/paper/surface.h).
  bool is_paper = false;
  // Whether to rotate the view to the best side when the model is known, see chosen_view() in scene.h.
  bool is_best = false;

  bool operator==(const View&) const = default;

  // Returns this view for Method::paper, which removes neither noise nor crumbs.
  View for_paper() const {
    View view = *this;
    view.is_paper = view.has_crumbs = true;
    view.denoise = 0;
    return view;
  }

  // Returns the noise to remove, given the measured noise.
  double noise_to_remove(double measured) const { return denoise.value_or(measured); }
};

// Returns the view for the direction `towards_viewer`, which points from the model to the viewer: (0, 0, 1)
// shows the side +Z. `up` points upwards in the view. Neither needs unit length; if they are parallel,
// another up axis is chosen. Errors: kind option if either is zero or not finite.
Result<View> view_towards(const Vec3& towards_viewer, const Vec3& up = Vec3::UnitY());

// Returns the view with the name "front", "back", "left", "right", "top" or "bottom", or the view for the
// direction "X,Y,Z", which points from the model to the viewer. "front" shows the side +Z, "right" +X and
// "top" +Y. Without `up`, up is -Z in "top", +Z in "bottom" and +Y in all others. "auto" means the best side,
// to be chosen later (View::is_best), and allows no `up`. Errors: kind option for any other text, and for an
// `up` that is parallel to the view.
Result<View> parse_view(std::string_view text, std::string_view up = {});

// Returns the crop in a text "X0,Y0,X1,Y1" or "X0,Y0,X1,Y1,NEAR,FAR"; the whole model for an empty text.
// Errors: kind option for any other text, for numbers outside [0, 1], and for an upper limit that is not
// above the lower one.
Result<Crop> parse_crop(std::string_view text);

// Returns the noise to remove from a text: "auto" or a number in [0, 1], see View. Errors: kind option for
// any other text; the error's input is empty, for the caller to fill in.
Result<std::optional<double>> parse_denoise(std::string_view text);

// Returns the points of a cloud inside the view's crop, in their order.
Cloud cropped(const Cloud& cloud, const View& view);

// Returns the cloud in view coordinates: R_view_model (p - c), where c is the centre of the cloud's bounding
// box in the model's axes.
Cloud in_view(const Cloud& cloud, const View& view);

// A side of a model, with its names for parse_view(), and its score as a view. The score is the sum of the
// normal differences between neighbouring cells of a coarse image, except across depth jumps, times a weight.
struct ViewGuess {
  std::string name, up;
  double score = 0;
};

// Returns six perpendicular sides, each upright, with the highest score first. Outliers are ignored, and
// normals are estimated if the cloud has none.
// - For a cloud that was scanned from one side, the scanned side is the front, even if it is not along an
// axis; its hollow back has the score 0. If the outline has a broad foot on one side, that side is down. A
// camera at the origin is assumed to look along +Z with -Y up, or along -Z with Y up.
// - Other models are viewed along the axes. As in glTF, up is Y and the front is +Z. But if the model has a
// much wider foot at its least z than at its least y, up is Z and the front is -Y. If it has a much wider
// foot at its largest y, up is -Y and the front is -Z. The front's score is multiplied by 1.6.
std::array<ViewGuess, 6> rank_views(const Cloud& cloud);

}  // namespace relievo
