#include "relievo/io/read.h"
#include "relievo/io/write.h"
#include "relievo/picture/height_map.h"

#include <zlib.h>

#include <map>

#include "relievo/scan/depth_image.h"
#include "support/plate_fronts.h"

namespace relievo {
namespace {

// Reads an archive by its central directory, and checks the CRC of each file. Returns the names and the
// inflated contents.
std::map<std::string, std::string> unzip(const std::vector<std::byte>& bytes) {
  const auto number = [&](std::size_t at, std::size_t size) {
    std::size_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | std::to_integer<std::size_t>(bytes.at(at + i));
    return value;
  };
  std::map<std::string, std::string> files;
  const std::size_t end = bytes.size() - 22;
  EXPECT_EQ(number(end, 4), 0x06054B50U);
  std::size_t at = number(end + 16, 4);
  for (std::size_t i = 0; i < number(end + 10, 2); ++i) {
    EXPECT_EQ(number(at, 4), 0x02014B50U);
    const std::size_t packed = number(at + 20, 4), size = number(at + 24, 4), length = number(at + 28, 2),
                      local = number(at + 42, 4);
    const std::string name(reinterpret_cast<const char*>(bytes.data() + at + 46), length);
    EXPECT_EQ(number(local, 4), 0x04034B50U);
    EXPECT_EQ(number(local + 10, 4), 0x210000U) << "midnight of the first day";
    EXPECT_EQ(number(local + 14, 4), number(at + 16, 4));
    std::string content(size, '\0');
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, -15), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data() + local + 30 + length));
    stream.avail_in = static_cast<uInt>(packed);
    stream.next_out = reinterpret_cast<Bytef*>(content.data());
    stream.avail_out = static_cast<uInt>(size);
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END) << name;
    inflateEnd(&stream);
    EXPECT_EQ(crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(size)),
              number(at + 16, 4));
    files[name] = content;
    at += 46 + length;
  }
  return files;
}

Solid pyramid() {
  return *make_plate(test::pyramid_front({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 2.5), {5, 3});
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Write3mf, AndTheOthersTellInches) {
  const Solid solid = in_unit(pyramid(), LengthUnit::inch);
  EXPECT_TRUE(unzip(write_3mf(solid)).at("3D/3dmodel.model").contains("<model unit=\"inch\""));
  for (const auto& file : {write_stl(solid), write_ply(solid), write_obj(solid)}) {
    const std::string head(reinterpret_cast<const char*>(file.data()), 100);
    EXPECT_TRUE(head.contains("unit in")) << head;
  }
}

TEST(Write3mf, HoldsTheSolidInMillimetres) {
  const Solid solid = pyramid();
  const std::pair<std::string, std::string> metadata[] = {{"Title", "A <relief> & \"more\""}};
  const auto files = unzip(write_3mf(solid, metadata));
  ASSERT_EQ(files.size(), 3U);
  ASSERT_TRUE(files.contains("[Content_Types].xml") && files.contains("_rels/.rels"));
  const std::string& model = files.at("3D/3dmodel.model");
  EXPECT_TRUE(model.contains("unit=\"millimeter\""));
  EXPECT_TRUE(model.contains("<metadata name=\"Title\">A &lt;relief&gt; &amp; &quot;more&quot;</metadata>"));
  EXPECT_EQ(count(model, "<vertex "), solid.points.size());
  EXPECT_EQ(count(model, "<triangle "), solid.triangles.size());
  EXPECT_TRUE(model.contains("<vertex x=\"10\" y=\"10\" z=\"5.5\"/>"));  // the apex
  const auto& [a, b, c] = solid.triangles[0];
  EXPECT_NE(model.find("<triangle v1=\"" + std::to_string(a) + "\" v2=\"" + std::to_string(b) + "\" v3=\"" +
                       std::to_string(c) + "\"/>"),
            std::string::npos);
}

TEST(Write3mf, MetadataCannotBreakTheXml) {
  const std::pair<std::string, std::string> metadata[] = {{"Title", std::string("a\0b\x01", 4)}};
  const std::string model = unzip(write_3mf(pyramid(), metadata)).at("3D/3dmodel.model");
  EXPECT_TRUE(model.contains(">a b <"));
}

TEST(WriteTiff, KeepsEveryHeight) {
  const HeightsMm heights = make_heights_mm(pyramid(), {.longer_side_px = 200});
  const auto bytes = write_tiff(heights);
  const auto image = value_of(read_depth_image(bytes, "h.tif"));
  EXPECT_EQ(image.format, "TIFF, 32 bits");
  EXPECT_EQ(image.values.width, 200);
  EXPECT_EQ(image.values.height, 200);
  EXPECT_EQ(image.values.pixels, heights.image.pixels);
  EXPECT_NEAR(std::ranges::max(image.values.pixels), 2.5, .05);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_TRUE(text.contains("heights in mm, mm_per_pixel=0.1,"));
}

TEST(WriteTiff, OfNothingIsEmpty) {
  EXPECT_TRUE(write_tiff({}).empty());
  EXPECT_TRUE(write_tiff({{3, 3, 1, {1, 2}}, .1}).empty());
  EXPECT_TRUE(write_tiff(make_heights_mm({}, {.longer_side_px = 100})).empty());
}

TEST(HeightsMm, AreTheHeightMapInMillimetres) {
  const Solid solid = pyramid();
  const HeightMap map = grey_levels(make_heights_mm(solid, {.longer_side_px = 64}));
  const HeightsMm heights = make_heights_mm(solid, {.longer_side_px = 64});
  ASSERT_EQ(heights.image.pixels.size(), map.image.pixels.size());
  for (std::size_t i = 0; i < map.image.pixels.size(); ++i)
    EXPECT_NEAR(static_cast<double>(heights.image.pixels[i]), map.mm_per_grey * map.image.pixels[i],
                map.mm_per_grey);
}

}  // namespace
}  // namespace relievo
