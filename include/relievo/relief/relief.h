// Makes reliefs of a surface (stages 7 to 12 and 14). A ReliefModel is prepared once and makes reliefs with
// many shapes.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "relievo/core/progress.h"
#include "relievo/relief/method.h"
#include "relievo/relief/shape.h"

namespace relievo {

class HeightCorrection;
class HeightSystem;
class MeasuredCloud;
class OwnHeights;
class PaperModel;
class SubspaceModel;
struct PointLayers;
struct StepHeights;
struct Surface;
struct View;

struct Relief {
  std::vector<double> heights;  // heights of the surface's points above the base, in the surface's units
  double height = 0;            // h: highest minus lowest height, including detail and the base's height 0
  Shape shape;                  // the shape of the relief
};

// If a surface has more visible points than this, Mode::automatic means subspace, because exact frames would
// take more than 40 ms on two cores.
inline constexpr std::size_t most_exact_points = 1'500'000;

// Returns exact or subspace for `automatic`, depending on the number of points; returns any other mode
// unchanged.
Mode resolve_mode(Mode mode, const Surface& surface);

// A surface with its factored system, and with the height correction for layered reliefs. Movable. Const
// calls may run concurrently.
class ReliefModel {
 public:
  // Splits the surface's normals into layers, factors its system, and prepares the height correction; in
  // subspace mode also builds the system of the control points. Errors: those of HeightSystem::build(); kind
  // cancelled.
  static Result<ReliefModel> prepare(Surface surface, Progress* progress = nullptr,
                                     const ModelOptions& options = {});

  // Returns the model of the surface that the view shows. For a view of Method::paper, the model has only the
  // system of paper(). Errors: those of find_surface() and prepare().
  static Result<ReliefModel> of_view(const MeasuredCloud& measured, const View& view,
                                     const ModelOptions& options, Progress* progress = nullptr);

  ReliefModel(ReliefModel&&) noexcept;
  ReliefModel& operator=(ReliefModel&&) noexcept;
  ~ReliefModel();

  const Surface& surface() const;

  // Returns the surface and frees the memory of everything else. The model must not be used any more.
  Surface take_surface() &&;

  // Returns the paper's own system; null for all other methods. If the model has the paper's system, system()
  // and subspace() are null, layers() is empty, and steps(), planes() and correction() must not be called.
  const PaperModel* paper() const;

  // Returns whether the model was prepared for the method. Method::paper needs its own models; all other
  // methods share models.
  bool serves(Method method) const;

  // Returns the number of control points in subspace mode; 0 in exact mode.
  std::size_t control_points() const;

  // Returns the layers of the surface's normals. The list is empty in subspace mode, because control points
  // have their own layers.
  std::span<const PointLayers> layers() const;

  // Return the system of all points (exact mode) or the model of the control points (subspace mode). The
  // other pointer is null.
  const HeightSystem* system() const;
  const SubspaceModel* subspace() const;

  // Returns the step heights that Shape::steps adds at depth jumps.
  const StepHeights& steps() const;

  // Returns the step heights that Shape::planes adds in layered reliefs.
  const StepHeights& planes() const;

  // Returns the models of a scene that have a Pose::height.
  const OwnHeights& own_heights() const;

  // Returns the correction that compresses the heights of layered reliefs.
  const HeightCorrection& correction() const;

  // Returns the number of bytes of memory in use.
  std::size_t memory() const;

  // Returns the relief of that shape.
  Relief make(const Shape& shape) const;

  // Returns the relief whose height, including detail, is `height`. Searches for the u of the compression
  // that gives this height. beta, gamma and the slope limit stay as requested, which is the intent of
  // Algorithm 1 (section 3.6). If no u gives that height, u is infinite, and steps at depth jumps add the
  // missing height. Each of these steps is at most as deep as the jump in the model. Shape::steps of the
  // result is the share of these steps. Models of Method::paper have no such steps, and the search changes
  // beta, too, if Shape::is_beta_free is set; see search_paper_height() in the source file
  // src/relief/paper_relief.h. Errors: kind geometry if no relief has that height; the message states the
  // largest possible height in millimetres, for `unit_mm` millimetres per unit. Kind cancelled.
  Result<Relief> make_at_height(double height, Shape shape, double unit_mm,
                                Progress* progress = nullptr) const;

 private:
  struct State;
  class Maker;
  explicit ReliefModel(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

// Changes the heights of those models of a scene for which Pose::height requests a height. This is the last
// step of a relief. ReliefModel includes this step; baselines need this call.
void give_own_heights(const ReliefModel& model, Relief& relief);

}  // namespace relievo
