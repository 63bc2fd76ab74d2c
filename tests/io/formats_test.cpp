// Tests the table of formats and the lists that are made from it. Each row of the table must read the files
// of its format.
#include "io/formats.h"

#include "support/format_samples.h"
#include "support/read_text.h"

namespace relievo {
namespace {

TEST(Formats, AreListedForHelp) {
  const std::string list = readable_formats();
  EXPECT_TRUE(list.starts_with("point cloud (PLY, PCD, ")) << list;
  EXPECT_TRUE(list.contains("XYZ, PTS), mesh (PLY, glTF, ")) << list;
  EXPECT_TRUE(list.ends_with(
      ") or depth image (PNG, TIFF, JPEG, NPY, PFM, PGM, PPM, BMP, Esri grid, table of heights)"))
      << list;
}

TEST(Formats, ListTheEndingsOfAllFiles) {
  const std::vector<std::string> endings = readable_endings();
  for (const std::string_view expected : {".ply", ".gltf", ".csv", ".png", ".tiff"})
    EXPECT_EQ(std::ranges::count(endings, expected), 1) << expected;
  for (const std::string& ending : endings) {
    EXPECT_TRUE(ending.starts_with('.')) << ending;
    EXPECT_EQ(std::ranges::count(endings, ending), 1) << ending;
  }
}

// Returns the name of the table's row that reads the file, or "none".
std::string_view format_of(std::string_view bytes, std::string_view name) {
  for (const io::Format& format : io::formats)
    if (format.is_format({bytes, name})) return format.name;
  return "none";
}

TEST(Formats, AreRecognisedByTheirContentOrElseByTheirName) {
  const std::vector<std::array<std::string, 3>> all = {{"ply\n", "a", "PLY"},
                                                       {"plywood 1 2\n", "a", "XYZ, PTS"},
                                                       {ascii_pcd(), "a", "PCD"},
                                                       {las(2), "a", "LAS"},
                                                       {patched(las(2), 104, std::uint8_t{130}), "a", "LAZ"},
                                                       {"ASTM-E57", "a", "E57"},
                                                       {glb(), "a", "glTF"},
                                                       {"COFF\n", "a", "OFF"},
                                                       {"solid a\n", "a", "STL"},
                                                       {"# made by hand\n\nvn 0 0 1\n", "a", "OBJ"},
                                                       {"1 2 3\n", "a", "XYZ, PTS"},
                                                       {"1 2 3\n", "a.PCD", "PCD"},
                                                       {"{}", "a.gltf", "glTF"},
                                                       {"1 2 3\n", "a.obj", "OBJ"},
                                                       {"1 2 3\n", "a.csv", "XYZ, PTS"},
                                                       {"PK\x03\x04", "a.obj", "none"},
                                                       {"newmtl red\n", "a.mtl", "none"},
                                                       {"1 2 3\n", "a.ply", "none"}};
  for (const auto& [bytes, name, format] : all) EXPECT_EQ(format_of(bytes, name), format) << bytes << name;
}

TEST(Formats, NameForeignFiles) {
  EXPECT_EQ(io::foreign_format({"Kaydara FBX", "a"}), "an FBX file; Blender exports it as glTF or PLY");
  EXPECT_EQ(io::foreign_format({"1 2 3\n", "a.DXF"}), "a DXF file");
  EXPECT_EQ(io::foreign_format({"PK\x03\x04", "a.zip"}), "a ZIP archive");
  EXPECT_EQ(io::foreign_format({"PK\x03\x04", "a.sog"}),
            "packed Gaussian splats (SOG); SuperSplat exports them as PLY");
  EXPECT_EQ(io::foreign_format({"1 2 3\n", "a.xyz"}), "");
}

}  // namespace
}  // namespace relievo
