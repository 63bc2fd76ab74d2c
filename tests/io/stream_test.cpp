#include "relievo/io/stream.h"
#include "relievo/io/write.h"

#include "relievo/make_relief.h"
#include "support/format_samples.h"
#include "support/read_text.h"
#include "support/same_bits.h"
#include "support/shapes.h"

namespace relievo {
namespace {

class MemorySource : public ByteSource {
 public:
  explicit MemorySource(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
  std::uint64_t size() const override { return bytes_.size(); }
  Result<void> read(std::uint64_t offset, std::span<std::byte> to) override {
    EXPECT_LE(offset + to.size(), bytes_.size());
    largest_ = std::max(largest_, to.size());
    ++reads_;
    if (reads_ == cancel_at_read_) progress_.cancel();
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), to.size(), to.begin());
    return {};
  }
  std::size_t largest_ = 0, cancel_at_read_ = 0, reads_ = 0;
  Progress progress_;

 private:
  std::vector<std::byte> bytes_;
};

const View front = *parse_view("front");

StreamedCloud streamed(std::vector<std::byte> bytes, const View& view = front, double points = 5000) {
  MemorySource source(std::move(bytes));
  return value_of(stream_front(source, "a.ply", view, points));
}

// Returns a noisy sphere around a smaller sphere. The smaller one must never be visible.
Cloud shells(std::size_t n) {
  Cloud cloud = test::sphere(n, 1);
  test::Random random(5);
  for (Vec3& p : cloud.points) p *= 1 + .002 * random.gaussian();
  const Cloud inner = test::sphere(n / 2, .8, 6);
  return test::joined(cloud, inner);
}

TEST(StreamFront, KeepsTheVisibleSideAtTheResolutionAskedFor) {
  const StreamedCloud it = streamed(write_ply(shells(300000)));
  EXPECT_EQ(it.input_points, 450000U);
  EXPECT_EQ(it.format, "PLY binary little endian");
  EXPECT_NEAR(static_cast<double>(it.cloud.size()), 5000, 600);
  double error = 0, sum_sq = 0, n = 0;
  for (std::size_t i = 0; i < it.cloud.size(); ++i) {
    const Vec3& p = it.cloud.points[i];
    EXPECT_GT(p.z(), -.01);
    if (p.z() < .3) continue;
    EXPECT_NEAR(p.norm(), 1, .01);
    error = std::max(error, (it.cloud.normals[i].cast<double>() - p.normalized()).norm());
    if (p.z() > .6) sum_sq += (p.norm() - 1) * (p.norm() - 1), ++n;
  }
  EXPECT_LT(error, .03);
  EXPECT_LT(std::sqrt(sum_sq / n), .001);  // averaging must reduce the scan's noise, which is 0.002
}

TEST(StreamFront, CountsTheFacesThatItLeavesOut) {
  const std::vector<std::byte> points = write_ply(shells(1000));
  EXPECT_EQ(streamed(points).ignored_faces, 0U);
  std::string text(reinterpret_cast<const char*>(points.data()), points.size());
  text = replaced(text, "end_header", "element face 2\nproperty list uchar int vertex_indices\nend_header");
  for (int face = 0; face < 2; ++face)
    text += '\3' + raw(std::int32_t{0}) + raw(std::int32_t{1}) + raw(std::int32_t{2});
  EXPECT_EQ(streamed(bytes_of(text)).ignored_faces, 2U);
}

// If the colours of so many points were added up in single precision, their mean would be 256. As a byte,
// this would be 0.
TEST(StreamFront, KeepsAColourThatManyPointsOfASquareHave) {
  std::vector<Vec3> points = test::sphere(600'000, 1).points;
  points.insert(points.end(), 400'000, Vec3(0, 0, 1));
  std::string ply = cat("ply\nformat binary_little_endian 1.0\nelement vertex ", points.size(),
                        "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                        "property uchar green\nproperty uchar blue\nend_header\n");
  for (const Vec3& p : points) {
    const Vec3f place = p.cast<float>();
    ply.append(reinterpret_cast<const char*>(place.data()), sizeof place).append(3, '\xff');
  }
  const std::vector<Colour> colours = streamed(bytes_of(ply)).cloud.colours;
  ASSERT_FALSE(colours.empty());
  for (const Colour& colour : colours) EXPECT_EQ(colour, (Colour{255, 255, 255}));
}

TEST(StreamFront, ShowsTheSideAskedFor) {
  const View left = *parse_view("left");
  for (const Vec3& p : streamed(write_ply(shells(100000)), left).cloud.points) EXPECT_LT(p.x(), .02);
}

TEST(StreamFront, TurnsNormalsThatPointInwards) {
  Cloud cloud = shells(100000);
  for (Vec3f& n : cloud.normals) n = -n;
  const StreamedCloud it = streamed(write_ply(cloud));
  EXPECT_NEAR(static_cast<double>(it.cloud.size()), 5000, 800);
  for (std::size_t i = 0; i < it.cloud.size(); ++i)
    EXPECT_GT(it.cloud.normals[i].dot(it.cloud.points[i].cast<float>()), 0);
}

TEST(StreamFront, ReadsCloudsWithoutNormals) {
  Cloud cloud = shells(200000);
  cloud.normals.clear();
  const StreamedCloud it = streamed(write_ply(cloud));
  EXPECT_FALSE(it.cloud.has_normals());
  for (const Vec3& p : it.cloud.points)
    if (p.head<2>().norm() < .9) EXPECT_GT(p.norm(), .95);
}

TEST(StreamFront, LeavesOutStraysAndPointsThatAreNotFinite) {
  Cloud cloud = shells(100000);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  test::add(cloud, {1000, 1000, 1000}, {0, 0, 1});
  test::add(cloud, {nan, 0, 0}, {0, 0, 1});
  const StreamedCloud it = streamed(write_ply(cloud));
  EXPECT_NEAR(static_cast<double>(it.cloud.size()), 5000, 800);
  EXPECT_LT(bounds(it.cloud).diagonal(), 4);
}

TEST(StreamFront, IsTheSameForAnyNumberOfThreads) {
  const auto bytes = write_ply(shells(50000));
  test::expect_same_for_any_threads([&] {
    const Cloud cloud = streamed(bytes).cloud;
    return std::pair(cloud.points, cloud.normals);
  });
}

TEST(StreamFront, ReadsInPiecesOfEightMegabytesAndTellsItsProgressWithoutGoingBack) {
  MemorySource source(write_ply(shells(600000)));
  std::vector<double> fractions;
  Progress progress([&](std::string_view, double fraction) { fractions.push_back(fraction); });
  ASSERT_TRUE(stream_front(source, "a.ply", front, 5000, &progress));
  EXPECT_LE(source.largest_, std::size_t{8} << 20);
  EXPECT_GT(source.reads_, 9U);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GT(fractions.size(), 9U);
  EXPECT_LE(fractions.back(), .6);
}

TEST(StreamFront, CanBeCancelledBetweenAnyTwoPieces) {
  const auto bytes = write_ply(shells(600000));
  MemorySource whole(bytes);
  ASSERT_TRUE(stream_front(whole, "a.ply", front, 5000, &whole.progress_));
  for (std::size_t at = whole.reads_ - 4; at < whole.reads_; ++at) {
    MemorySource source(bytes);
    source.cancel_at_read_ = at;
    expect_error(stream_front(source, "a.ply", front, 5000, &source.progress_), ErrorKind::cancelled);
    EXPECT_EQ(source.reads_, at);
  }
}

TEST(StreamFront, ReadsLas) {
  const Cloud sphere = test::sphere(40000, 1000);
  std::string file = patched(las(2).substr(0, 227), 107, static_cast<std::uint32_t>(sphere.size()));
  for (const Vec3& p : sphere.points) {
    std::string row(26, '\0');
    for (std::size_t i = 0; i < 3; ++i)
      row = patched(row, 4 * i, static_cast<std::int32_t>(4 * p[static_cast<int>(i)]));
    file += patched(row, 20, std::uint16_t{65535});
  }
  const StreamedCloud it = streamed(bytes_of(file), front, 2000);
  EXPECT_EQ(it.format, "LAS");
  EXPECT_EQ(it.missing_points + it.ignored_faces, 0U);
  EXPECT_TRUE(it.remarks.empty());
  // Noise far in front of the sphere would hide the sphere.
  std::string noise(26, '\0');
  noise = patched(patched(noise, 8, std::int32_t{8000}), 15, std::uint8_t{7});
  const std::string with_noise = patched(file, 107, static_cast<std::uint32_t>(sphere.size() + 1)) + noise;
  const StreamedCloud clean = streamed(bytes_of(with_noise), front, 2000);
  EXPECT_EQ(clean.cloud.points, it.cloud.points);
  EXPECT_EQ(clean.remarks[0],
            "left out 1 point that the file marks as noise (classes 7 and 18) or withheld; --doubtful keep "
            "keeps them");
  MemorySource with_all(bytes_of(with_noise));
  const StreamedCloud all = value_of(stream_front(with_all, "a.las", front, {2000, true}));
  EXPECT_NE(all.cloud.points, it.cloud.points);
  EXPECT_TRUE(all.remarks.empty());
  const StreamedCloud cut = streamed(bytes_of(file.substr(0, file.size() - 26 * 1000 - 5)), front, 2000);
  EXPECT_EQ(cut.missing_points, 1001U);
  EXPECT_EQ(cut.input_points, sphere.size() - 1001);
  EXPECT_NEAR(static_cast<double>(it.cloud.size()), 2000, 300);
  std::size_t behind = 0;
  for (std::size_t i = 0; i < it.cloud.size(); ++i) {
    const Vec3 p = it.cloud.points[i] - Vec3(1e6, 2e6, 0);  // the points relative to the file's offset
    EXPECT_EQ(it.cloud.colours[i], (Colour{255, 0, 0}));
    if (p.head<2>().norm() > 900) continue;
    EXPECT_NEAR(p.norm(), 1000, 25);
    behind += p.z() < 0;
  }
  // The cloud has no normals. So if no front point of the sphere falls into a cell of the grid, the cell shows points
  // of the back. Near the centre of the sphere a cell has about 5 front points on average, so a share exp(-5) of the
  // cells there has none. The search for visible points in make_relief() removes the points of the back.
  EXPECT_LT(behind, it.cloud.size() / 50);
}

TEST(StreamFront, TellsWhatItCanRead) {
  EXPECT_TRUE(can_stream(bytes_of(las(4)), "a"));
  EXPECT_TRUE(can_stream(bytes_of(binary_pcd()), "a"));
  EXPECT_FALSE(can_stream(bytes_of(ascii_pcd()), "a"));
  EXPECT_FALSE(can_stream(bytes_of("1 2 3\n"), "a.xyz"));
  EXPECT_FALSE(
      can_stream(bytes_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                          "property float z\nend_header\n1 2 3\n"),
                 "a.ply"));
}

TEST(StreamFront, BrokenFilesAreNamed) {
  std::vector<std::byte> bytes = write_ply(shells(1000));
  bytes.pop_back();
  MemorySource cut(bytes);
  const std::string message = message_of(stream_front(cut, "a.ply", front, 5000));
  EXPECT_TRUE(message.starts_with("a.ply, byte ")) << message;
  EXPECT_TRUE(message.contains("expected 1500 points of 24 bytes, found 35999 bytes")) << message;
  MemorySource text(bytes_of("1 2 3\n"));
  EXPECT_EQ(stream_front(text, "a.xyz", front, 5000).error().message(),
            "a.xyz: expected a binary PLY, PCD or LAS file, to be read piece by piece");
  MemorySource empty(bytes_of(""));
  EXPECT_EQ(stream_front(empty, "a.ply", front, 5000).error().kind, ErrorKind::input);
  MemorySource good(write_ply(shells(1000)));
  EXPECT_EQ(stream_front(good, "a.ply", front, 10).error().kind, ErrorKind::option);
}

// Returns a LAS file of 400 points on a slope. The coordinates are multiples of `scale`.
std::string slope_las(double scale) {
  std::string file = patched(las(2).substr(0, 227), 107, std::uint32_t{400});
  for (std::size_t axis = 0; axis < 3; ++axis)
    file = patched(patched(file, 131 + 8 * axis, scale), 155 + 8 * axis, 0.);
  for (std::int32_t i = 0; i < 400; ++i) {
    std::string row(26, '\0');
    file += patched(patched(patched(row, 0, i % 20), 4, i / 20), 8, i % 20 + i / 20);
  }
  return file;
}

TEST(StreamFront, RefusesExtentsThatAreTooSmallOrTooLarge) {
  for (const double scale : {1e306, 1e200, 1e20, 1e-20, 1e-200, 5e-324}) {
    MemorySource source(bytes_of(slope_las(scale)));
    expect_error(stream_front(source, "a.las", front, 1000),
                 "expected points that cover an area in the view, found an extent of ");
  }
  for (const double scale : {1e16, 1e-16})
    EXPECT_EQ(streamed(bytes_of(slope_las(scale)), front, 1000).cloud.size(), 400U) << scale;
}

TEST(StreamFront, ReadsNothingBehindTheEndOfTheFileForNoPoints) {
  const std::string file =
      patched(patched(las(2).substr(0, 227), 107, std::uint32_t{0}), 96, std::uint32_t{5000});
  MemorySource source(bytes_of(file));
  EXPECT_EQ(stream_front(source, "a.las", front, 1000).error().message(),
            "a.las: expected points, found none with finite coordinates");
}

TEST(StreamFront, MakesTheReliefOfTheWholeCloud) {
  const Cloud whole = test::sphere(60000, 1);
  ReliefOptions options{{.height_mm = 5}};
  const auto direct = make_relief(whole, options);
  const auto by_stream = make_relief(streamed(write_ply(whole), front, 30000).cloud, options);
  ASSERT_TRUE(direct && by_stream);
  EXPECT_EQ(check_solid(by_stream->solid), "");
  EXPECT_NEAR(by_stream->report.height_mm, 5, .01);
  // The averaged grid has less of the steep rim than the cloud, so the volumes differ a little.
  EXPECT_NEAR(volume_mm3(by_stream->solid) / volume_mm3(direct->solid), 1, .05);
}

}  // namespace
}  // namespace relievo
