// Tests which files a relief is made from, and that they are not overwritten.
#include "common/input_files.h"

#include "common/project_file.h"
#include "support/cli_folder.h"
#include "support/results.h"

namespace relievo {
namespace {

using namespace test;
using namespace app;

constexpr const char* drawing = R"(<svg viewBox="0 0 9 9"><path d="M0 0H9V9H0Z"/></svg>)";

class InputFiles : public CliFolder {
 protected:
  // Returns the names, relative to the test's folder, of all files that are read when the file `name` is
  // read.
  std::vector<std::string> names_read_with(const std::string& name) const {
    std::vector<std::string> names;
    for (const InputFile& file : files_read_with((folder_ / name).string()))
      names.push_back(fs::path(file.path).lexically_relative(folder_).string());
    return names;
  }
  void expect_names(const std::string& name, const std::vector<std::string>& expected) const {
    EXPECT_EQ(names_read_with(name), expected);
  }
  void expect_kept(const std::string& arguments, const std::string& name) const {
    const std::string before = read_all(folder_ / name);
    expect_refusal(arguments, "expected different files for input and outputs");
    EXPECT_EQ(read_all(folder_ / name), before);
  }
  void write(const std::string& name, std::string_view text) const { write_all(folder_ / name, text); }
};

TEST_F(InputFiles, OfMeshesAreTheirBuffersMaterialsAndTextures) {
  write(
      "m.gltf",
      R"({"buffers": [{"uri": "m%20n.bin"}, {"uri": "data:,x"}], "images": [{"uri": "a.png"}, {"bufferView": 0}]})");
  expect_names("m.gltf", {"m.gltf", "m n.bin", "a.png"});
  const std::string json = R"({"images": [{"uri": "a.png"}]})";
  write("m.glb", std::string("glTF\2\0\0\0\0\0\0\0", 12) + static_cast<char>(json.size()) +
                     std::string("\0\0\0JSON", 7) + json + "BIN");
  expect_names("m.glb", {"m.glb", "a.png"});
  write("m.obj", "# a mesh\r\nmtllib my materials.mtl # here\r\nv 0 0 0\nusemtl a\n");
  write("my materials.mtl", "newmtl a\n  map_Kd -s 1 1 1 skin.png\nmap_Kd\nnewmtl b\nmap_Kd tex\\bark.jpg\n");
  expect_names("m.obj", {"m.obj", "my materials.mtl", "skin.png", "tex/bark.jpg"});
  EXPECT_TRUE(files_read_with((folder_ / "m.obj").string()).at(2).is_texture);
  expect_names("gone.obj", {"gone.obj"});
}

TEST_F(InputFiles, OfProjectsAreThoseOfTheirOptionsUnlessTheyArePacked) {
  write("a.svg", drawing);
  write("list.json", "\n[{\"kind\": \"drawing\", \"file\": \"a.svg\"}]");
  const std::string project =
      R"({"relievo": 1, "input": {"path": "torus.ply"}, "options": {"ornaments": "list.json"}})";
  write("p.relievo", project);
  expect_names("p.relievo", {"p.relievo", "torus.ply", "list.json", "a.svg"});
  const auto packed = value_of(
      pack_project({project, std::make_shared<const PackedFile>(PackedFile{"torus.ply", {}}), nullptr}));
  write_all(folder_ / "packed.relievo", packed);
  expect_names("packed.relievo", {"packed.relievo", "list.json", "a.svg"});
}

TEST_F(InputFiles, OfOptionsAreListsOfOrnamentsWithTheirFiles) {
  write("a.svg", drawing);
  write("list.json", R"({"ornaments": [{"kind": "drawing", "file": "a.svg"}]})");
  const std::string folder = folder_.string(), file = (folder_ / "a.svg").string(),
                    list = (folder_ / "list.json").string();
  EXPECT_EQ(files_in_option("ornaments", list), (std::vector{list, file}));
  EXPECT_EQ(files_in_option("ornaments", "list.json", folder), (std::vector{list, file}));
  EXPECT_EQ(files_in_option("ornaments", R"([{"file": "a.svg"}])", folder), std::vector{file});
  EXPECT_EQ(files_in_option("width", list), std::vector<std::string>());
}

TEST_F(InputFiles, AreNeverOverwritten) {
  write("s.json", R"({"models": [{"file": "torus.ply"}]})");
  write("p.relievo", R"({"relievo": 1, "input": {"path": "torus.ply"}, "options": {}})");
  write("strokes.json", "[]");
  write("l2.png", drawing);
  write("list.json", R"([{"kind": "drawing", "file": "l2.png"}])");
  write("m.obj", "mtllib m.mtl\nv 0 0 0\n");
  write("m.mtl", "newmtl a\n");
  write("camera.txt", "500,500,320,240");
  expect_kept("make s.json -o torus.ply", "torus.ply");
  expect_kept("make p.relievo -o torus.ply", "torus.ply");
  expect_kept("make torus.ply -o t.stl --strokes strokes.json --report strokes.json", "strokes.json");
  expect_kept("make torus.ply -o t.stl --ornaments list.json --preview l2.png", "l2.png");
  expect_kept("make m.obj -o t.stl --report m.mtl", "m.mtl");
  expect_kept("make torus.ply -o t.stl --camera camera.txt --report camera.txt", "camera.txt");
}

}  // namespace
}  // namespace relievo
