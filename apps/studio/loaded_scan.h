// Keeps a scan, or a scene of several scans, in memory.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "common/project.h"
#include "common/read_inputs.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/view.h"
#include "relievo/scene.h"

namespace relievo::app::studio {

// A scan to read, and the options for reading its depth images.
struct ScanOrder {
  ScanSource input;
  InputArguments how = {};
};

// A scan or a scene that was read. It is immutable. Copies share the points, so copying is cheap.
class LoadedScan {
 public:
  LoadedScan() = default;                    // no scan
  LoadedScan(ScanOrder order, Scene scene);  // at least one model

  const ScanSource& input() const { return order_.input; }

  // Returns whether reading the scan with these options could give another result than the scan that was read.
  bool depends_on(const InputArguments& how) const;

  // Returns the model if the scan is a single depth image, otherwise null.
  const SceneModel* depth_image() const;

  // Returns the points of a cloud without its outliers, the vertices of a mesh or, for a scene, points on all
  // sides of its models, which are placed as in the front view. Returns null if no scan was read.
  const std::shared_ptr<const Cloud>& cloud() const { return cloud_; }

  const Scene& scene() const { return scene_; }

  // Returns points on all sides of the scan, for turning the scan. On meshes the points are scattered evenly.
  // The models of a scene are placed as the view shows them, and keep these places while the scene is turned.
  Result<std::shared_ptr<const Cloud>> all_sides(const View& view) const;

  // Returns the six sides of the scan as views, the best one first; see rank_views().
  Result<std::vector<ViewGuess>> ranked_sides() const;

  // Returns the number of outliers that were left out of clouds.
  std::size_t left_out() const { return left_out_; }

  // Returns the remarks on the files of the scan, one line each: on points that the readers left out, and on points
  // that were sampled from a mesh. In a scene, remarks on left-out points name the file.
  std::vector<std::string> remarks() const;

  // Returns the points for the relief in that view. If they are sampled from meshes or scenes, there are
  // about `points` of them. Errors: those of sample_for_view().
  Result<std::shared_ptr<const Cloud>> seen_from(const View& view, std::optional<double> points,
                                                 Progress* progress) const;

 private:
  bool is_one_file() const;

  ScanOrder order_;
  Scene scene_;
  std::shared_ptr<const Cloud> cloud_;
  std::size_t left_out_ = 0;
};

// Returns what the options say about how depth images are read. An invalid option counts as its default.
InputArguments reading_of(const OptionValues& values);

// Reads a scan. Errors: those of load_input(); kind memory, with the name of the scan; kind cancelled as soon
// as `is_unwanted` returns true.
Result<LoadedScan> read_scan(const ScanOrder& from, const std::function<bool()>& is_unwanted);

// Returns the options with the chosen side `best` in place of the view `auto`; unchanged while no side is chosen.
OptionValues with_side(OptionValues values, const std::optional<ViewGuess>& best);

}  // namespace relievo::app::studio
