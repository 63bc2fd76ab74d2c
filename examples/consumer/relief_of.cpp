// From the bytes of a scan to the bytes of an STL file, as README shows it.
#include "relievo/io/read.h"
#include "relievo/io/write.h"
#include "relievo/make_relief.h"

relievo::Result<std::vector<std::byte>> relief_of(std::span<const std::byte> scan) {
  auto file = relievo::read_cloud(scan, "scan.ply");
  if (!file) return std::unexpected(file.error());
  relievo::ReliefOptions options;
  options.height_mm = 4;
  const auto made = relievo::make_relief(*std::move(file), options);
  if (!made) return std::unexpected(made.error());
  return relievo::write_stl(made->solid);
}
