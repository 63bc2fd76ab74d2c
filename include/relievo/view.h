// The view (stage 2): which side of the model becomes the relief.
#pragma once

#include <string_view>

#include "relievo/scan/cloud.h"

namespace relievo {

// Rotation from the model's frame into the view's: x to the right, y up, z towards the viewer, who looks down
// -Z.
struct View {
  Mat3 rotation = Mat3::Identity();
};

// Returns the view of the side that `towards_viewer` points out of: (0, 0, 1) sees the front of a model whose
// front is +Z. `up` is shown upright. Neither needs to be unit length; if up is parallel to the direction, an
// up axis is chosen. Errors: kind option if either is zero or not finite.
Result<View> view_towards(const Vec3& towards_viewer, const Vec3& up = Vec3::UnitY());

// The same for "front" "back" "left" "right" "top" "bottom" or three numbers "X,Y,Z". front is +Z, right +X,
// top +Y; top and bottom show -Z and +Z upright unless `up` is given. Errors: kind option for any other text.
Result<View> parse_view(std::string_view text, std::string_view up = {});

// Paper, equation (1): rotation by theta_x about X, then by theta_y about Y, in radians.
View view_from_euler(double theta_x, double theta_y);

// From a quaternion (w, x, y, z), normalised here. Errors: kind option if it is zero or not finite.
Result<View> view_from_quaternion(double w, double x, double y, double z);

// Returns the cloud seen in the view, moved so that the centre of its box (in the model's frame) is the
// origin.
Cloud in_view(const Cloud& cloud, const View& view);

// How much relief a side of the model shows: the sum of the differences between the normals of neighbouring
// places in the picture, depth jumps left out.
struct ViewGuess {
  std::string_view name;
  double score = 0;
};

// Returns the six sides along the axes, the one that shows most first. Estimates normals if there are none.
std::array<ViewGuess, 6> rank_views(const Cloud& cloud);

}  // namespace relievo
