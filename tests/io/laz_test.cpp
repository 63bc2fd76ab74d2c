// Tests LAZ files that the test program itself writes. corpus_test.cpp reads files of other programs.
#include "io/las/arithmetic_decoder.h"
#include "io/las/point_items.h"
#include "support/laz_encoder.h"
#include "support/read_text.h"

namespace relievo {
namespace {

TEST(Laz, IntegersComeBack) {
  LazTestEncoder encoder;
  LazTestIntegers written(3);
  std::mt19937 random(1);
  std::vector<std::int32_t> values;
  for (int i = 0; i < 3000; ++i) {
    values.push_back(static_cast<std::int32_t>(random()) >> (i % 30));
    written.write(encoder, values.back(), static_cast<std::size_t>(i % 3));
  }
  const std::string bytes = encoder.take();
  io::ArithmeticDecoder decoder(bytes);
  io::IntegerDecoder read(32, 3);
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_EQ(read.next(decoder, 0, static_cast<std::uint32_t>(i % 3)), values[i]) << i;
  EXPECT_FALSE(decoder.is_beyond_end());
}

TEST(Laz, MedianIsBetweenTheLowestAndTheHighestOfFive) {
  io::RunningMedian median;
  EXPECT_EQ(median.get(), 0);
  for (int i = 0; i < 5; ++i) median.add(7);
  EXPECT_EQ(median.get(), 7);
  for (int i = 8; i < 60; ++i) {
    median.add(i);
    EXPECT_LE(median.get(), i);
    EXPECT_GE(median.get(), 7);
  }
}

TEST(Laz, ChunksOfDifferentSizesAreRead) {
  for (const bool is_layered : {false, true}) {
    const std::vector<std::vector<LazTestPoint>> chunks = {any_points(3, 1), any_points(700, 2),
                                                           any_points(40, 3)};
    const auto file = file_of(laz(chunks, is_layered), "a");
    EXPECT_EQ(file.format, "LAZ 1.4");
    ASSERT_EQ(file.cloud.size(), 743U);
    std::size_t at = 0;
    for (const auto& chunk : chunks)
      for (const LazTestPoint& p : chunk) ASSERT_EQ(file.cloud.points[at++], Vec3(p[0], p[1], p[2])) << at;
  }
}

// A chunk size of 0 has the same meaning as 2^32 - 1: chunks have any number of points, and the table
// states each number.
TEST(Laz, ChunksOfSizeZeroAreOfAnySize) {
  const std::string file = laz({any_points(3, 1), any_points(700, 2)}, true);
  EXPECT_EQ(file_of(patched(file, 429 + 12, std::uint32_t{0}), "a").cloud.points,
            file_of(file, "a").cloud.points);
}

TEST(Laz, NoiseAndWithheldPointsAreLeftOut) {
  std::mt19937 random(5);
  std::vector<LazTestClass> classes;
  for (int i = 0; i < 500; ++i)
    classes.push_back({std::array{2U, 6U, 7U, 18U}[random() % 4], random() % 5 == 0});
  const auto points = any_points(500, 4);
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (classes[i].number < 7 && !classes[i].is_withheld)
      kept.emplace_back(points[i][0], points[i][1], points[i][2]);
  for (const bool is_layered : {false, true}) {
    const auto file = file_of(laz({points}, is_layered, classes), "a");
    EXPECT_EQ(file.cloud.points, kept) << is_layered;
    EXPECT_EQ(file.left_out_points, 500 - kept.size());
    EXPECT_EQ(file.dropped_points, 0U);
    EXPECT_EQ(file.remarks,
              (std::vector<std::string>{
                  cat("left out ", 500 - kept.size(),
                      " points that the file "
                      "marks as noise (classes 7 and 18) or withheld; --doubtful keep keeps them")}));
    const auto whole =
        value_of(read_cloud(bytes_of(laz({points}, is_layered, classes)), "a", ReadOptions{{}, true}));
    EXPECT_EQ(whole.cloud.points, file_of(laz({points}, is_layered), "a").cloud.points);
  }
}

// Writes points of several scanners as version 3 or version 4 of LASzip writes them. All points have the
// same coordinates, and their colours are grey.
class ScannerLayers {
 public:
  explicit ScannerLayers(bool is_version_3) : is_version_3_(is_version_3) {}

  // Sets the first point. It is not compressed, but initialises the models of its scanner.
  void start(std::size_t scanner, std::uint16_t grey) {
    scanner_ = context_ = scanner;
    scanners_.emplace(scanner, Scanner{});
    colours_.emplace(scanner, Colours{}).first->second.last = grey;
  }

  void add(std::size_t scanner, std::uint16_t grey) {
    const bool changes = scanner != scanner_;
    Scanner& before = scanners_.at(scanner_);
    xy_.symbol(before.changes, changes ? 64 : 0);
    if (changes) xy_.symbol(before.step, static_cast<std::uint32_t>((scanner + 3 - scanner_) % 4));
    scanner_ = scanner;
    Scanner& now = scanners_.try_emplace(scanner).first->second;
    now.x.write(xy_, 0, 1);
    now.y.write(xy_, 0, 1);
    add_colour(is_version_3_ && !changes ? 0 : scanner, grey);
  }

  std::pair<std::string, std::string> take() { return {xy_.take(), colour_.take()}; }

 private:
  struct Scanner {
    LazTestModel changes{128}, step{3};
    LazTestIntegers x{2}, y{22};
  };
  struct Colours {
    std::uint16_t last = 0;
    LazTestModel changes{128}, low{256}, high{256};
  };

  void add_colour(std::size_t context, std::uint16_t grey) {
    std::uint16_t* last = &colours_.at(context_).last;
    const auto [at, is_new] = colours_.try_emplace(context);
    if (is_new) at->second.last = *last;
    if (is_new || !is_version_3_) last = &at->second.last;
    context_ = context;
    const auto low = static_cast<std::uint8_t>(grey - *last);
    const auto high = static_cast<std::uint8_t>((grey >> 8) - (*last >> 8));
    colour_.symbol(at->second.changes, (low != 0 ? 1U : 0U) + (high != 0 ? 2U : 0U));
    if (low != 0) colour_.symbol(at->second.low, low);
    if (high != 0) colour_.symbol(at->second.high, high);
    *last = grey;
  }

  bool is_version_3_;
  std::size_t scanner_ = 0, context_ = 0;
  LazTestEncoder xy_, colour_;
  std::map<std::size_t, Scanner> scanners_;
  std::map<std::size_t, Colours> colours_;
};

TEST(Laz, ColoursOfSeveralScannersComeBack) {
  for (const bool is_version_3 : {true, false}) {
    std::mt19937 random(3);
    std::vector<std::pair<std::size_t, std::uint16_t>> points = {{3, std::uint16_t{1000}}};
    ScannerLayers layers(is_version_3);
    layers.start(points[0].first, points[0].second);
    while (points.size() < 2000) {
      const std::size_t scanner = random() % 3 == 0 ? random() % 4 : points.back().first;
      points.emplace_back(scanner, static_cast<std::uint16_t>(random() >> random() % 16));
      layers.add(points.back().first, points.back().second);
    }
    const auto [xy, colours] = layers.take();
    std::string first(30, '\0');
    first[14] = '\x11';
    first[15] = '\x30';
    const std::string grey = raw(points[0].second) + raw(points[0].second) + raw(points[0].second);
    io::LayeredPoint point({xy, {}, {}, {}, colours, is_version_3}, first.data(), grey.data());
    for (std::size_t i = 1; i < points.size(); ++i) {
      point.next();
      const std::uint16_t expected = points[i].second;
      ASSERT_EQ(point.colour(), (io::LazColour{expected, expected, expected})) << i << " " << is_version_3;
    }
    EXPECT_FALSE(point.is_beyond_end());
  }
}

TEST(Laz, BrokenFilesAreNamed) {
  const std::string good = laz({any_points(50, 1)}, false);
  expect_messages(
      "a.laz",
      {{patched(good, 377, 'L'),
        ", byte 469: expected a record of LASzip, as the points are compressed, found none"},
       {patched(good, 429, std::uint16_t{4}), ", byte 429: expected a compressor from 1 to 3, found 4"},
       {patched(good, 395, std::uint16_t{33}), ", byte 429: expected a record of 34 bytes or more, found 33"},
       {patched(good, 461, std::uint16_t{99}), ", byte 461: expected items within the record, found 99"},
       {patched(good, 467, std::uint16_t{1}),
        ", byte 467: expected items of version 2 to 2, found 1; newer LASzip can convert the file"},
       {patched(good, 469, std::uint64_t{1} << 40),
        ", byte 469: expected the table of chunks within the file, found it elsewhere; the file was not "
        "written to its end"}});
  const auto message = [](const std::string& file) { return message_of(file, "a.laz"); };
  EXPECT_EQ(message(patched(good, 463, std::uint16_t{99})).substr(17),
            "expected items of point formats 0 to 10, found type 99 of 20 bytes");
  EXPECT_TRUE(
      message(patched(good, 247, std::uint64_t{51})).ends_with(": expected chunks with 51 points, found 50"));
  EXPECT_TRUE(message(patched(good, 247, std::uint64_t{1} << 30)).contains(": expected "));
}

// The file has no table of chunks, and it ends before the last point that its header announces.
TEST(Laz, PointsBeyondTheEndAreRefused) {
  std::string file = laz({any_points(50, 1)}, false);
  file = patched(patched(file, 429, std::uint16_t{1}), 247, std::uint64_t{100000});
  EXPECT_EQ(message_of(file, "a.laz"),
            "a.laz, byte 469: expected 100000 points in chunk 1 of 1, found the end of the chunk");
}

TEST(Laz, UnknownItemsOfLayersAreNamed) {
  const std::string good = laz({any_points(50, 1)}, true);
  EXPECT_TRUE(message_of(patched(good, 463, std::uint16_t{15}), "a.laz")
                  .contains("expected items of point formats 0 to 10, found type 15 of 30 bytes"));
}

}  // namespace
}  // namespace relievo
