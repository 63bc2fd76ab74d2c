// Keeps a scan, or a scene of several scans, in memory.
#pragma once

#include <functional>
#include <memory>

#include "common/project.h"
#include "common/read_inputs.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scene.h"

namespace relievo::app::studio {

// A scan, and how its depth images are read.
struct ScanOrder {
  ScanSource input;
  InputArguments how = {};
};

// A scan or a scene that was read. It is immutable, and copies are cheap, as they share the points.
class LoadedScan {
 public:
  LoadedScan() = default;                    // no scan
  LoadedScan(ScanOrder order, Scene scene);  // at least one model

  const ScanSource& input() const { return order_.input; }

  // Returns whether reading it in that way could make another scan.
  bool depends_on(const InputArguments& how) const;

  // Returns the model if the scan is a single depth image, else null.
  const SceneModel* depth_image() const;

  // Returns the points for ranking views: the points of clouds without outliers and the vertices of meshes,
  // placed as in the front view. Null if no scan was read.
  const std::shared_ptr<const Cloud>& cloud() const { return cloud_; }

  const Scene& scene() const { return scene_; }

  // Returns points of all sides, for turning the model and for choosing a view. On a single mesh they are
  // scattered evenly; otherwise they are those of cloud().
  Result<std::shared_ptr<const Cloud>> all_sides() const;

  // Returns the number of outliers that were left out: points of clouds far from all others.
  std::size_t left_out() const { return left_out_; }

  // Returns the remarks on the scan's files, one line each: on the points that the readers left out, in a
  // scene with the name of the file, and on the sampling of points from meshes.
  std::vector<std::string> remarks() const;

  // Returns the points for the relief in that view; about `points` of them if they are sampled from meshes or
  // scenes. Errors: those of sample_for_view().
  Result<std::shared_ptr<const Cloud>> seen_from(const View& view, std::optional<double> points,
                                                 Progress* progress) const;

 private:
  bool is_one_file() const;
  void add(const CloudFile& file, const PlacedModel& place, double share, Cloud& all);

  ScanOrder order_;
  Scene scene_;
  std::shared_ptr<const Cloud> cloud_;
  std::size_t left_out_ = 0;
};

// Returns how depth images are read for these values. Values that cannot be read count as their defaults.
InputArguments reading_of(const OptionValues& values);

// Reads a scan. Errors: those of load_input(); kind memory, which names the scan; kind cancelled as soon as
// `is_unwanted` returns true.
Result<LoadedScan> read_scan(const ScanOrder& from, const std::function<bool()>& is_unwanted);

}  // namespace relievo::app::studio
