// Defines the parameters that shape a relief. All of them can change from frame to frame, because the
// prepared model does not depend on them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "relievo/relief/light.h"

namespace relievo {

struct Stroke;
class ToneCurve;

enum class Style {
  // Uses equations (5) to (7), and adds detail to the heights. For a surface from find_surface(), this style
  // applies the paper's rules to our points and edges. Coarse reliefs of a turned model and the reference
  // heights of SubspaceModel are made in this way. Models of Method::paper make their reliefs by
  // ReliefModel::paper(), whichever style is given.
  paper_weights,
  layered  // compresses normals layer by layer, and fine layers least; compresses heights by HeightCorrection
};

// Height and saturation of a relief. The paper's height coefficient is alpha. For every beta > 0, u =
// alpha^-beta is equivalent to alpha. At beta = 0, where alpha has no effect, u still gives every height.
struct Compression {
  double u = 1;  // [0, infinity]; 0: flat; infinity: normals unchanged (if beta > 0, only where k is not 0)
  double beta = 0;  // saturation coefficient, [0, 100]; 0 compresses all points equally
  // If set, the curve replaces the exponential of equation (6): w_k = 1 - (1 - curve(|k|))^u. So u still
  // determines the height; at u = 1, w_k is the value of the curve. With a curve, beta has no effect.
  std::shared_ptr<const ToneCurve> curve = nullptr;

  // Curves are equal if they have the same points.
  bool operator==(const Compression& other) const;

  // Returns the compression for the paper's alpha, in [0, infinity), and beta.
  static Compression from_alpha(double alpha, double beta);
  // Returns the paper's height coefficient u^(-1/beta); NaN if beta = 0, which leaves it undetermined.
  double alpha() const;
};

// A list of strokes that several shapes may share; null for none. Compares equal if the strokes are equal.
struct SharedStrokes {
  std::shared_ptr<const std::vector<Stroke>> list = nullptr;

  bool operator==(const SharedStrokes& other) const;
};

struct Shape {
  Compression compression;    // height and saturation
  double gamma = 0;           // detail coefficient, [0, 1]; in the layered style it attenuates coarse layers
  double max_slope = 4;       // largest target slope, > 0; 4 is 76 degrees
  double boundary_width = 2;  // width of the soft rim by equation (7), in units of rho, > 0
  // Least share of the height for steps at depth jumps, [0, 0.95]; 0 removes the jumps. If slopes alone do
  // not reach a requested height, these steps add the rest.
  double steps = 0;
  Style style = Style::paper_weights;
  // Whether the search for a height also chooses beta, by Algorithm 1. Used only by ReliefModel::paper().
  bool is_beta_free = false;
  // The height of the relief, as a share of the height that equation (9) gives for its slopes, (0, 1];
  // usual_height_share() if not set. A smaller share shows more of the model's shapes. This and the following
  // members are used only by the layered style.
  std::optional<double> height_share = {};
  bool is_corrected = true;  // whether HeightCorrection compresses the heights
  // Least height of the step from a part of the model down to the surface behind it or to the base, as a
  // share of the relief's height, [0, 0.3].
  double planes = 0;
  // The light for which slopes are chosen; only for exact models.
  std::optional<ReliefLight> light = {};
  // Exponent of the attention, [0, 4]. It multiplies u of the fine and middle layers by exp(attention (A -
  // mean A)), where A in [0, 1] estimates where viewers look; 0 treats all parts alike. Only for exact
  // models.
  double attention = 0;
  // Local changes of the finished heights, for all methods except the paper's. If a stroke changes the
  // highest point, all heights are scaled, so that the height of the relief stays the same.
  SharedStrokes strokes = {};
  // The depth by which lines that are dark in the scan are lowered, in the surface's units, >= 0.
  double line_depth = 0;

  bool operator==(const Shape&) const = default;
};

// Returns the height share of layered shapes for u in [0, infinity]. It is 0.4 at u = 0 and approaches 1 as u
// grows, so that high reliefs are compressed less.
double usual_height_share(double u);
// Returns the shape's height share, or the usual one if the shape has none.
double height_share(const Shape& shape);

// Returns the default parameters of the layered style: planes of 7 %, beta = 0, and a slight attenuation of
// coarse layers.
Shape layered_shape();

}  // namespace relievo
