#include <gtest/gtest.h>

#include "io/gltf/gltf.h"
#include "relievo/core/text.h"
#include "support/format_samples.h"
#include "support/read_text.h"

namespace relievo {
namespace {

// The sample has joints and weights for each vertex, and a skin of two joints. The first joint moves by (0, 0, 5), the
// second doubles sizes. The inverse bind matrices move back by (0, 0, 1). All weight is on the second joint.
TEST(Gltf, SkinsPoseTheirMeshes) {
  std::string buffer = gltf_buffer();
  const std::size_t joints_at = buffer.size();
  for (int i = 0; i < 4; ++i) buffer += std::string("\1\0\0\0", 4);
  const std::size_t weights_at = buffer.size();
  for (int i = 0; i < 4; ++i) buffer += raw(1.F) + raw(0.F) + raw(0.F) + raw(0.F);
  const std::size_t matrices_at = buffer.size();
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 16; ++k) buffer += raw(k == 14 ? -1.F : k % 5 == 0 ? 1.F : 0.F);
  const auto view = [](std::size_t at, std::size_t size) {
    return cat(R"(,{"buffer":0,"byteOffset":)", at, R"(,"byteLength":)", size, "}");
  };
  std::string json = gltf_with_nodes(
      R"("nodes":[{"mesh":0,"skin":0,"translation":[100,0,0]},{"children":[2],"translation":[0,0,5]},)"
      R"({"scale":[2,2,2]}],"skins":[{"joints":[1,2],"inverseBindMatrices":4}],)");
  json = replaced(json, R"("POSITION":0)", R"("POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3)");
  json =
      replaced(json, R"("count":12,"type":"SCALAR"})",
               R"("count":12,"type":"SCALAR"},{"bufferView":2,"componentType":5121,"count":4,"type":"VEC4"},)"
               R"({"bufferView":3,"componentType":5126,"count":4,"type":"VEC4"},)"
               R"({"bufferView":4,"componentType":5126,"count":2,"type":"MAT4"})");
  json = replaced(json, R"("byteOffset":48,"byteLength":24})",
                  cat(R"("byteOffset":48,"byteLength":24})", view(joints_at, 16), view(weights_at, 64),
                      view(matrices_at, 128)));
  json = replaced(json, R"("byteLength":72)", cat(R"("byteLength":)", buffer.size()));
  const auto file = file_of(glb_of(json, buffer), "a.glb");
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(file.mesh.points[i], Vec3(2 * tetrahedron_points[i] + Vec3(0, 0, 3))) << i;
  const auto message = [&](const char* what, const char* by) {
    return message_of(glb_of(replaced(json, what, by), buffer), "a.glb");
  };
  EXPECT_EQ(message(R"("joints":[1,2])", R"("joints":[1,9])"),
            "a.glb, mesh 0: expected nodes as joints, found 9");
  EXPECT_EQ(message(R"("joints":[1,2])", R"("joints":[1])"),
            "a.glb, mesh 0: expected numbers of joints below 1, found 1");
  EXPECT_EQ(message(R"("joints":[1,2])", R"("joints":[1,2,1])"),
            "a.glb, mesh 0: expected a matrix for each joint of its skin, found fewer");
  EXPECT_EQ(message(R"("skin":0)", R"("skin":7)"), "a.glb, mesh 0: expected a skin with joints, found none");
  EXPECT_EQ(
      message(R"("JOINTS_0":2)", R"("JOINTS_0":1)"),
      "a.glb, mesh 0: expected four joints and weights for each of 4 vertices, found 12 and 16 numbers");
}

}  // namespace
}  // namespace relievo
