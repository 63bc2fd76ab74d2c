// Tests ZIP archives of the kinds that web sites with models offer for download.
#include "common/archive.h"

#include "common/read_inputs.h"
#include "support/read_text.h"
#include "support/zip_encoder.h"

namespace relievo::app {
namespace {

Result<CloudFile> read(const std::string& archive) {
  return read_cloud_at(std::as_bytes(std::span(archive)), "a.zip");
}

// A glTF file with one triangle. Its coordinates are in another file.
const std::string gltf =
    R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"scene.bin"}]})";

std::string triangle() {
  std::string bytes;
  for (const float number : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 2.F, 0.F}) bytes += raw(number);
  return bytes;
}

TEST(Archive, AGltfAndItsBufferAreRead) {
  const auto file = value_of(read(archive_of({{"license.txt", "1 2 3"},
                                              {"model/scene.bin", triangle()},
                                              {"model/scene.gltf", gltf},
                                              {"__MACOSX/model/scene.gltf", "x"},
                                              {"model/textures/a.png", "x"}})));
  EXPECT_EQ(file.mesh.triangles.size(), 1U);
  EXPECT_EQ(file.mesh.points[2], Vec3(0, 2, 0));
}

TEST(Archive, ErrorsNameTheArchiveAndTheFile) {
  EXPECT_EQ(
      read(archive_of({{"license.txt", "1 2 3"}, {"a.png", "x"}})).error().message(),
      "a.zip: expected an archive with a cloud or a mesh, found none in it, but a.png; unpack it first");
  EXPECT_EQ(
      read(archive_of({{"license.txt", "1 2 3"}, {"depth.npy", "x"}})).error().message(),
      "a.zip: expected an archive with a cloud or a mesh, found none in it, but depth.npy; unpack it first");
  EXPECT_EQ(read(archive_of({{"a.txt", "1 2 3"}, {"b.txt", "x"}})).error().message(),
            "a.zip: expected an archive with a cloud or a mesh, found none in it");
  EXPECT_EQ(read(archive_of({{"a.stl", "x"}, {"b.ply", "x"}})).error().message(),
            "a.zip: expected an archive with one cloud or mesh, found 2: a.stl and others; unpack it first");
  EXPECT_EQ(read(archive_of({{"scene.gltf", gltf}})).error().message(),
            "a.zip/scene.gltf, buffer 0: expected the file 'scene.bin' beside it, found none that can be "
            "read; a .glb "
            "needs no other file");
}

TEST(Archive, ATextAloneIsACloud) {
  for (const char* const name : {"scan.txt", "scan.csv", "folder/scan.txt"}) {
    const auto file =
        value_of(read(archive_of({{name, "0 0 1\n1 0 2\n0 1 3\n"}, {"__MACOSX/scan.txt", "x"}})));
    EXPECT_EQ(file.cloud.size(), 3U);
  }
}

// Returns the model in a NumPy archive. `arrays` has the name and the bytes of each array.
Result<SceneModel> read_npz(const std::vector<std::pair<std::string, std::string>>& arrays) {
  const std::string archive = archive_of(arrays);
  return parse_input(std::as_bytes(std::span(archive)), "a.npz", {}, 1e5, nullptr);
}

TEST(Archive, AnNpzGivesItsPointsOrElseItsDepths) {
  const std::string points = npy("<f4", gltf_buffer().substr(0, 48), "4, 3");
  std::string pixels;
  for (int i = 0; i < 36; ++i) pixels += raw(static_cast<float>(1 + i % 6 + i / 6));
  const std::string depths = npy("<f4", pixels, "6, 6"), mask = npy("|b1", std::string(36, '\1'), "6, 6");
  const auto both = value_of(read_npz({{"mask.npy", mask}, {"depth.npy", depths}, {"points.npy", points}}));
  EXPECT_EQ(both.file->cloud.points, tetrahedron_points);
  const auto depth = read_npz({{"mask.npy", mask}, {"depth.npy", depths}});
  ASSERT_TRUE(depth) << depth.error().message();
  EXPECT_EQ(depth->file->cloud.size(), 36U);
  const auto only = value_of(read_npz({{"arr_0.npy", points}}));
  EXPECT_EQ(only.file->cloud.points, tetrahedron_points);
  const std::string zip = archive_of({{"points.npy", points}});
  const auto unnamed = value_of(parse_input(std::as_bytes(std::span(zip)), "scan.zip", {}, 1e5, nullptr));
  EXPECT_EQ(unnamed.file->cloud.points, tetrahedron_points);
  expect_error(
      read_npz({{"a.npy", points}, {"b.npy", points}}),
      "a.npz: expected an array named points, pts3d, depth or alike, found 2 others, such as a.npy; np.save "
      "writes one of them as NPY");
  expect_error(read_npz({{"a.txt", "1"}}), "a.npz: expected an archive with an array, found none in it");
  expect_error(read_npz({{"points.npy", "x"}}), "a.npz/points.npy, line 1: ");
}

TEST(Archive, BackslashesSeparateFoldersToo) {
  const auto file = value_of(read(archive_of({{"m\\scene.bin", triangle()}, {"m\\scene.gltf", gltf}})));
  EXPECT_EQ(file.mesh.triangles.size(), 1U);
}

// Slicers write 3MF files whose main model has a component in another file of the archive.
TEST(Archive, AThreeMfIsReadWithItsParts) {
  const auto model = [](const std::string& objects, const std::string& items) {
    return "<model><resources>" + objects + "</resources><build>" + items + "</build></model>";
  };
  const std::string mesh =
      R"(<object id="1"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>)"
      R"(<vertex x="0" y="2" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object>)";
  const std::string group =
      R"(<object id="2"><components><component p:path="/3D/Objects/a.model" objectid="1"/></components></object>)";
  const auto file = value_of(read(archive_of({{"3D/Objects/a.model", model(mesh, "")},
                                              {"3D/3dmodel.model", model(group, R"(<item objectid="2"/>)")},
                                              {"Metadata/plate_1.png", "x"}})));
  EXPECT_EQ(file.format, "3MF");
  EXPECT_EQ(file.mesh.points[2], Vec3(0, 2, 0));
}

TEST(Archive, FormatsThatAreArchivesAreNamed) {
  const std::string archive = archive_of({{"scene.usdc", "x"}, {"a.png", "x"}});
  const auto answer = read_cloud_at(std::as_bytes(std::span(archive)), "a.usdz");
  ASSERT_FALSE(answer);
  EXPECT_TRUE(answer.error().message().ends_with("found a USD file; Blender exports it as glTF or PLY"));
}

// Changes a field in both headers of the archive's only file. The field begins `at` bytes after the
// field "version needed".
std::string changed_headers(std::string archive, std::size_t at, std::uint16_t to) {
  archive = patched(archive, archive.find("PK\x03\x04") + 4 + at, to);
  return patched(archive, archive.find("PK\x01\x02") + 6 + at, to);
}

TEST(Archive, WhatCannotBeUnpackedIsRefusedWithItsReason) {
  const std::string good = archive_of({{"a.xyz", "0 0 0\n1 0 0\n0 1 0\n"}});
  const auto expect = [](const std::string& archive, const std::string& expected) {
    EXPECT_EQ(read(archive).error().message(), "a.zip/a.xyz: " + expected);
  };
  ASSERT_TRUE(read(good));
  expect(changed_headers(good, 2, 1),
         "expected a file without a password, found an encrypted one; unpack the archive first");
  expect(changed_headers(good, 4, 98),
         "expected a file that is stored or packed by deflate, found method 98; unpack the archive first");
  expect(replaced(good, "1 0 0", "1 0 5"),
         "expected a whole file, found content that its checksum does not fit; get the archive anew");
  expect(changed_headers(good, 4, 8), "expected a whole file, found damaged content; get the archive anew");
}

TEST(Archive, AnyByteChangedOrMissingGetsAnAnswer) {
  const std::string good = archive_of({{"scene.bin", triangle()}, {"scene.gltf", gltf}});
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const std::string& file : {good.substr(0, at), patched(good, at, '\xFF')}) {
      const auto answer = read(file);
      EXPECT_TRUE(answer || answer.error().kind == ErrorKind::input) << at;
    }
}

}  // namespace
}  // namespace relievo::app
