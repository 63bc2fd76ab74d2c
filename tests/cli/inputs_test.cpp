// Tests inputs on a disk: buffers beside a glTF file, meshes that are read in parts, and names with control characters.
#include "common/files.h"
#include "common/read_inputs.h"
#include "relievo/core/text.h"
#include "support/cli_folder.h"
#include "support/format_samples.h"

namespace relievo {
namespace {

using namespace test;

class CliInputs : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    fs::create_directory(folder_ / "scans");
    write_all(folder_ / "scans/four corners.bin", gltf_buffer());
    write_all(folder_ / "scans/a.gltf", gltf_json(R"("uri":"four%20corners.bin",)"));
  }
};

TEST_F(CliInputs, ReadsTheBuffersBesideAGltf) {
  EXPECT_EQ(line_of(run("info scans/a.gltf").out, "triangles"), "4");
  must_run("make scans/a.gltf -o a.stl --view -1,-1,-1 --height 2 --points 2000");
  write_all(folder_ / "s.json", R"({"models": [{"file": "scans/a.gltf"}, {"file": "torus.ply"}]})");
  EXPECT_EQ(line_of(run("info s.json").out, "models"), "2");
  must_run("make s.json -o s.stl --view -1,-1,-1 --height 2 --points 2000");
  fs::remove(folder_ / "scans/four corners.bin");
  expect_refusal("make scans/a.gltf -o b.stl",
                 "a.gltf, buffer 0: expected the file 'four corners.bin' beside it");
}

TEST_F(CliInputs, ReadsNoFileOutsideTheFolderOfAGltf) {
  fs::rename(folder_ / "scans/four corners.bin", folder_ / "b.bin");
  write_all(folder_ / "scans/a.gltf", gltf_json(R"("uri":"../b.bin",)"));
  expect_refusal("info scans/a.gltf", "expected a file in the same folder, found '../b.bin'");
}

// The triangles use three of the five points. Of the unused points, one is not finite and one is far away.
TEST_F(CliInputs, TellsTheSizeOfTheSurface) {
  write_all(folder_ / "a.obj",
            "v 0 0 0\nv 2 0 0\nv 0 3 0\nv nan 0 0\nv 0 0 1e30\nvn 0 0 1\nvn 0 0 -1\n"
            "f 1//1 2//1 3//1\nf 3//2 2//1 1//2\n");
  const Outcome told = run("info a.obj");
  EXPECT_EQ(line_of(told.out, "points"), "4 (and 1 not finite)");
  EXPECT_EQ(line_of(told.out, "size"), "2, 3, 0");
  write_all(folder_ / "s.json", R"({"models": [{"file": "a.obj", "translate": [0, 0, 50]}]})");
  EXPECT_EQ(line_of(run("info s.json").out, "from"), "0, 0, 50");
}

// A small ball beside a button is left out, and so is noise. The remark about each names the option that keeps it.
TEST_F(CliInputs, SaysHowToKeepWhatIsLeftOut) {
  const Cloud crumb = moved(sphere(200, .03), {1.6, 0, 0});
  write_all(folder_ / "button.ply", write_ply(joined(button(40000, 1, .15), crumb)));
  const std::string crumbs =
      "left out 1 small piece of the surface; --crumbs keep leaves in all but single specks";
  EXPECT_TRUE(run("make button.ply -o t.stl --resolution 1").err.contains(crumbs));
  EXPECT_FALSE(run("make button.ply -o t.stl --resolution 1 --crumbs keep").err.contains("small piece"));
  write_all(folder_ / "noisy.ply", write_ply(noisy(torus(20000, 1, .4), .01, .2)));
  const Outcome smooth = run("make noisy.ply -o t.stl --resolution 1 --height 2");
  EXPECT_TRUE(smooth.err.contains("removed noise of ")) << smooth.err;
  EXPECT_NE(smooth.err.find(" sampling distances; --denoise 0 keeps it"), std::string::npos) << smooth.err;
  EXPECT_FALSE(run("make noisy.ply -o t.stl --resolution 1 --height 2 --denoise 0").err.contains("noise"));
}

// Returns the file of a cloud, with a face added.
std::string with_face(std::string cloud) {
  cloud.insert(cloud.find("end_header\n"), "element face 1\nproperty list uchar int vertex_indices\n");
  return cloud + "\3" + raw(0) + raw(1) + raw(2);
}

TEST_F(CliInputs, SaysThatItReadsNoFacesPieceByPiece) {
  write_all(folder_ / "faces.ply", with_face(read_all(folder_ / "torus.ply")));
  const Outcome made = must_run("make faces.ply -o t.stl --stream-above 0.1");
  EXPECT_TRUE(made.err.contains("faces.ply: left out the 1 faces of the mesh")) << made.err;
  EXPECT_FALSE(run("make torus.ply -o t.stl --stream-above 0.1").err.contains("faces"));
}

// In WebAssembly, a cloud with more points than fit into memory is read in blocks. A mesh is not read in
// blocks, because only sampled points of its visible triangles are kept.
TEST_F(CliInputs, ReadsCloudsOfTooManyPointsPieceByPiece) {
  const std::string torus = (folder_ / "torus.ply").string();
  const auto remarks = [&](const std::string& path, double most_points) {
    app::InputArguments arguments;
    arguments.most_points = most_points;
    const auto scene = app::read_scene({path}, arguments, {View{}, 2000}, nullptr);
    return scene ? app::joined(app::remarks_of(*scene)) : scene.error().message();
  };
  const double points = static_cast<double>(read_cloud(app::bytes_of(read_all(torus)), torus)->cloud.size());
  EXPECT_TRUE(remarks(torus, points - 1).contains(cat("points for the ", points, " of the file")));
  EXPECT_EQ(remarks(torus, points), "");
  write_all(folder_ / "mesh.ply", with_face(read_all(torus)));
  EXPECT_FALSE(remarks((folder_ / "mesh.ply").string(), 10).contains("points for the"));
}

TEST_F(CliInputs, HintsAtAnotherViewWhereOneFaceIsSeen) {
  expect_refusal("make scans/a.gltf -o a.stl --view 1,1,1 --height 2 --points 2000",
                 "found 2 mm: this view shows a level face alone; choose another");
}

TEST_F(CliInputs, NamesTheDepthImageWithoutDepths) {
  write_all(folder_ / "black.png", write_png(Image8{20, 20, 1, std::vector<std::uint8_t>(400)}));
  expect_refusal("make torus.ply black.png -o t.stl",
                 "black.png: expected at least 16 pixels with a depth, found 0");
}

TEST_F(CliInputs, KeepsControlCharactersOffTheTerminal) {
  const auto refuse = [&](const std::string& name, const std::string& text) {
    write_all(folder_ / name, text);
    const Outcome outcome = run("make " + name + " -o t.stl");
    EXPECT_GT(outcome.exit_code, 0);
    EXPECT_EQ(std::ranges::count_if(outcome.err, [](unsigned char c) { return c < ' ' || c == 0x7F; }), 1)
        << "only the end of the line is a control character";
    return outcome.err;
  };
  refuse("s.json", R"({"mod\nels\u001b[31m": []})");
  refuse("s.json", R"({"models": [{"file": "a\n\u0007\u007f\u009b.ply"}]})");
  refuse("p.relievo", R"({"relievo": 1, "input": {"sample": "shell"}, "options": {"\n\r\u001b": 1}})");
  EXPECT_TRUE(refuse("s.json", R"({"models": [{"file": "grün.ply"}]})").contains("grün.ply"));
}

}  // namespace
}  // namespace relievo
