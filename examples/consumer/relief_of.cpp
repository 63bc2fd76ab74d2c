// The example of docs/library.md: makes the bytes of an STL file from the bytes of a scan.
#include "relievo/io/write.h"
#include "relievo/job.h"

relievo::Result<std::vector<std::byte>> relief_of(std::span<const std::byte> scan) {
  auto job = relievo::load(scan, "scan.ply");
  if (!job) return std::unexpected(job.error());
  job->options.height_mm = 4;
  const auto model = relievo::prepare(*job);
  if (!model) return std::unexpected(model.error());
  const auto made = model->relief(job->options);
  if (!made) return std::unexpected(made.error());
  return relievo::write_stl(made->solid);
}
