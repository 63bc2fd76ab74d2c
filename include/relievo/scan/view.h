// The view (stage 2): the side of the model that becomes the relief.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

struct Cloud;

// A part of a model, in shares of its box in view coordinates: x from the left to the right, y from below
// upwards, and depth from the nearest point to the farthest.
struct Crop {
  Vec2 least = Vec2::Zero(), most = Vec2::Ones();
  double nearest = 0, farthest = 1;

  bool operator==(const Crop&) const = default;
};

// A direction of view and the part of the model shown. R_view_model maps the model's frame to the view's,
// where x points to the right, y up and z towards the viewer, who looks along -z: p_view = R_view_model
// p_model.
struct View {
  Mat3 R_view_model = Mat3::Identity();
  Crop crop = {};
  bool has_crumbs = false;  // shows small pieces of the surface (crumbs), see find_surface()
  int most_pieces = 0;      // shows only so many pieces, the largest ones; 0: any number
  bool has_plane = true;    // shows a table or background, see find_support_plane()
  // The widest gap, in rho, that is closed between two surfaces that turn away from the viewer, such as fingers.
  // Sampling leaves gaps of up to 2.4 rho there. Meshes know their gaps, whatever this is.
  double gap = 2.4;
  std::optional<double> denoise = {};  // noise to remove, in rho, [0, 1]; default: the measured noise
  // True if the surface is found by the rules of Nie et al. alone, for Method::paper: see src/paper/surface.h.
  bool is_paper = false;
  // True if the best side is to be chosen once the model is known: see chosen_view() in scene.h.
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

// Returns the view from the direction `towards_viewer`, which points from the model to the viewer: (0, 0, 1)
// shows the side +Z. `up` points upwards in the view. Neither needs to have unit length; if they are
// parallel, another up axis is chosen. Errors: kind option if either is zero or not finite.
Result<View> view_towards(const Vec3& towards_viewer, const Vec3& up = Vec3::UnitY());

// Returns the view called "front", "back", "left", "right", "top" or "bottom", or the view from the direction
// "X,Y,Z", which points from the model to the viewer. "front" shows the side +Z, "right" +X and "top" +Y.
// Without `up`, -Z points upwards in "top", +Z in "bottom" and +Y in all others. "auto" is the best side,
// still to be chosen (View::is_best), and takes no `up`. Errors: kind option for any other text, and for an
// `up` that is parallel to the view.
Result<View> parse_view(std::string_view text, std::string_view up = {});

// Returns the part of a model given as "X0,Y0,X1,Y1" or "X0,Y0,X1,Y1,NEAR,FAR"; the whole model for an empty
// text. Errors: kind option for any other text, for numbers outside [0, 1], and for numbers that do not
// ascend.
Result<Crop> parse_crop(std::string_view text);

// Returns the noise to remove, given as "auto" or a number in [0, 1], see View. Errors: kind option for any
// other text; the error's input is empty, for the caller to fill in.
Result<std::optional<double>> parse_denoise(std::string_view text);

// Returns the points of a cloud that the view's crop shows, in their order.
Cloud cropped(const Cloud& cloud, const View& view);

// Returns the cloud in view coordinates: R_view_model (p - c), where c is the centre of the cloud's box in
// the model's frame.
Cloud in_view(const Cloud& cloud, const View& view);

// A side of a model, named as parse_view() takes it, and its score as the view of a relief. The score is the
// sum of the differences between the normals of neighbouring cells of a coarse image, without those across
// depth jumps, times a weight.
struct ViewGuess {
  std::string name, up;
  double score = 0;
};

// Returns six sides at right angles, the one with the highest score first, each upright. Outliers are left
// out, and normals estimated if the cloud has none.
// - A cloud that was scanned from one side gets that side, along an axis or not; its hollow back has the score
//   0. Upwards is where its outline has a broad foot on the other end. Cameras at the origin look along +Z with
//   -Y upwards, or along -Z with Y upwards.
// - Other models are seen along the axes. They have Y upwards and their front towards +Z, as in glTF, unless
//   they have a wide foot along Z or -Y and none along Y: then Z is upwards and the front is -Y, or -Y is
//   upwards and the front is -Z. The front's score is multiplied by 1.6.
std::array<ViewGuess, 6> rank_views(const Cloud& cloud);

}  // namespace relievo
