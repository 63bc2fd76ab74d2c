#include "open_scan.h"

namespace relievo::studio {

OpenScan::OpenScan(Input input, CloudFile file)
    : input_(std::move(input)),
      file_(std::make_shared<const CloudFile>(std::move(file))),
      cloud_(file_, &file_->cloud) {
  if (!file_->mesh.empty()) return;
  const SeenPoints seen = *seen_points(*file_, {}, ReliefOptions{}.points);  // a cloud cannot fail
  left_out_ = seen.left_out;
  if (left_out_ > 0) cloud_ = seen.cloud;
}

Result<std::shared_ptr<const Cloud>> OpenScan::seen_from(const View& view) const {
  if (file_->mesh.empty()) return cloud_;
  Result<SeenPoints> seen = seen_points(*file_, view, ReliefOptions{}.points);
  if (!seen) return std::unexpected(seen.error());
  return seen->cloud;
}

}  // namespace relievo::studio
