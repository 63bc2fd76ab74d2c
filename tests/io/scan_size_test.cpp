#include "relievo/io/write.h"
#include "support/format_samples.h"
#include "support/read_text.h"
#include "support/shapes.h"

namespace relievo {
namespace {

using namespace test;

std::span<const std::byte> head_of(const std::vector<std::byte>& bytes) {
  return std::span(bytes).first(std::min<std::size_t>(bytes.size(), 1 << 16));
}

TEST(ScanSize, IsThatOfTheHeader) {
  for (const auto& [name, bytes] : {std::pair("a.ply", write_ply(torus(20000, 1, .4))),
                                    {"a.las", bytes_of(las(4))},
                                    {"a.pcd", bytes_of(binary_pcd())}}) {
    const ScanSize size = scan_size(head_of(bytes), name, bytes.size());
    EXPECT_EQ(size.points, value_of(read_cloud(bytes, name)).cloud.size()) << name;
    EXPECT_EQ(size.triangles, 0U) << name;
    EXPECT_TRUE(size.is_stated) << name;
  }
}

TEST(ScanSize, IsThatOfAPicture) {
  const std::vector<std::byte> png = write_png(filled_image<std::uint16_t>(120, 50, 7));
  const ScanSize size = scan_size(head_of(png), "depths.png", png.size());
  EXPECT_EQ(size.pixels, 6000U);
  EXPECT_EQ(size.points, 0U);
}

// For every format, the estimated number of points must be at least a tenth of the number that is read.
// The estimate may be rough, but must not severely underestimate the memory that reading needs.
TEST(ScanSize, IsNotFarBelowThePointsOfAnyFormat) {
  for (const FileSample& sample : format_samples()) {
    const auto bytes = std::as_bytes(std::span(sample.bytes));
    const auto read = read_cloud(bytes, sample.name);
    if (!read) continue;
    const ScanSize size = scan_size(bytes, sample.name, bytes.size());
    EXPECT_GE(10 * std::max(size.points, size.triangles), read->cloud.size()) << sample.name;
  }
}

TEST(ScanSize, IsNoMoreThanTheFileHasRoomFor) {
  const std::string_view header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000000\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_LE(scan_size(std::as_bytes(std::span(header)), "a.ply", 1200).points, 100U);
}

TEST(ScanSize, OfNothingIsZero) {
  const ScanSize size = scan_size({}, "a.xyz", 0);
  EXPECT_EQ(size.points + size.triangles + size.pixels, 0U);
}

}  // namespace
}  // namespace relievo
