// Makes surfaces of about 18,000 points, from which reliefs are made while the user turns the model. Tested by
// tests/scan/turning_test.cpp.
#pragma once

#include <limits>
#include <span>

#include "relievo/core/image.h"
#include "relievo/core/progress.h"
#include "relievo/core/types.h"
#include "relievo/scan/surface.h"
#include "relievo/scan/view.h"
#include "scan/coarse_visibility.h"

namespace relievo {

// A point to draw, in the axes of the scan.
struct FrontPoint {
  Vec3f place, normal;
  float spacing;  // spacing of the surrounding points
};

// Images of the visible side, one pixel per cell. The lowest row is the first.
struct FrontCells {
  static constexpr float no_depth = -std::numeric_limits<float>::infinity();

  Vec2f corner = Vec2f::Zero();  // lower left corner of the first cell
  float cell = 1;                // side of a cell
  Image<float> depth;            // depth at the centre of the cell; no_depth if no point covers it
  Image<Vec3f> normal;           // unit mean normal of the visible points nearby; zero if there are none
  Image8 is_behind;              // whether the cell contains a point that faces away
  Image8 is_edge;                // whether the surface ends or jumps at a covered cell; set by mark_edges()
  std::size_t covered = 0;       // number of cells with a normal
  // Diagonal of the box, in the axes of the scan, of the points inside the crop; 0 without a crop.
  float diagonal = 0;

  Vec2f centre(int x, int y) const {
    return corner + cell * Vec2f(static_cast<float>(x) + .5F, static_cast<float>(y) + .5F);
  }
  bool is_covered(int x, int y) const { return normal.contains(x, y) && normal.at(x, y).z() > 0; }
};

// Draws the points as a view shows them. About `wanted` cells are covered, or fewer if smaller cells would
// show no more detail. Normals of unknown sign are turned to the viewer. The result has the same bits for any
// number of threads.
FrontCells draw_front(std::span<const FrontPoint> points, const View& view, std::size_t wanted,
                      NormalSigns signs = NormalSigns::outward);

// Clears connected components of fewer than `least` covered cells, and all but the `most_pieces` largest ones if that
// number is not 0.
void clear_small_pieces(FrontCells& front, std::size_t least, std::size_t most_pieces);

// Fills holes of at most `most` cells from the surrounding cells.
void fill_small_holes(FrontCells& front, std::size_t most);

void mark_edges(FrontCells& front);

class MeasuredCloud;

// The points of a scan that are drawn: at most 600,000, selected evenly from larger scans.
struct TurningScan {
  explicit TurningScan(const MeasuredCloud& measured);

  std::vector<FrontPoint> points;
  // Per point, or empty; see Cloud.
  std::vector<Colour> colours;
  std::vector<float> own_heights;
  bool do_normals_face_viewer = false;  // true if signs are unknown; each normal is then turned to the viewer
  Vec3 centre = Vec3::Zero();           // see Surface::centre
  double rho = 0, diagonal = 0;

  // `surface` is a surface of this scan that has a support plane. Returns the scan without the points on this
  // plane and the points behind it.
  TurningScan without_plane(const Surface& surface) const;
};

struct TurnedSurface {
  Surface surface;   // its points are the centres of cells
  FrontCells front;  // drawn from all points of the scan
};

// Returns a surface of about `points` points in the view: one point for every few cells, more along
// silhouettes and depth jumps. Errors: kind geometry if the view shows no area; kind cancelled.
Result<TurnedSurface> turned_surface(const TurningScan& scan, const View& view, std::size_t points,
                                     Progress* progress = nullptr);

}  // namespace relievo
