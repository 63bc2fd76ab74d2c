// Tests the XML document in 3MF files. tests/cli/archive_test.cpp tests whole 3MF files, which are archives.
#include <Eigen/Geometry>

#include "support/format_samples.h"
#include "support/read_text.h"

namespace relievo {
namespace {

std::string tetrahedron_mesh() {
  std::string mesh = "<mesh><vertices>";
  for (const Vec3& p : tetrahedron_points)
    mesh += cat(R"(<vertex x=")", p.x(), R"(" y=")", p.y(), R"(" z=")", p.z(), R"("/>)");
  mesh += "</vertices><triangles>";
  for (const Triangle& t : tetrahedron_triangles)
    mesh += cat(R"(<triangle v1=")", t[0], R"(" v2=")", t[1], R"(" v3=")", t[2], R"("/>)");
  return mesh + "</triangles></mesh>";
}

std::string object(const std::string& attributes, const std::string& content) {
  return "<object " + attributes + ">" + content + "</object>";
}

std::string model(const std::string& objects, const std::string& items) {
  return "<?xml version=\"1.0\"?>\n<model unit=\"millimeter\" "
         "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>" +
         objects + "</resources><build>" + items + "</build></model>";
}

const std::string mesh_object = object("id=\"1\" type=\"model\"", tetrahedron_mesh());

TEST(ThreeMf, AnItemIsTheMesh) {
  const auto file = file_of(model(mesh_object, "<item objectid=\"1\"/>"), "scan");
  EXPECT_EQ(file.format, "3MF");
  EXPECT_EQ(file.mesh.points, tetrahedron_points);
  EXPECT_EQ(file.mesh.triangles, tetrahedron_triangles);
}

// The first triangle has a colour at each corner. The second triangle has the colour of a material. The
// others have the object's colour.
TEST(ThreeMf, VerticesHaveTheColoursOfTheirFirstCorners) {
  std::string mesh = tetrahedron_mesh();
  mesh = replaced(mesh, "v1=\"0\" v2=\"2\" v3=\"1\"",
                  "v1=\"0\" v2=\"2\" v3=\"1\" pid=\"8\" p1=\"1\" p2=\"0\" p3=\"7\"");
  mesh = replaced(mesh, "v1=\"0\" v2=\"1\" v3=\"3\"", "v1=\"0\" v2=\"1\" v3=\"3\" pid=\"9\" p1=\"0\"");
  const std::string resources =
      "<m:colorgroup id=\"8\"><m:color color=\"#010203\"/><m:color color=\"#fF000080\"/></m:colorgroup>"
      "<basematerials id=\"9\"><base name=\"a\" displaycolor=\"#00FF00\"/><base "
      "displaycolor=\"blue\"/></basematerials>";
  const auto colours_in = [&](const std::string& attributes, const std::string& item) {
    return file_of(model(resources + object("id=\"1\" " + attributes, mesh), item), "a.model").cloud.colours;
  };
  const Colour red = {255, 0, 0}, dark = {1, 2, 3}, green = {0, 255, 0}, white = {255, 255, 255};
  const std::string item = "<item objectid=\"1\"/>";
  EXPECT_EQ(colours_in("", item), (std::vector<Colour>{red, green, dark, green}));
  EXPECT_EQ(colours_in("pid=\"9\" pindex=\"1\"", item), (std::vector<Colour>{red, green, dark, green}));
  EXPECT_EQ(colours_in("", "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>"),
            (std::vector<Colour>{red, green, dark, green}));
  mesh = tetrahedron_mesh();
  EXPECT_EQ(colours_in("pid=\"9\" pindex=\"1\"", item), std::vector<Colour>(4, white)) << "no number";
  EXPECT_EQ(colours_in("pid=\"8\" pindex=\"1\"", item + item), std::vector<Colour>(8, red));
  EXPECT_TRUE(colours_in("pid=\"7\" pindex=\"1\"", item).empty());
}

// The component doubles the size of its object and moves it by (1, 2, 3). The item then exchanges x and
// y, which mirrors the object.
TEST(ThreeMf, ItemsAndComponentsAreTransformed) {
  const std::string group =
      object("id=\"2\"",
             "<components><component objectid=\"1\" transform=\"2 0 0 0 2 0 0 0 2 1 2 3\"/></components>");
  const auto file =
      file_of(model(mesh_object + group,
                    "<item objectid=\"2\" transform=\"0 1 0 1 0 0 0 0 1 0 0 0\"/><item objectid=\"1\"/>"),
              "a.model");
  ASSERT_EQ(file.mesh.points.size(), 8U);
  EXPECT_EQ(file.mesh.triangles.size(), 8U);
  std::size_t found = 0;
  for (const Vec3& p : tetrahedron_points)
    found += std::ranges::count(file.mesh.points, Vec3(2 * p.y() + 2, 2 * p.x() + 1, 2 * p.z() + 3)) == 1;
  EXPECT_EQ(found, 4U);
  double volume = 0;
  for (const Triangle& t : file.mesh.triangles)
    volume += file.mesh.points[t[0]].dot(file.mesh.points[t[1]].cross(file.mesh.points[t[2]])) / 6;
  EXPECT_NEAR(volume, (8 + 1) / 6., 1e-12) << "a mirrored mesh must not be inside out";
}

TEST(ThreeMf, ComponentsMayBeInOtherParts) {
  const std::string text =
      model(object("id=\"2\"",
                   "<components><component p:path=\"/3D/Objects/a.model\" objectid=\"1\"/></components>"),
            "<item objectid=\"2\"/>");
  const auto file = value_of(read_cloud(bytes_of(text), "3dmodel.model",
                                        files_beside({{"Objects/a.model", model(mesh_object, "")}})));
  EXPECT_EQ(file.mesh.triangles, tetrahedron_triangles);
  const std::string missing = ", element component: expected a part of the archive, found ";
  expect_messages("a.model", {{text, missing + "'/3D/Objects/a.model'"},
                              {replaced(text, "/3D/Objects", "/3D/.."), missing + "'/3D/../a.model'"}});
}

TEST(ThreeMf, SupportsAreLeftOut) {
  const auto file = file_of(model(mesh_object + object("id=\"2\" type=\"support\"", tetrahedron_mesh()),
                                  "<item objectid=\"1\"/><item objectid=\"2\"/>"),
                            "a.model");
  EXPECT_EQ(file.mesh.triangles.size(), 4U);
  EXPECT_EQ(file.remarks[0], "left out 1 objects that only support others while printing");
}

TEST(ThreeMf, TooManyObjectsAreRefused) {
  std::string items;
  for (int i = 0; i < 100001; ++i) items += "<item objectid=\"1\"/>";
  EXPECT_EQ(message_of(model(mesh_object, items), "a.model"),
            "a.model, element item: expected at most 100000 objects, found more");
}

TEST(ThreeMf, BrokenDocumentsAreNamed) {
  const std::string good = model(mesh_object, "<item objectid=\"1\"/>");
  const std::string ring = object("id=\"1\"", "<components><component objectid=\"1\"/></components>");
  expect_messages(
      "a.model",
      {{"<model></model>", ", element model: expected an element build, found none"},
       {replaced(good, "objectid=\"1\"", "objectid=\"9\""),
        ", element item: expected the id of an object, found '9'"},
       {replaced(good, "objectid=\"1\"", "objectid=\"1\" transform=\"1 2\""),
        ", element item: expected 12 numbers as transform, found '1 2'"},
       {replaced(good, "v1=\"1\"", "v1=\"4\""),
        ", element triangle: expected numbers of vertices below 4, found '4'"},
       {replaced(good, "v1=\"1\"", "v1=\"-1\""),
        ", element triangle: expected numbers of vertices below 4, found '-1'"},
       {replaced(good, "<vertex x=\"1\"", "<vertex x=\"one\""),
        ", element vertex: expected numbers x, y and z, found ' x=\"one\" y=\"0\" z=\"0\"'"},
       {replaced(replaced(good, "<triangles>", "<others>"), "</triangles>", "</others>"),
        ", element mesh: expected vertices and triangles, found only one of them"},
       {model(ring, "<item objectid=\"1\"/>"),
        ", element components: expected objects at most 8 levels deep, found more"},
       {model(object("id=\"1\"", ""), "<item objectid=\"1\"/>"), ": expected points, found none"}});
}

}  // namespace
}  // namespace relievo
