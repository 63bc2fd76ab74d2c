// Tests the contact sheet, and the parts of the index page.
#include "batch/contact_sheet.h"
#include "batch/finish.h"
#include "relievo/core/text.h"
#include "support/cli_folder.h"

namespace relievo {
namespace {

using namespace app;
using namespace app::batch;

Image8 two_halves(int width, int height, std::uint8_t left, std::uint8_t right) {
  Image8 image = filled_image<std::uint8_t>(width, height, left, 3);
  for (int y = 0; y < height; ++y)
    for (int x = width / 2; x < width; ++x)
      for (std::size_t k = 0; k < 3; ++k) image[image.index(x, y) + k] = right;
  return image;
}

TEST(ContactSheet, ShowsTheLeftHalfOfAPreviewReduced) {
  const Image8 tile = tile_of_preview(two_halves(400, 100, 40, 200), 50);
  ASSERT_EQ(tile.width, 50);
  ASSERT_EQ(tile.height, 50);
  EXPECT_EQ(tile.at(25, 25), 40);  // 200 x 100 pixels become 50 x 25, centred
  EXPECT_EQ(tile.at(49, 13), 40);
  EXPECT_NE(tile.at(25, 10), 40);
  EXPECT_NE(tile.at(25, 38), 40);
}

TEST(ContactSheet, AveragesPixels) {
  Image8 preview = filled_image<std::uint8_t>(8, 4, std::uint8_t{0}, 3);
  for (std::size_t i = 0; i < preview.size(); i += 6) preview[i] = preview[i + 1] = preview[i + 2] = 100;
  EXPECT_EQ(tile_of_preview(preview, 2).at(0, 0), 50);
}

TEST(ContactSheet, ReadsThePngThatWeWrite) {
  const Image8 image = two_halves(31, 17, 3, 250);
  EXPECT_EQ(read_png(write_png(image)).pixels, image.pixels);
  EXPECT_TRUE(read_png({}).empty());
}

TEST(ContactSheet, HasAPlaceForEachTile) {
  const std::vector<Tile> tiles(7, {filled_image<std::uint8_t>(20, 20, std::uint8_t{77}, 3), ""});
  const Image8 sheet = contact_sheet(tiles, 20);  // 3 x 3 tiles
  EXPECT_EQ(sheet.width, 3 * 30 + 10);
  EXPECT_EQ(sheet.height, sheet.width + 3 * caption_height_px);
  std::size_t dark = 0;
  for (const std::uint8_t value : sheet.pixels) dark += value == 77;
  EXPECT_EQ(dark, 7U * 20 * 20 * 3);
}

// Returns the number of pixels that have the given colour. Fails if one of them is outside the given columns and rows.
int count_within(const Image8& image, int left, int right, int top, int bottom) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, y) == 9) {
        ++count;
        EXPECT_TRUE(x >= left && x < right && y >= top && y < bottom) << x << ' ' << y;
      }
  return count;
}

TEST(Caption, StaysWithinItsPlace) {
  const auto written = [](std::string_view text) {
    Image8 image = filled_image<std::uint8_t>(100, 30, std::uint8_t{200}, 3);
    write_caption(image, {10, 8, 80}, text, {9, 9, 9});
    return image;
  };
  EXPECT_EQ(count_within(written(""), 0, 0, 0, 0), 0);
  // The letter l of the page's font is a stem of seven pixels, a foot of two pixels and a serif of one pixel.
  EXPECT_EQ(count_within(written("l"), 47, 53, 8, 15), 7 + 3);
  const int three = count_within(written("lll"), 41, 59, 8, 15);
  EXPECT_EQ(three, 3 * 10);
  EXPECT_GT(count_within(written(std::string(500, 'W')), 10, 90, 8, 16), 100);
  EXPECT_EQ(written("\xC3").pixels, written("?").pixels);
  EXPECT_NE(written("scan-1").pixels, written("scan-2").pixels);
}

TEST(Html, EscapesWhatIsNoText) {
  EXPECT_EQ(escaped_markup("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
  EXPECT_EQ(url_of_path("a b/c#1%.stl"), "a%20b/c%231%25.stl");
  EXPECT_EQ(url_of_path("\xC3\xA4.stl"), "%C3%A4.stl");
}

TEST(IndexPage, NamesWhatFailedAndLinksWhatIsMade) {
  const std::vector<Job> jobs{
      {"a & b", "/s/a.ply", {{"height", "4"}}}, {"bad", "/s/bad.ply", {}}, {"late", "", {}}};
  Records records;
  records["a & b"] = {"a & b", "/s/a.ply", true};
  records["a & b"].outputs["a & b.stl"] = 2500000;
  records["bad"] = {"bad", "/s/bad.ply", false, "/s/bad.ply, line 3: expected 3 numbers, found '<x>'"};
  const RunSettings settings{"/out", *parse_output_kinds("stl"), {}};
  const std::string page = index_page(jobs, records, settings, {"contact-sheet.png"});
  for (const char* part :
       {"1 relief is made, 1 failed, 1 is not done yet", "<b>a &amp; b</b>", "href=\"a%20%26%20b.stl\"",
        "2.5 MB", "height 4", "<td>bad.ply, line 3: expected", "found '&lt;x&gt;'", "contact-sheet.png"})
    EXPECT_TRUE(page.contains(part)) << part;
}

TEST(OutputKinds, HaveOneSolidAndThePreview) {
  const auto kinds = parse_output_kinds("3mf,tiff,report");
  ASSERT_TRUE(kinds);
  ASSERT_EQ(kinds->size(), 4U);
  EXPECT_EQ(kinds->back().name, "preview");
  for (const char* list : {"", "stl,obj", "stl,tiff,heightmap", "stl,jpg"})
    EXPECT_FALSE(parse_output_kinds(list)) << list;
}

}  // namespace
}  // namespace relievo
