// Tests the readers of STL, OFF, glTF and the faces of PLY and OBJ: the meshes that they return, and their
// messages about broken fields.
#include <Eigen/Geometry>

#include "support/format_samples.h"
#include "support/ply_encoder.h"
#include "support/read_text.h"

namespace relievo {
namespace {

// Returns the corner coordinates of a mesh's triangles in sorted order, so that meshes can be compared
// independently of their numbering.
std::vector<std::array<std::array<double, 3>, 3>> corners_of(const Mesh& mesh) {
  std::vector<std::array<std::array<double, 3>, 3>> all;
  for (const Triangle& t : mesh.triangles) {
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) std::copy_n(mesh.points.at(t[c]).data(), 3, corners[c].data());
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

const Mesh tetrahedron = {tetrahedron_points, tetrahedron_triangles};

void expect_tetrahedron(const std::string& text, const std::string& name, const std::string& format) {
  const auto file = file_of(text, name);
  EXPECT_EQ(file.format, format);
  EXPECT_EQ(corners_of(file.mesh), corners_of(tetrahedron)) << format;
  EXPECT_EQ(file.cloud.size(), 4U) << format;
}

TEST(MeshFormats, AllReadTheSameTetrahedron) {
  expect_tetrahedron(binary_stl(), "scan", "STL binary");
  expect_tetrahedron(ascii_stl(), "scan", "STL ascii");
  expect_tetrahedron(off(), "scan", "OFF");
  expect_tetrahedron("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1/1 2/2 4/3\nf -4 -1 -2\nf 2 3 4\n",
                     "a.obj", "OBJ");
  const PlyTable vertices = ply_vertices({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const PlyTable faces{"face",
                       {{"uchar", "flag"}, {"int", "vertex_indices", "uchar"}},
                       {{1, 3, 0, 2, 1}, {1, 3, 0, 1, 3}, {1, 3, 0, 3, 2}, {1, 3, 1, 2, 3}}};
  expect_tetrahedron(encode_ply({vertices, faces}, PlyEncoding::ascii), "a.ply", "PLY ascii");
  expect_tetrahedron(encode_ply({vertices, faces}, PlyEncoding::big_endian), "a.ply",
                     "PLY binary big endian");
}

TEST(MeshFormats, StripsOfPlyTurnEverySecondTriangle) {
  const PlyTable vertices = ply_vertices({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  const PlyTable strips{"tristrips", {{"int", "vertex_indices", "int"}}, {{8, 0, 1, 2, 3, -1, 2, 1, 0}}};
  for (const auto encoding : {PlyEncoding::ascii, PlyEncoding::little_endian}) {
    const auto file = file_of(encode_ply({vertices, strips}, encoding), "a.ply");
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 1, 0}}));
  }
}

// The arrow is a concave polygon of area 2. A fan from its second corner would cover a larger area.
TEST(MeshFormats, ConcavePolygonsAreCoveredInEveryFormat) {
  const PlyTable vertices = ply_vertices({{0, 0, 0}, {2, 2, 0}, {0, 1, 0}, {-2, 2, 0}});
  const PlyTable faces = ply_faces({{4, 1, 2, 3, 0}});
  for (const std::string& text : {encode_ply({vertices, faces}, PlyEncoding::ascii),
                                  encode_ply({vertices, faces}, PlyEncoding::little_endian),
                                  std::string("OFF\n4 1 0\n0 0 0\n2 2 0\n0 1 0\n-2 2 0\n4 1 2 3 0\n")}) {
    const auto file = file_of(text, "a");
    double area = 0;
    for (const auto& [a, b, c] : file.mesh.triangles) {
      const auto& p = file.mesh.points;
      area += (p[b] - p[a]).cross(p[c] - p[a]).z() / 2;
      EXPECT_GT((p[b] - p[a]).cross(p[c] - p[a]).z(), 0) << file.format;
    }
    EXPECT_DOUBLE_EQ(area, 2) << file.format;
  }
}

TEST(MeshFormats, FacesOfPlyMayComeBeforeTheVertices) {
  const PlyTable vertices = ply_vertices({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const PlyTable other{"other", {{"uchar", "n"}}, {{1}, {2}}};
  PlyTable faces = ply_faces({{3, 0, 2, 1}, {3, 0, 1, 3}, {3, 0, 3, 2}, {3, 1, 2, 3}});
  for (const PlyEncoding encoding : ply_encodings)
    EXPECT_EQ(read(encode_ply({faces, other, vertices}, encoding), "a.ply")->mesh.triangles,
              tetrahedron_triangles);
  faces.rows[2][3] = 4;
  EXPECT_EQ(message_of(encode_ply({faces, vertices}, PlyEncoding::ascii), "a.ply"),
            "a.ply, line 12: expected numbers of vertices below 4, found 4 in row 2 of element face");
}

TEST(MeshFormats, PolygonsBecomeFans) {
  const auto file = file_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 1 2\n", "a.obj");
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(MeshFormats, TrianglesWithACornerThatIsNotFiniteAreLeftOut) {
  const auto file = file_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 2 3 4\n", "a.obj");
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(file.cloud.size(), 3U);
}

TEST(Stl, BinaryMayBeginWithSolid) {
  std::string file = binary_stl();
  file.replace(0, 5, "solid");
  expect_tetrahedron(file, "scan", "STL binary");
}

TEST(Stl, TextMayBeginInManyWays) {
  const std::string ascii = ascii_stl();
  for (const std::string& text :
       {"\xEF\xBB\xBF" + ascii, "  " + ascii, "\n\n" + ascii, replaced(ascii, "solid tetra", "SOLID tetra"),
        "  " + replaced(ascii, "solid tetra", "Solid tetra")})
    expect_tetrahedron(text, "scan.stl", "STL ascii");
}

// The name of the solid contains keywords of the format, which must not be read as such.
TEST(Stl, TextMayStandInOneLine) {
  const std::string named = replaced(ascii_stl(), "solid tetrahedron", "solid a vertex of my facet 7");
  expect_tetrahedron(replaced(named, "\n", " "), "a.stl", "STL ascii");
  expect_tetrahedron(replaced(named, "\n", "\t"), "a.stl", "STL ascii");
  expect_tetrahedron(named, "a.stl", "STL ascii");
  const std::string two =
      "solid a facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet "
      "endsolid a solid b facet normal 0 0 1 outer loop vertex 0 0 2 vertex 1 0 0 vertex 0 1 0 "
      "endloop endfacet endsolid b";
  EXPECT_EQ(file_of(two, "a.stl").mesh.triangles.size(), 2U);
  EXPECT_EQ(message_of(replaced(two, "0 1 0", "0 1 x"), "a.stl"),
            "a.stl, line 1: expected 3 numbers after vertex, found 'x'");
  EXPECT_EQ(message_of(replaced(two, "vertex 1 0 0 ", ""), "a.stl"),
            "a.stl, line 1: expected 3 vertices in the facet, found 2");
}

TEST(Stl, BrokenFieldsAreNamed) {
  const std::string binary = binary_stl(), ascii = ascii_stl();
  expect_messages(
      "a.stl",
      {{patched(binary, 80, std::uint32_t{5}),
        ", byte 80: expected the number of triangles, found 5, and there is room for 4"},
       {patched(binary, 80, ~std::uint32_t{0}),
        ", byte 80: expected the number of triangles, found 4294967295, and there is room for 4"},
       {patched(binary, 80, std::uint32_t{0}), ", byte 80: expected at least one triangle, found 0"},
       {std::string(50, '\1'), ", byte 0: expected the 84 bytes of a binary STL header, found 50"},
       {binary.substr(0, 100),
        ", byte 80: expected the number of triangles, found 4, and there is room for 0"},
       {replaced(ascii, "   vertex 1.000000 0.000000", "   vertex 1.0 zero"),
        ", line 6: expected 3 numbers after vertex, found 'zero'"},
       {replaced(ascii, "   vertex 1.000000 0.000000 0.000000", "   vertex 1.0 0.0"),
        ", line 6: expected 3 numbers after vertex, found nothing"},
       {replaced(ascii, "   vertex 1.000000 0.000000 0.000000\n", ""),
        ", line 7: expected 3 vertices in the facet, found 2"},
       {replaced(ascii, "endsolid tetrahedron\n", ""),
        ", line 30: expected endsolid, found the end of the file"},
       {ascii.substr(0, ascii.size() / 2), ", line 17: expected endsolid, found the end of the file"},
       {"solid\nendsolid\n", ", line 2: expected at least one facet with three vertices, found none"}});
}

TEST(Off, ReadsColoursAndNormals) {
  const auto file = file_of(
      "CNOFF 3 1 0\n0 0 0 0 0 1 255 0 0 255\n1 0 0 0 0 1 0 255 0 255\n"
      "0 1 0 0 0 1 0.0 0.0 1.0 1.0\n3 0 1 2\n",
      "scan");
  EXPECT_EQ(file.cloud.normals, std::vector<Vec3f>(3, Vec3f::UnitZ()));
  EXPECT_EQ(file.cloud.colours, (std::vector<Colour>{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}));
  EXPECT_EQ(file.mesh.colours, file.cloud.colours);
}

// Returns the bytes of a number in big-endian order.
template <typename T>
std::string big(T value) {
  std::string bytes = raw(value);
  std::ranges::reverse(bytes);
  return bytes;
}

// Returns the tetrahedron as a binary OFF file. `of_vertex` follows each position. The last face has a colour.
std::string binary_off(const std::string& keyword, const std::string& of_vertex) {
  std::string file = keyword + " BINARY\n" + big(4) + big(4) + big(6);
  for (const Vec3& p : tetrahedron_points) {
    for (const double x : p) file += big(static_cast<float>(x));
    file += of_vertex;
  }
  for (const Triangle& t : tetrahedron_triangles) {
    const bool is_last = t == tetrahedron_triangles.back();
    file += big(3) + big(t[0]) + big(t[1]) + big(t[2]) + big(is_last ? 4 : 0);
    if (is_last) file += std::string(16, '\0');
  }
  return file;
}

TEST(Off, BinaryFilesAreRead) {
  const std::string normal = big(0.F) + big(0.F) + big(2.F),
                    colour = big(1.F) + big(0.F) + big(.5F) + big(1.F);
  for (const std::string& text : {binary_off("OFF", ""), binary_off("STOFF", std::string(8, '\1'))}) {
    const auto file = file_of(text, "scan");
    EXPECT_EQ(file.format, "OFF binary");
    EXPECT_EQ(file.mesh.points, tetrahedron_points);
    EXPECT_EQ(file.mesh.triangles, tetrahedron_triangles);
  }
  const auto file = file_of(binary_off("CNOFF", normal + colour), "a.off");
  EXPECT_EQ(file.cloud.normals, std::vector<Vec3f>(4, Vec3f::UnitZ()));
  EXPECT_EQ(file.cloud.colours, std::vector<Colour>(4, Colour{255, 0, 128}));
}

TEST(Off, BrokenBinaryFilesAreNamed) {
  const std::string good = binary_off("OFF", "");
  const auto with = [&](std::size_t at, std::int32_t value) {
    return std::string(good).replace(at, 4, big(value));
  };
  expect_messages(
      "a.off", {{good.substr(0, 13), ", byte 11: expected the number of vertices, found the end of the file"},
                {with(11, -1), ", byte 11: expected the number of vertices, found -1"},
                {with(11, 1000), ", byte 23: expected 1000 vertices of 12 bytes, found 144 bytes"},
                {with(71, 1000), ", byte 75: expected 1000 corners, found 92 bytes"},
                {with(75, 4), ", byte 91: expected numbers of vertices below 4, found 4"},
                {with(87, 1000), ", byte 91: expected a colour of 1000 numbers, found 76 bytes"}});
}

TEST(Off, TheKeywordMayBeMissing) {
  expect_tetrahedron(replaced(off(), "OFF # a tetrahedron\n", ""), "a.off", "OFF");
  expect_tetrahedron("# mine\n\n" + replaced(off(), "OFF # a tetrahedron\n", ""), "a.off", "OFF");
  expect_tetrahedron(replaced(off(), "OFF # a tetrahedron\n", "OFF "), "a.off", "OFF");
}

// Numbers after a face may be its colour, so a second face in the same line is skipped as a colour. The
// reader notices only at the end of the file that a face is missing. The message must then say that each face
// has to begin on a line of its own.
TEST(Off, TwoRowsInALineAreRefusedWithTheReason) {
  EXPECT_EQ(
      message_of(replaced(off(), "3 0 2 1\n", "3 0 2 1 "), "a.off"),
      "a.off, line 11: expected 4 faces, found the end of the file after 3; each has to begin on a line of "
      "its own");
}

TEST(Off, RowsMayGoOverTheEndsOfLines) {
  expect_tetrahedron(replaced(replaced(off(), "3 0 2 1", "3 0\n2\n\n1"), "0 1 0\n", "0 1\n  0 # y\n"), "scan",
                     "OFF");
}

TEST(Off, BrokenFieldsAreNamed) {
  const std::string good = off();
  expect_messages(
      "a.off",
      {{replaced(good, "OFF #", "FOF #"), ", line 1: expected OFF, COFF or NOFF, found 'FOF'"},
       {replaced(good, "4 4 6", "four 4 6"),
        ", line 2: expected the numbers of vertices and faces, found 'four'"},
       {replaced(good, "4 4 6", "4 -4 6"),
        ", line 2: expected the numbers of vertices and faces, found '-4'"},
       {replaced(good, "4 4 6", "4"), ", line 2: expected the numbers of vertices and faces, found nothing"},
       {replaced(good, "4 4 6", "4 9 6"), ", line 12: expected 9 faces, found the end of the file after 4"},
       {replaced(good, "4 4 6", "4294967290 4 6"),
        ", line 12: expected 4294967290 vertices, found the end of the file after 8"},
       {replaced(good, "1 0 0\n", "1 x 0\n"), ", line 4: expected a number, found 'x'"},
       {replaced(good, "1 0 0\n", "1 0\n"),
        ", line 5: expected the end of a row that began in a line before, found '1'"},
       {replaced(good, "3 0 2 1", "3 0 2 4"), ", line 7: expected numbers of vertices below 4, found 4"},
       {replaced(good, "3 0 2 1", "3 0 2 -1"), ", line 7: expected numbers of vertices below 4, found -1"},
       {replaced(good, "3 0 2 1", "4 0 2 1"),
        ", line 8: expected the end of a row that began in a line before, found '0'"},
       {replaced(good, "3 1 2 3", "4 1 2 3"),
        ", line 11: expected 4 numbers of vertices, found the end of the file"},
       {replaced(good, "3 0 2 1", "x 0 2 1"), ", line 7: expected the number of corners, found 'x'"},
       {good.substr(0, good.find("3 0 3 2")),
        ", line 10: expected 4 faces, found the end of the file after 2"},
       {"OFF\n", ", line 1: expected the numbers of vertices and faces, found nothing"}});
}

TEST(Gltf, NodesPlaceTheirMeshes) {
  for (const std::string& text : {glb(), embedded_gltf()}) {
    const auto file = file_of(text, "a.gltf");
    EXPECT_EQ(file.mesh.points, (std::vector<Vec3>{{10, 0, 0}, {12, 0, 0}, {10, 2, 0}, {10, 0, 2}}));
    EXPECT_EQ(file.mesh.triangles, tetrahedron_triangles);
  }
}

TEST(Gltf, QuaternionsAndMatricesTurn) {
  const std::string quarter = R"("rotation":[0,0,0.7071067811865476,0.7071067811865476])";
  const std::string matrix = R"("matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,0,0,0,1])";
  for (const std::string& turn : {quarter, matrix}) {
    const auto file = file_of(glb_of(replaced(gltf_json(), R"("translation":[10,0,0])", turn)), "scan");
    EXPECT_LT((file.mesh.points[1] - Vec3(0, 2, 0)).norm(), 1e-12);
  }
}

TEST(Gltf, BrokenFieldsAreNamed) {
  const std::string good = glb();
  const auto json = [&](std::string_view what, std::string_view by) {
    return glb_of(replaced(gltf_json(), what, by));
  };
  const std::string first = ", mesh 0, accessor 0: ", indices = ", mesh 0, accessor 1: ";
  expect_messages(
      "a.glb",
      {{good.substr(0, 10), ", byte 10: expected a GLB header, found the end of the file"},
       {patched(good, 4, std::uint32_t{1}), ", byte 4: expected version 2 of glTF, found 1"},
       {patched(good, 8, std::uint32_t{99999}),
        ", byte 8: expected 99999 bytes, found " + std::to_string(good.size())},
       {patched(good, 12, std::uint32_t{99999}),
        ", byte 12: expected a chunk of 99999 bytes, found " + std::to_string(good.size() - 20)},
       {patched(good, 16, std::uint32_t{0}), ", byte 12: expected a JSON chunk, found none"},
       {json("{\"asset\"", "{asset"), ", JSON: expected the JSON of a glTF file, found text that is none"},
       {json("asset", "tessa"), ", asset: expected the member asset of a glTF file, found none"},
       {json(R"("byteLength":72)", R"("byteLength":73)"),
        ", buffer 0: expected the bytes that it says, byteLength 73, found 72"},
       {json("5126", "5127"), first + "expected a known componentType and type, found 5127 and '\"VEC3\"'"},
       {json("VEC3", "VEC9"), first + "expected a known componentType and type, found 5126 and '\"VEC9\"'"},
       {json(R"("count":4)", R"("count":5)"), first + "expected room for 5 elements, found 48 bytes"},
       {json(R"("count":4)", R"("count":-4)"),
        first + "expected whole numbers as componentType and count, found componentType 5126, count -4"},
       {json(R"("count":4)", R"("sparse":{},"count":4)"),
        first + "expected the indices and values of its sparse part, found none of them"},
       {json(R"("byteOffset":48)", R"("byteOffset":49)"),
        indices + "expected a view inside its buffer of 72 bytes, found 24 from byte 49 on"},
       {json(R"({"bufferView":0)", R"({"byteOffset":49,"bufferView":0)"),
        first + "expected a byteOffset inside its bufferView, up to 48, found 49"},
       {json(R"({"buffer":0,"byteLength":48})", R"({"buffer":1,"byteLength":48})"),
        first + "expected a buffer, found none of that number"},
       {json(R"("bufferView":0)", R"("bufferView":7)"), first + "expected a bufferView, found none"},
       {json(R"("POSITION":0)", R"("POSITION":9)"),
        ", mesh 0, accessor 9: expected an accessor, found none of that number"},
       {json(R"("POSITION":0)", R"("POSITION":1)"),
        ", mesh 0: expected vectors of 3 numbers as POSITION, found vectors of 1"},
       {json(R"("mesh":0)", R"("mesh":3)"), ", mesh 3: expected a mesh, found none of that number"},
       {json(R"("mesh":0)", R"("children":[0])"), ", node 0: expected one parent, found two or a ring"},
       {json(R"("nodes":[0])", R"("nodes":[5])"), ", node 5: expected a node, found none of that number"},
       {json("[10,0,0]", "[10,0]"),
        ", node 0: expected 16 numbers as matrix, 4 as rotation, 3 as translation and scale, found "
        "translation [10,0]"},
       {json(R"("indices":1)", R"("mode":1)"), ", meshes: expected triangles or points, found lines"},
       {json(R"("scene":0)", R"("extensionsRequired":["KHR_draco_mesh_compression"])"),
        ", extensionsRequired: expected meshes that are not compressed, found 'KHR_draco_mesh_compression'; "
        "Blender opens the file, and exports it without compression"},
       {patched(good, good.size() - 24, std::uint16_t{4}),
        ", mesh 0: expected numbers of vertices below 4, found 4"}});
}

TEST(PlyFaces, BrokenOnesAreNamed) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  expect_messages(
      "a.ply",
      {{header + "3 0 1 3\n",
        ", line 13: expected numbers of vertices below 3, found 3 in row 0 of element face"},
       {header + "3 0 1 -1\n",
        ", line 13: expected numbers of vertices below 3, found -1 in row 0 of element face"},
       {header + "3 0 1 x\n", ", line 13: expected whole numbers in the list vertex_indices, found 'x'"},
       {header + "3 0 1\n", ", line 13: expected 1 rows of element face, found the end of the file after 0"},
       {header, ", line 12: expected 1 rows of element face, found the end of the file after 0"}});
}

}  // namespace
}  // namespace relievo
