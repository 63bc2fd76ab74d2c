// Tests pictures that are textures, and the OBJ and glTF meshes that use them.
#include "io/texture.h"

#include "relievo/io/write.h"
#include "support/format_samples.h"
#include "support/read_text.h"

namespace relievo {
namespace {

// Returns the colour of pixel (x, y) of a picture of 4 x 4 pixels. All 16 colours are different.
Colour colour_at(int x, int y) {
  return {static_cast<std::uint8_t>(60 * x), static_cast<std::uint8_t>(60 * y),
          static_cast<std::uint8_t>(9 * x + y)};
}

std::string png(int channels = 3) {
  Image8 image;
  image.resize(4, 4, channels);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (int c = 0; c < channels; ++c)
        image.pixels[image.index(x, y) + static_cast<std::size_t>(c)] =
            colour_at(x, y)[static_cast<std::size_t>(c)];
  return as_string(write_png(image));
}

TEST(Texture, HasThePixelsAtTheirMiddlesAndRepeats) {
  const auto texture = value_of(io::Texture::read(png(), "a.png"));
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (const int turns : {-2, 0, 1})
        EXPECT_EQ(texture.at((x + .5) / 4 + turns, (y + .5) / 4 - turns), colour_at(x, y));
  EXPECT_EQ(texture.at(.25, .125), (Colour{30, 0, 5})) << "half way between two pixels";
  EXPECT_EQ(texture.at(0, .125), (Colour{90, 0, 14})) << "between the last column and the first";
  EXPECT_EQ(texture.at(std::nan(""), 0), Colour{});
}

TEST(Texture, GreyPicturesAreGreyAndOtherFilesNone) {
  EXPECT_EQ(io::Texture::read(png(1), "a.png")->at(.375, .125), (Colour{60, 60, 60}));
  EXPECT_FALSE(io::Texture::read("hello", "a.png"));
}

using Files = std::map<std::string, std::string>;

CloudFile read_with(const std::string& text, const std::string& name, const Files& files) {
  return value_of(read_cloud(bytes_of(text), name, files_beside(files)));
}

// The texture coordinates are the centres of three pixels: the lower left pixel, its right neighbour and its
// upper neighbour.
const std::string textured_obj =
    "mtllib my scan.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 9\nvt .125 .125\nvt .375 .125\nvt .125 .375\n"
    "usemtl skin\nf 1/1 2/2 3/-1\nusemtl plain\nf 1/2 2/2 4/3\n";
const std::string materials = "newmtl plain\nKd 1 0 0\nnewmtl skin\nmap_Kd -s 1 1 1 skin.png\n";

TEST(ObjTextures, VerticesHaveTheColoursOfTheTexture) {
  const CloudFile file = read_with(textured_obj, "a.obj", {{"my scan.mtl", materials}, {"skin.png", png()}});
  EXPECT_EQ(file.cloud.colours,
            (std::vector<Colour>{colour_at(0, 3), colour_at(1, 3), colour_at(0, 2), {255, 255, 255}}));
  EXPECT_EQ(file.mesh.colours, file.cloud.colours);
  EXPECT_TRUE(file.remarks.empty());
}

TEST(ObjTextures, WhatIsMissingIsTold) {
  const auto remark = [&](const Files& files) {
    const CloudFile file = read_with(textured_obj, "a.obj", files);
    EXPECT_FALSE(file.cloud.has_colours());
    return file.remarks.at(0);
  };
  EXPECT_EQ(remark({}), "left out its textures, as the file 'my scan.mtl' is not beside it");
  EXPECT_EQ(remark({{"my scan.mtl", materials}}), "left out the texture 'skin.png', which is not beside it");
  EXPECT_EQ(remark({{"my scan.mtl", materials}, {"skin.png", "x"}}),
            "left out the texture 'skin.png', whose format is not read; save it as PNG");
  EXPECT_EQ(remark({{"my scan.mtl", replaced(materials, "skin.png", "../skin.png")}, {"../skin.png", png()}}),
            "left out the texture '../skin.png', which is not beside it");
  EXPECT_TRUE(read_with(replaced(textured_obj, "usemtl", "g"), "a.obj", {}).remarks.empty());
}

TEST(ObjTextures, NumbersOfVerticesThatAreNotThereTakeNoMemory) {
  EXPECT_EQ(message_of("mtllib a.mtl\nusemtl a\nv 0 0 0\nf 4000000000/1 1/1 1/1\n", "a.obj"),
            "a.obj, line 4: expected an index up to 1, the number of vertices, found 4000000000");
}

// Returns the sample with texture coordinates for its four vertices, and with a material that uses a picture.
std::string textured_gltf(const std::string& of_texture, const std::string& uri) {
  std::string buffer = gltf_buffer();
  for (const float value : {.125F, .125F, .375F, .125F, .125F, .375F, .875F, .875F}) buffer += raw(value);
  std::string json = gltf_json();
  json = replaced(json, R"("POSITION":0)", R"("POSITION":0,"TEXCOORD_0":2)");
  json = replaced(json, R"("indices":1)", R"("indices":1,"material":0)");
  json = replaced(
      json, R"("count":12,"type":"SCALAR"})",
      R"("count":12,"type":"SCALAR"},{"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"})");
  json = replaced(json, R"("byteOffset":48,"byteLength":24})",
                  R"("byteOffset":48,"byteLength":24},{"buffer":0,"byteOffset":72,"byteLength":32})");
  json = replaced(json, R"("byteLength":72)", R"("byteLength":104)");
  json.insert(
      1,
      R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,1,1],"baseColorTexture":{"index":0)" +
          of_texture + R"(}}}],"textures":[{"source":0}],"images":[{"uri":")" + uri + R"("}],)");
  return glb_of(json, buffer);
}

TEST(GltfTextures, VerticesHaveTheColoursOfTheTexture) {
  const auto half_green = [](Colour colour) {
    colour[1] /= 2;
    return colour;
  };
  const CloudFile file = read_with(textured_gltf("", "skin.png"), "a.glb", {{"skin.png", png()}});
  EXPECT_EQ(file.cloud.colours,
            (std::vector<Colour>{half_green(colour_at(0, 0)), half_green(colour_at(1, 0)),
                                 half_green(colour_at(0, 1)), half_green(colour_at(3, 3))}));
  EXPECT_EQ(file.mesh.colours, file.cloud.colours);
  const CloudFile moved =
      read_with(textured_gltf(R"(,"extensions":{"KHR_texture_transform":{"offset":[0.25,0.5]}})", "skin.png"),
                "a.glb", {{"skin.png", png()}});
  EXPECT_EQ(moved.cloud.colours[0], half_green(colour_at(1, 2)));
}

TEST(GltfTextures, WhatIsMissingIsTold) {
  const CloudFile none = read_with(textured_gltf("", "skin.png"), "a.glb", {});
  EXPECT_FALSE(none.cloud.has_colours());
  EXPECT_EQ(none.remarks.at(0), "left out texture 0, which cannot be read");
  EXPECT_EQ(read_with(textured_gltf("", "skin.png"), "a.glb", {{"skin.png", "x"}}).remarks.at(0),
            "left out texture 0, whose format is not read; save it as PNG");
}

}  // namespace
}  // namespace relievo
