// A scan, or a scene of several, that was read.
#pragma once

#include <functional>
#include <memory>

#include "common/project.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scene.h"

namespace relievo::app::studio {

// Immutable; copies are cheap, for they share the points.
class LoadedScan {
 public:
  LoadedScan() = default;                     // no scan
  LoadedScan(ScanSource input, Scene scene);  // at least one model

  const ScanSource& input() const { return input_; }

  // Returns the points for ranking views: those of all models, placed in the front view, without outliers; of
  // meshes the vertices. Null if no scan was read.
  const std::shared_ptr<const Cloud>& cloud() const { return cloud_; }

  const Scene& scene() const { return scene_; }

  // Returns points of all sides, for turning and for the choice of a view: for a single mesh they are
  // scattered evenly over it, otherwise they are those of cloud().
  Result<std::shared_ptr<const Cloud>> all_sides() const;

  // Returns the number of outliers that were left out: points of clouds far from all others.
  std::size_t left_out() const { return left_out_; }

  // Returns the remarks on the scan's files, one line each: points that the readers left out, with the file's
  // name in a scene, and that points are sampled from meshes.
  std::vector<std::string> remarks() const;

  // Returns the points for the relief in that view; about `points` of them if they are sampled from meshes or
  // scenes. Errors: those of sample_for_view().
  Result<std::shared_ptr<const Cloud>> seen_from(const View& view, std::optional<double> points,
                                                 Progress* progress) const;

 private:
  bool is_one_file() const;
  void add(const CloudFile& file, const PlacedModel& place, double share, Cloud& all);

  ScanSource input_;
  Scene scene_;
  std::shared_ptr<const Cloud> cloud_;
  std::size_t left_out_ = 0;
};

// Reads a scan. Errors: those of load_input(); kind memory, which names the scan; kind cancelled as soon as `is_unwanted`
// returns true.
Result<LoadedScan> read_scan(const ScanSource& from, const std::function<bool()>& is_unwanted);

}  // namespace relievo::app::studio
