// Tests glTF with buffers in other files, and with features that are legal but rare.
#include "io/gltf/gltf.h"

#include <Eigen/Geometry>

#include "support/format_samples.h"
#include "support/read_text.h"

namespace relievo {
namespace {

// Reads the glTF text with `files` in the same folder. Adds the names of the files that the reader requests to `asked`.
Result<CloudFile> read_beside(const std::string& text, const std::map<std::string, std::string>& files,
                              std::vector<std::string>* asked = nullptr) {
  return read_cloud(bytes_of(text), "a.gltf", [&](const std::string& name) {
    if (asked) asked->push_back(name);
    return files_beside(files)(name);
  });
}

// Returns the sample, read with `by` in place of `what` in its JSON.
CloudFile changed(std::string_view what, std::string_view by) {
  return file_of(glb_of(replaced(gltf_json(), what, by)), "a.glb");
}

std::string with_uri(const std::string& uri) {
  return gltf_json(R"("uri":")" + uri + R"(",)");
}

TEST(GltfBeside, TakesBuffersFromOtherFiles) {
  const std::map<std::string, std::string> files = {{"a.bin", gltf_buffer()},
                                                    {"two words.bin", gltf_buffer()},
                                                    {"gr\xC3\xBCn.bin", gltf_buffer()},
                                                    {"data/a.bin", gltf_buffer()},
                                                    {"100%.bin", gltf_buffer()}};
  for (const char* uri : {"a.bin", "two%20words.bin", "two words.bin", "gr%C3%BCn.bin", "gr\xC3\xBCn.bin",
                          "data/a.bin", "100%.bin", "%61.bin"}) {
    std::vector<std::string> asked;
    const auto file = value_of(read_beside(with_uri(uri), files, &asked));
    EXPECT_EQ(file.mesh.triangles, tetrahedron_triangles) << uri;
    EXPECT_EQ(asked.size(), 1U) << uri;
  }
}

const std::string draco_primitive =
    R"("extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}},"attributes")";

// A file that has both plain and compressed vertices does not require the extension for compression.
TEST(Gltf, CompressedVerticesAreRefusedUnlessThereArePlainOnes) {
  const std::string both = replaced(gltf_json(), R"("attributes")", draco_primitive);
  EXPECT_EQ(file_of(glb_of(both), "a.glb").mesh.triangles, tetrahedron_triangles);
  const std::string alone = replaced(both, R"("accessors":[{"bufferView":0,)", R"("accessors":[{)");
  EXPECT_EQ(
      message_of(glb_of(alone), "a.glb"),
      "a.glb, mesh 0: expected meshes that are not compressed, found 'KHR_draco_mesh_compression'; Blender "
      "opens the file, and exports it without compression");
}

TEST(Gltf, PointsAndLinesBesideTrianglesAreTold) {
  const auto file = changed(R"("primitives":[)", R"("primitives":[{"attributes":{"POSITION":0},"mode":0},)"
                                                 R"({"attributes":{"POSITION":0},"mode":1},)");
  EXPECT_EQ(file.mesh.triangles.size(), 4U);
  EXPECT_EQ(file.remarks, (std::vector<std::string>{"left out 4 single points, as there are triangles, too",
                                                    "left out the lines"}));
}

// The data in a URI are base64 or plain bytes. In both forms any byte may be escaped, so the test escapes some.
TEST(Gltf, ReadsDataOfUrisInBothForms) {
  std::string escaped;
  for (const char byte : gltf_buffer()) {
    constexpr std::string_view digits = "0123456789abcdef";
    const auto number = static_cast<unsigned char>(byte);
    escaped += '%';
    escaped += digits[number / 16];
    escaped += digits[number % 16];
  }
  for (const std::string& uri :
       {"data:application/octet-stream," + escaped, "data:," + escaped,
        "data:;base64," + replaced(replaced(base64(gltf_buffer()), "=", "%3D"), "/", "%2F")}) {
    const auto file = value_of(read(with_uri(uri), "a.gltf"));
    EXPECT_EQ(file.mesh.triangles, tetrahedron_triangles);
    EXPECT_EQ(file.mesh.points, read(glb(), "a.glb")->mesh.points);
  }
  EXPECT_EQ(message_of(with_uri("data:abc"), "a.gltf"),
            "a.gltf, buffer 0: expected a comma before the data of the uri, found none");
  EXPECT_EQ(message_of(with_uri("data:;base64,A*"), "a.gltf"),
            "a.gltf, buffer 0: expected base64 text, found '*' as character 2");
}

TEST(GltfBeside, NamesWhatIsMissing) {
  const std::string missing =
      "a.gltf, buffer 0: expected the file 'b.bin' beside it, found none that can be read; a .glb needs no "
      "other file";
  EXPECT_EQ(read_beside(with_uri("b.bin"), {}).error().message(), missing);
  EXPECT_EQ(message_of(with_uri("b.bin"), "a.gltf"), missing);
  EXPECT_EQ(read_beside(with_uri("b.bin"), {{"b.bin", "short"}}).error().message(),
            "a.gltf, buffer 0: expected the bytes that it says, byteLength 72, found 5");
}

TEST(GltfBeside, AsksForNoFileOutsideTheFolder) {
  for (const char* uri :
       {"/etc/passwd", "../a.bin", "data/../../a.bin", "%2E%2E/a.bin", "%2Fetc/passwd", "..", "file:///a.bin",
        "http://a.b/c.bin", "C:/a.bin", "..\\\\a.bin", "", "a%00.bin"}) {
    std::vector<std::string> asked;
    const auto file = read_beside(with_uri(uri), {}, &asked);
    ASSERT_FALSE(file) << uri;
    EXPECT_TRUE(asked.empty()) << uri;
    EXPECT_TRUE(file.error().expected.starts_with("expected a file in the same folder, found ")) << uri;
  }
}

TEST(GltfBeside, BuffersThatNoMeshUsesMayBeMissing) {
  const std::string more =
      replaced(gltf_json(), R"("buffers":[)", R"("buffers":[{"uri":"no.bin","byteLength":9},)");
  const auto file = file_of(glb_of(replaced(more, R"("buffer":0)", R"("buffer":1)")), "a.glb");
  EXPECT_EQ(file.mesh.triangles, tetrahedron_triangles);
}

TEST(Gltf, ReadsMeshesWithoutNodes) {
  const std::string json = gltf_with_nodes(""),
                    mesh = R"({"primitives":[{"attributes":{"POSITION":0},"indices":1}]})";
  EXPECT_EQ(file_of(glb_of(json), "a.glb").mesh.points, tetrahedron_points);
  const std::string two = replaced(json, mesh, mesh + "," + mesh);
  EXPECT_EQ(file_of(glb_of(two), "a.glb").mesh.triangles.size(), 8U);
}

// Chunks of unknown kinds are ignored, and so is a second binary chunk.
TEST(Gltf, TakesTheFirstBinaryChunk) {
  const auto size = [](std::size_t n) { return raw(static_cast<std::uint32_t>(n)); };
  const std::string chunks = glb().substr(12), text_size = chunks.substr(0, 4);
  const std::size_t text_end = 8 + std::size_t{static_cast<unsigned char>(text_size[0])} +
                               256 * std::size_t{static_cast<unsigned char>(text_size[1])};
  const std::string zeros = size(72) + std::string("BIN\0", 4) + std::string(72, '\0');
  const std::string unknown = size(4) + "ABCD" + "1234";
  const std::string all = chunks.substr(0, text_end) + unknown + chunks.substr(text_end) + zeros + unknown;
  const auto file = file_of("glTF" + size(2) + size(12 + all.size()) + all, "a.glb");
  EXPECT_EQ(file.mesh.points, read(glb(), "a.glb")->mesh.points);
}

TEST(Gltf, ReadsPointsAsACloud) {
  const auto file = changed(R"("indices":1)", R"("mode":0)");
  EXPECT_TRUE(file.mesh.empty());
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{10, 0, 0}, {12, 0, 0}, {10, 2, 0}, {10, 0, 2}}));
}

TEST(Gltf, SkipsPrimitivesWithoutPositions) {
  const std::string two = replaced(gltf_json(), R"("primitives":[)", R"("primitives":[{"attributes":{}},)");
  EXPECT_EQ(file_of(glb_of(two), "a.glb").mesh.triangles, tetrahedron_triangles);
}

TEST(Gltf, TakesWholeNumbersWrittenAsFractions) {
  const auto file = changed(R"("nodes":[0])", R"("nodes":[0.0])");
}

// Returns the tetrahedron, with its second and fourth corner given by sparse values.
std::string sparse_glb(const std::string& base) {
  std::string json =
      replaced(gltf_json(), R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})",
               R"({)" + base +
                   R"("componentType":5126,"count":4,"type":"VEC3","sparse":{"count":2,)"
                   R"("indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":3}}})");
  json = replaced(json, R"("byteOffset":48,"byteLength":24})",
                  R"("byteOffset":48,"byteLength":24},{"buffer":1,"byteLength":2},)"
                  R"({"buffer":1,"byteOffset":4,"byteLength":24})");
  std::string more = std::string("\1\3\0\0", 4);
  for (const float x : {5.F, 6.F, 7.F, 8.F, 9.F, 10.F}) more += raw(x);
  json = replaced(json, R"("byteLength":72}]})",
                  R"("byteLength":72},{"uri":"data:;base64,)" + base64(more) + R"(","byteLength":28}]})");
  return glb_of(replaced(replaced(json, "[10,0,0]", "[0,0,0]"), "[2,2,2]", "[1,1,1]"));
}

TEST(Gltf, ReplacesTheVectorsOfSparseAccessors) {
  const auto file = file_of(sparse_glb(R"("bufferView":0,)"), "a.glb");
  EXPECT_EQ(file.mesh.points, (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {0, 1, 0}, {8, 9, 10}}));
  const auto zeros = file_of(sparse_glb(""), "a.glb");
  EXPECT_EQ(zeros.mesh.points, (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {0, 0, 0}, {8, 9, 10}}));
  EXPECT_EQ(
      message_of(replaced(sparse_glb(""), R"("count":4,"type":"VEC3")", R"("count":2,"type":"VEC3")"), "a"),
      "a, mesh 0, accessor 0: expected sparse indices below 2, found 3");
}

TEST(Gltf, NamesOldVersions) {
  EXPECT_EQ(message_of(replaced(gltf_json(), "\"2.0\"", "\"1.0\""), "a.gltf"),
            "a.gltf, asset.version: expected version 2 of glTF, found '1.0'");
}

TEST(Gltf, AnEmptyAccessorHasNoPoints) {
  const std::string json =
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":0}],"bufferViews":[{"buffer":0,"byteLength":0}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":0,"type":"VEC3"}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})";
  EXPECT_EQ(message_of(json, "a.gltf"), "a.gltf, meshes: expected triangles or points, found none");
}

// Exporters store coordinates as integers of 8 or 16 bits. The coordinates are fractions of the largest
// integer, or the node scales the integers.
TEST(Gltf, ReadsQuantisedMeshes) {
  struct Kind {
    int code;
    double largest;
    bool is_normalised;
  };
  for (const Kind& kind : {Kind{5120, 127, true},
                           {5120, 50, false},
                           {5121, 255, true},
                           {5122, 32767, true},
                           {5122, 3000, false},
                           {5123, 65535, true}}) {
    std::string buffer;
    for (const Vec3& point : tetrahedron_points)
      for (const double x : {point.x(), point.y(), point.z(), 0.}) {
        const auto number = static_cast<std::uint16_t>(x * kind.largest);
        buffer += kind.code < 5122 ? std::string(1, static_cast<char>(number)) : raw(number);
      }
    const std::size_t stride = buffer.size() / 4;
    buffer.resize(48);
    for (const Triangle& t : tetrahedron_triangles)
      for (const std::uint32_t i : t) buffer += raw(static_cast<std::uint16_t>(i));
    std::string json = replaced(gltf_json(), R"("componentType":5126)",
                                R"("componentType":)" + std::to_string(kind.code) +
                                    (kind.is_normalised ? R"(,"normalized":true)" : ""));
    json = replaced(json, R"({"buffer":0,"byteLength":48})",
                    R"({"buffer":0,"byteLength":48,"byteStride":)" + std::to_string(stride) + "}");
    const auto file = file_of(glb_of(json, buffer), "a.glb"), plain = file_of(glb(), "a.glb");
    EXPECT_EQ(file.mesh.triangles, tetrahedron_triangles);
    const Vec3 middle(10, 0, 0);  // the nodes move the mesh to this point and double its size
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 expected =
          (plain.mesh.points[i] - middle) * (kind.is_normalised ? 1 : kind.largest) + middle;
      EXPECT_LE((file.mesh.points[i] - expected).norm(), 1e-9) << kind.code;
    }
  }
}

// The two nodes of the file together move a mesh by (10, 0, 0) and double its size. The second copy is
// also rotated by 90 degrees about z.
TEST(Gltf, PutsCopiesOfAMeshWhereInstancingSaysSo) {
  std::string buffer = gltf_buffer();
  for (const float x : {0.F, 0.F, 0.F, 5.F, 6.F, 7.F}) buffer += raw(x);
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, std::sqrt(.5F), std::sqrt(.5F)}) buffer += raw(x);
  for (const float x : {1.F, 1.F, 1.F, 3.F, 3.F, 3.F}) buffer += raw(x);
  const auto json = [](const std::string& attributes) {
    std::string text =
        replaced(gltf_json(), R"("mesh":0,)",
                 R"("mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{)" + attributes + "}}},");
    text = replaced(
        text, R"("count":12,"type":"SCALAR"})",
        R"("count":12,"type":"SCALAR"},{"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"},)"
        R"({"bufferView":3,"componentType":5126,"count":2,"type":"VEC4"},)"
        R"({"bufferView":4,"componentType":5126,"count":2,"type":"VEC3"})");
    text = replaced(
        text, R"("byteOffset":48,"byteLength":24})",
        R"("byteOffset":48,"byteLength":24},{"buffer":0,"byteOffset":72,"byteLength":24},)"
        R"({"buffer":0,"byteOffset":96,"byteLength":32},{"buffer":0,"byteOffset":128,"byteLength":24})");
    return replaced(replaced(text, R"("byteLength":72)", R"("byteLength":152)"), R"("scene":0)",
                    R"("scene":0,"extensionsRequired":["EXT_mesh_gpu_instancing"])");
  };
  const auto file = file_of(glb_of(json(R"("TRANSLATION":2,"ROTATION":3,"SCALE":4)"), buffer), "a.glb");
  const std::vector<Vec3> expected = {{10, 0, 0},   {12, 0, 0},   {10, 2, 0},   {10, 0, 2},
                                      {20, 12, 14}, {20, 18, 14}, {14, 12, 14}, {20, 12, 20}};
  ASSERT_EQ(file.mesh.points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_LE((file.mesh.points[i] - expected[i]).norm(), 1e-5) << i;
  EXPECT_EQ(file.mesh.triangles.size(), 8U);
  EXPECT_EQ(file.mesh.triangles[4], (Triangle{4, 6, 5}));
  const auto numbered = file_of(glb_of(json(R"("_ID":2)"), buffer), "a.glb");
  EXPECT_EQ(numbered.mesh.points.size(), 4U) << "copies without a place are one";
  EXPECT_EQ(message_of(glb_of(json(R"("ROTATION":2)"), buffer), "a.glb"),
            "a.glb, node 1: expected vectors of 4 numbers as ROTATION, found vectors of 3");
  EXPECT_EQ(message_of(glb_of(json(R"("TRANSLATION":2,"SCALE":0)"), buffer), "a.glb"),
            "a.glb, node 1: expected as many values of SCALE as copies, 2, found 4");
}

TEST(Gltf, ReadsWhatRequiresExtensionsThatLeaveShapesAlone) {
  const auto with = [](const std::string& name) {
    return glb_of(replaced(gltf_json(), R"("scene":0)", R"("scene":0,"extensionsRequired":[)" + name + "]"));
  };
  for (const char* name :
       {"KHR_mesh_quantization", "KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness",
        "KHR_texture_transform", "KHR_texture_basisu", "EXT_texture_webp", "KHR_lights_punctual",
        "EXT_lights_image_based", "EXT_meshopt_compression", "KHR_techniques_webgl"}) {
    const auto file = value_of(read(with("\"" + std::string(name) + "\""), "a.glb"));
    EXPECT_EQ(file.mesh.triangles, tetrahedron_triangles);
  }
  const auto refusal = [](const std::string& found) {
    return "a.glb, extensionsRequired: expected no extension but those that are read here, found " + found +
           "; export the model without it, or as PLY, STL or OBJ";
  };
  EXPECT_EQ(message_of(with(R"("KHR_texture_basisu","KHR_gaussian_splatting")"), "a.glb"),
            refusal("'KHR_gaussian_splatting'"));
  EXPECT_EQ(message_of(with("7"), "a.glb"), refusal("'7'"));
}

TEST(Gltf, RefusesNumbersOfAnotherKind) {
  const auto message = [](std::string_view what, std::string_view by) {
    return message_of(glb_of(replaced(gltf_json(), what, by)), "a.glb");
  };
  const std::string positions = R"("count":4,"type":"VEC3")", indices = R"("componentType":5123,"count":12)";
  EXPECT_EQ(message(positions, R"("count":3,"type":"VEC4")"),
            "a.glb, mesh 0: expected vectors of 3 numbers as POSITION, found vectors of 4");
  EXPECT_EQ(message(indices, R"("componentType":5126,"count":6)"),
            "a.glb, mesh 0: expected whole numbers as indices, found fractions");
  EXPECT_EQ(message(indices + R"(,"type":"SCALAR")", R"("componentType":5123,"count":4,"type":"VEC3")"),
            "a.glb, mesh 0: expected whole numbers as indices, found vectors");
}

double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6;
  return volume;
}

// Mirroring turns the triangles of a mesh inside out. The format requires readers to reverse them.
TEST(Gltf, KeepsTheOutsideOfMirroredMeshesOutside) {
  for (const char* scale : {"[2,2,2]", "[-2,2,2]", "[-2,-2,-2]"}) {
    const auto file = changed("[2,2,2]", scale);
    EXPECT_NEAR(volume_of(file.mesh), 8 / 6., 1e-9) << scale;
  }
}

TEST(Gltf, KeepsNormalsOfMirroredMeshesOutside) {
  const std::string json = replaced(gltf_json(), R"("POSITION":0)", R"("POSITION":0,"NORMAL":0)");
  const auto file = file_of(glb_of(replaced(json, "[2,2,2]", "[-2,2,2]")), "a.glb");
  ASSERT_FALSE(file.mesh.triangles.empty());
  for (std::size_t t = 0; t < file.mesh.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 place = file.mesh.points[file.mesh.triangles[t][c]] - Vec3(10, 0, 0);
      const double outwards = place.dot(file.mesh.corner_normals[t][c].cast<double>());
      EXPECT_TRUE(place.isZero() || outwards > 0) << t;
    }
}

// If the reader searched for the root from each node, reading would take half a minute. If the reader
// searched recursively, the stack would overflow.
TEST(Gltf, ReadsALongChainOfNodesWithoutAScene) {
  std::string nodes = R"("nodes":[)";
  const int length = 400000;
  for (int i = 0; i < length; ++i) nodes += R"({"children":[)" + std::to_string(i + 1) + "]},";
  nodes += R"({"mesh":0}],)";
  EXPECT_EQ(file_of(glb_of(gltf_with_nodes(nodes)), "a.glb").mesh.points, tetrahedron_points);
}

}  // namespace
}  // namespace relievo
