// ZIP archives as sites for models hand them out.
#include "common/archive.h"

#include <gtest/gtest.h>

#include "common/read_inputs.h"
#include "support/format_samples.h"
#include "support/zip_encoder.h"

namespace relievo::app {
namespace {

Result<CloudFile> read(const std::string& archive) {
  return read_cloud_at(std::as_bytes(std::span(archive)), "a.zip");
}

// A triangle, of which the coordinates are in another file.
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
  const auto file = read(archive_of({{"license.txt", "1 2 3"},
                                     {"model/scene.bin", triangle()},
                                     {"model/scene.gltf", gltf},
                                     {"__MACOSX/model/scene.gltf", "x"},
                                     {"model/textures/a.png", "x"}}));
  ASSERT_TRUE(file) << file.error().message();
  EXPECT_EQ(file->mesh.triangles.size(), 1U);
  EXPECT_EQ(file->mesh.points[2], Vec3(0, 2, 0));
}

TEST(Archive, ErrorsNameTheArchiveAndTheFile) {
  EXPECT_EQ(read(archive_of({{"license.txt", "1 2 3"}})).error().message(),
            "a.zip: expected an archive with a cloud or a mesh, found none in it");
  EXPECT_EQ(read(archive_of({{"a.stl", "x"}, {"b.ply", "x"}})).error().message(),
            "a.zip: expected an archive with one cloud or mesh, found 2: a.stl and others; unpack it first");
  EXPECT_EQ(read(archive_of({{"scene.gltf", gltf}})).error().message(),
            "a.zip/scene.gltf, buffer 0: expected the file 'scene.bin' beside it, found none that can be "
            "read; a .glb "
            "needs no other file");
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
