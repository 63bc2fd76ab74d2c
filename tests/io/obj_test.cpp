#include <Eigen/Geometry>

#include "support/read_text.h"

namespace relievo {
namespace {

Cloud cloud_of(std::string_view text) {
  return file_of(text, "scan.obj").cloud;
}

const std::string two_normals = "vn 0 0 2\nvn 3 0 0\n";
const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

const Vec3f x = Vec3f::UnitX(), z = Vec3f::UnitZ();
const Vec3f xz = Vec3f(1, 0, 1).normalized();

TEST(Obj, ReadsVerticesWithExtraNumbersAndSkipsOtherLines) {
  const Cloud cloud = cloud_of(
      "\xEF\xBB\xBF# made by hand\r\nmtllib a.mtl\r\no thing\r\n\r\nv 1 2 3\r\nv 4.5 -5 6e3 1.0\r\n"
      "  v\t+7 8 9 1.0 0.5 0.5 0.5 # red\r\nvt 0 0\r\ng part\r\ns off\r\nl 1 2\r\nf 1 2 3\r\n");
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4.5, -5, 6000}, {7, 8, 9}}));
  EXPECT_FALSE(cloud.has_normals());
}

TEST(Obj, ColoursMayFollowTheCoordinates) {
  const std::string faces = "f 1 2 3\n";
  for (const std::string& text : {std::string("v 0 0 0 1 0 0.5\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\n"),
                                  std::string("v 0 0 0 255 0 128\nv 1 0 0 0 255 0\nv 0 1 0 0 0 255\n"),
                                  std::string("v 0 0 0 1 0 .5 1\nv 1 0 0 0 1 0 1\nv 0 1 0 0 0 1 1\n"),
                                  std::string("v 0 0 0 1 1 0 .5\nv 1 0 0 1.0 0 1 0\nv 0 1 0 1 0 0 1\n"),
                                  std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\n#MRGB ffff0080ff00ff00\n"
                                              "#MRGB 000000ff\n#MRGB 00\n# MRGB ffffffff\n")}) {
    const CloudFile file = file_of(text + faces, "a.obj");
    EXPECT_EQ(file.cloud.colours, (std::vector<Colour>{{255, 0, 128}, {0, 255, 0}, {0, 0, 255}}));
    EXPECT_EQ(file.mesh.colours, file.cloud.colours);
    EXPECT_TRUE(file.remarks.empty());
  }
  const CloudFile some = file_of("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\n" + faces, "a.obj");
  EXPECT_FALSE(some.cloud.has_colours());
  EXPECT_EQ(some.remarks[0], "left out the colours, which only 1 of 3 vertices have");
}

TEST(Obj, CurvesAndSurfacesAreNotRead) {
  const std::string surface = "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 3\nend\n";
  EXPECT_EQ(message_of(triangle + surface, "a.obj"),
            "a.obj, line 6: expected faces, found curves or surfaces, which are not read; the CAD program "
            "that made them exports triangles, too");
  const CloudFile both = file_of(triangle + "f 1 2 3\n" + surface + "curv 0 1 1 2\n", "a.obj");
  EXPECT_EQ(both.mesh.triangles.size(), 1U);
  EXPECT_EQ(both.remarks[0], "left out 2 curves and surfaces (curv, surf), which are not read");
}

TEST(Obj, AveragesTheNormalsOfTheCornersOfAVertex) {
  const Cloud cloud = cloud_of(triangle + two_normals + "f 1//1 2//1 3//2\nf 1//2 3//2 2//1\n");
  ASSERT_EQ(cloud.normals.size(), 3U);
  EXPECT_TRUE(cloud.normals[0].isApprox(xz));
  EXPECT_EQ(cloud.normals[1], z);
  EXPECT_EQ(cloud.normals[2], x);
}

TEST(Obj, ReadsCornersOfEveryForm) {
  for (const auto* face : {"f 1//1 2//1 3//2", "f 1/7/1 2/8/1 3/9/2", "f -3//-2 -2//-2 -1//-1",
                           "f 1//-2 -2/5/1 3//2", "fo 1//1 2//1 3//2\n"}) {
    const Cloud cloud = cloud_of(triangle + two_normals + face);
    EXPECT_EQ(cloud.normals, (std::vector<Vec3f>{z, z, x})) << face;
  }
}

TEST(Obj, NegativeIndicesCountBackFromTheirLine) {
  const Cloud cloud = cloud_of(triangle + "vn 0 0 1\nf -3//-1 -2//-1 -1//-1\n" + triangle +
                               "vn 1 0 0\nf -3//-1 -2//-1 -1//-1\n");
  EXPECT_EQ(cloud.normals, (std::vector<Vec3f>{z, z, z, x, x, x}));
}

TEST(Obj, FacesMayComeBeforeTheirVertices) {
  EXPECT_EQ(cloud_of("f 1//1 2//1 3//2\n" + triangle + two_normals).normals, (std::vector<Vec3f>{z, z, x}));
}

TEST(Obj, TakesOneNormalPerVertexIfNoFaceNamesAny) {
  const std::string text = triangle + two_normals + "vn 0 0 1\n";
  EXPECT_EQ(cloud_of(text).normals, (std::vector<Vec3f>{z, x, z}));
  EXPECT_EQ(cloud_of(text + "f 1 2 3\nf 1/1 2/1 3/1\n").normals, (std::vector<Vec3f>{z, x, z}));
  EXPECT_FALSE(cloud_of(triangle + two_normals).has_normals());
}

TEST(Obj, NormalsThatAreNotThereAreForgotten) {
  const auto none = file_of(triangle + "f 1//7 2//8 3//9\n", "scan.obj");
  EXPECT_FALSE(none.cloud.has_normals());
  EXPECT_EQ(none.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_TRUE(none.mesh.corner_normals.empty());
  EXPECT_EQ(cloud_of(triangle + "vn 0 0 1\nf 1//1 2//1 3//1\nf 1//1 2//2 3//1\n").normals,
            (std::vector<Vec3f>{z, z, z}));
}

TEST(Obj, AnEmptyNumberOfANormalIsNone) {
  for (const char* face : {"f 1// 2// 3//", "f 1/1/ 2/2/ 3/3/"}) {
    const auto file = value_of(read(triangle + face, "scan.obj"));
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}})) << face;
  }
}

TEST(Obj, ANumberSignInNanIsNoComment) {
  const auto file = file_of("v 1.#IND -1.#QNAN 0 # none\n" + triangle + "f 2 3 4#all\n", "scan.obj");
  EXPECT_EQ(file.dropped_points, 1U);
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{1, 2, 3}}));
}

TEST(Obj, CornersOfConcavePolygonsKeepTheirNormals) {
  const auto file = value_of(
      read("v 0 0 0\nv 2 2 0\nv 0 1 0\nv -2 2 0\nvn 0 0 1\nvn 1 0 0\nf 2//1 3//2 4//1 1//1\nf 1 2\nf 3\n",
           "scan.obj"));
  double area = 0;
  for (const auto& [a, b, c] : file.mesh.triangles) {
    const auto& p = file.mesh.points;
    area += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
  }
  EXPECT_DOUBLE_EQ(area, 2);  // the arrow's area, which triangles outside of the arrow would increase
  for (std::size_t t = 0; t < file.mesh.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(file.mesh.corner_normals[t][c], file.mesh.triangles[t][c] == 2 ? x : z);
}

TEST(Obj, VerticesWithoutNormalsAreDroppedWhileTheyAreFew) {
  const auto most = file_of(triangle + "v 9 9 9\n" + two_normals + "f 1//1 2//1 3//1\n", "scan.obj");
  EXPECT_EQ(most.cloud.size(), 3U);
  EXPECT_EQ(most.cloud.normals, (std::vector<Vec3f>{z, z, z}));
  EXPECT_EQ(most.dropped_normals, 1U);

  const auto few =
      file_of(triangle + triangle + "v 9 9 9\n" + two_normals + "f 1//1 2//1 3//1\n", "scan.obj");
  EXPECT_EQ(few.cloud.size(), 7U);
  EXPECT_FALSE(few.cloud.has_normals());
  EXPECT_EQ(few.dropped_normals, 4U);
}

TEST(Obj, BackslashContinuesALine) {
  const Cloud cloud = cloud_of("v 1 2\\\n3\r\nv 4 \\\r\n 5 \\\r\n 6\r\nv 7 8 9\\\n");
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

TEST(Obj, IsToldByItsContent) {
  EXPECT_EQ(file_of("# no name\n\nv 1 2 3\n", "-").format, "OBJ");
}

TEST(Obj, BadLinesAreNamed) {
  expect_messages("scan.obj",
                  {
                      {"v 1 2\n", ", line 1: expected 3 numbers, found the end of the line"},
                      {"v 1 2 x\n", ", line 1: expected 3 numbers, found 'x'"},
                      {"v 1,5 2 3\n", ", line 1: expected 3 numbers, found '1,5'"},
                      {triangle + "vn 1 0\n", ", line 4: expected 3 numbers, found the end of the line"},
                      {triangle + "f 1 2 0\n", ", line 4: expected the number of a vertex, found '0'"},
                      {triangle + "f 1 2 x\n", ", line 4: expected the number of a vertex, found 'x'"},
                      {triangle + "f 1 2 3.0\n", ", line 4: expected the number of a vertex, found '3.0'"},
                      {triangle + "f 1 2 -4\n", ", line 4: expected the number of a vertex, found '-4'"},
                      {triangle + "f 1 2 -9223372036854775808\n",
                       ", line 4: expected the number of a vertex, found '-9223372036854775808'"},
                      {triangle + "f 1 2 99999999999\n",
                       ", line 4: expected the number of a vertex, found '99999999999'"},
                      {triangle + "f 1 2 3\nf 1 2 4\n",
                       ", line 5: expected an index up to 3, the number of vertices, found 4"},
                      {triangle + two_normals + "f 1//1 2//2 3//-3\n",
                       ", line 6: expected the number of a normal, found '3//-3'"},
                      {triangle + two_normals + "f 1//1 2//2 3//x\n",
                       ", line 6: expected the number of a normal, found '3//x'"},
                      {triangle + "\\\n\nf 1 \\\n 2 \\\n 7\n",
                       ", line 6: expected an index up to 3, the number of vertices, found 7"},
                      {"# nothing\n", ", line 2: expected lines 'v x y z', found the end of the file"},
                  });
}

}  // namespace
}  // namespace relievo
