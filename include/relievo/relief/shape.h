// The quantities that shape a relief. All of them can change from frame to frame, because none of them
// affects the prepared model.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "relievo/relief/light.h"

namespace relievo {

struct Stroke;
class ToneCurve;

enum class Style {
  // Equations (5) to (7), and detail added to the heights. On the surface of find_surface() this is the
  // paper's rule on our points and edges; it serves coarse reliefs of a turned model and the reference
  // heights of SubspaceModel. Models of Method::paper make its reliefs by ReliefModel::paper(), whatever
  // the style.
  paper_weights,
  layered  // normals compressed layer by layer, fine ones least; heights compressed by HeightCorrection
};

// Height and saturation of a relief. The paper's height coefficient is alpha. For every beta > 0, u =
// alpha^-beta is equivalent to alpha; u also gives every height at beta = 0, where alpha has no effect.
struct Compression {
  double u = 1;     // [0, infinity]; 0 is flat, infinity keeps every normal that has curvature
  double beta = 0;  // saturation coefficient, [0, 100]; 0 compresses all points alike
  // If set, it replaces the exponential of (6): w_k = 1 - (1 - curve(|k|))^u. So u still determines the
  // height, and at u = 1 the share of the curve is kept. Beta then has no effect.
  std::shared_ptr<const ToneCurve> curve = nullptr;

  // Two curves are equal if they pass through the same points.
  bool operator==(const Compression& other) const;

  // Returns the compression of the paper's alpha, in [0, infinity), and beta.
  static Compression from_alpha(double alpha, double beta);
  // Returns the paper's height coefficient u^(-1/beta); NaN where beta = 0 leaves it undetermined.
  double alpha() const;
};

// Strokes that shapes share; null for none. Two are equal if they hold equal strokes.
struct SharedStrokes {
  std::shared_ptr<const std::vector<Stroke>> list = nullptr;

  bool operator==(const SharedStrokes& other) const;
};

struct Shape {
  Compression compression;    // height and saturation
  double gamma = 0;           // detail coefficient, [0, 1]; in the layered style it attenuates coarse layers
  double max_slope = 4;       // largest target slope, > 0; 4 is 76 degrees
  double boundary_width = 2;  // width of (7), in units of rho, > 0; a larger width softens the rim
  // Least share of the height for depth jumps, [0, 0.95]; 0 removes the jumps. If slopes alone do not reach a
  // requested height, jumps supply the rest.
  double steps = 0;
  Style style = Style::paper_weights;
  // If true, the search for a height also chooses beta, by Algorithm 1. Used only by ReliefModel::paper().
  bool is_beta_free = false;
  // The others are used only by the layered style. The height of the relief, as a share of the height that (9)
  // gives for its slopes, (0, 1]; if not set, it is usual_height_share(). A smaller share shows more.
  std::optional<double> height_share = {};
  bool is_corrected = true;  // whether HeightCorrection compresses the heights
  // Least share of the height by which a part stands off what is behind it, and off the base, [0, 0.3].
  double planes = 0;
  // The light for which slopes are chosen, in the layered style of exact models.
  std::optional<ReliefLight> light = {};
  // Local changes of the finished heights, of any method but the paper's. The highest point keeps
  // its height: if strokes raise or sink it, all heights are scaled.
  SharedStrokes strokes = {};
  // The depth, in the surface's units, >= 0, by which lines that are dark in the scan's colours sink.
  double line_depth = 0;

  bool operator==(const Shape&) const = default;
};

// Returns the height share of layered shapes for u in [0, infinity]: 0.4 at u = 0; it goes to 1 as u grows,
// so that high reliefs are compressed less.
double usual_height_share(double u);
// Returns the shape's height share, or the usual one if it sets none.
double height_share(const Shape& shape);

// Returns the default parameters of the layered style: planes of 7 %, beta = 0 and a slight attenuation of coarse layers.
Shape layered_shape();

}  // namespace relievo
