// Tests the buffer views of glTF that KHR_meshopt_compression and EXT_meshopt_compression compress. The
// compressed data are examples of the specification, hand-made streams, and the output of an encoder that
// does not depend on the decoder.
#include "io/gltf/meshopt.h"

#include <deque>
#include <random>

#include "support/format_samples.h"
#include "support/meshopt_encoder.h"
#include "support/read_text.h"

namespace relievo {
namespace {

using namespace io;

std::vector<std::uint32_t> numbers_of(const std::optional<std::vector<std::byte>>& bytes) {
  if (!bytes) return {0xBAD};
  std::vector<std::uint32_t> numbers(bytes->size() / 4);
  std::memcpy(numbers.data(), bytes->data(), 4 * numbers.size());
  return numbers;
}

TEST(Meshopt, RefusesLayoutsThatAreNotAllowed) {
  const std::string stream = compressed_attributes(std::string(64, '\1'), 4);
  EXPECT_TRUE(decode_meshopt(stream, {.count = 16, .stride = 4}));
  for (const std::size_t stride : {0U, 2U, 6U, 260U})
    EXPECT_FALSE(decode_meshopt(stream, {.count = 16, .stride = stride}));
  EXPECT_FALSE(decode_meshopt("", {.count = 16, .stride = 4}));
  EXPECT_FALSE(decode_meshopt('\xA1' + stream.substr(1), {.count = 16, .stride = 4}));
  EXPECT_FALSE(decode_meshopt(stream, {MeshoptMode::triangles, MeshoptFilter::none, 3, 4}));
  EXPECT_FALSE(decode_meshopt(stream, {MeshoptMode::indices, MeshoptFilter::none, 3, 3}));
  EXPECT_FALSE(decode_meshopt(stream, {MeshoptMode::attributes, MeshoptFilter::octahedral, 4, 16}));
  EXPECT_FALSE(meshopt_mode("POINTS") || meshopt_filter("QUATERNION"));
}

// Returns a stream of triangles with the given codes and data. Entry 0 of its table means two new corners.
// Entry 1 means the last vertex and a new corner.
std::string triangle_stream(const std::string& codes, const std::string& data) {
  return "\xE1" + codes + data + bytes_of({0x00, 0x10}) + std::string(14, '\0');
}

TEST(Meshopt, DecodesEveryKindOfTriangle) {
  const std::string codes = bytes_of({
      0xF0,  // three new corners, 0 1 2; its edges, the newest first, are 0 2, 2 1, 1 0
      0x00,  // the newest edge, 0 2, and a new corner, 3
      0x10,  // the second newest edge, 3 2, and a new corner, 4
      0x02,  // the newest edge, 3 4, and vertex 2, the third newest after 4 and 3
      0x0E,  // the newest edge, 3 2, and vertex 1: the last explicit index, 0, plus 1
      0x0D,  // the newest edge, 3 1, and vertex 0: the last explicit index, 1, minus 1
      0x0F,  // the newest edge, 3 0, and vertex 10: the last explicit index, 0, plus 10
      0xF1,  // a new corner, 5, the last vertex, 10, and a new corner, 6
      0xFF,  // three explicit indices: the last one minus 3, then plus 2, then plus 300
      0xFE,  // a new corner, 7, the newest vertex, 309, and an explicit index, 308
      0xFE,  // the triangles start again with 0 1 2
  });
  const std::string data = bytes_of({20, 0xFF, 5, 4, 0xD8, 0x04, 0x1F, 1, 0x00});
  const MeshoptLayout layout{MeshoptMode::triangles, MeshoptFilter::none, 33, 4};
  const std::vector<std::uint32_t> expected = {0, 1, 2, 0,  2, 3,  3, 2, 4, 3,   4, 2,   3,   2, 1, 3, 1,
                                               0, 3, 0, 10, 5, 10, 6, 7, 9, 309, 7, 309, 308, 0, 1, 2};
  EXPECT_EQ(numbers_of(decode_meshopt(triangle_stream(codes, data), layout)), expected);
  EXPECT_FALSE(decode_meshopt(triangle_stream(codes, data + '\0'), layout));
  EXPECT_FALSE(decode_meshopt(triangle_stream(codes, data.substr(0, data.size() - 1)), layout));
  EXPECT_FALSE(
      decode_meshopt(triangle_stream(codes, data), {MeshoptMode::triangles, MeshoptFilter::none, 32, 4}));
  const auto small =
      decode_meshopt(triangle_stream("\xF0", ""), {MeshoptMode::triangles, MeshoptFilter::none, 3, 2});
  EXPECT_EQ(text_of(small), bytes_of({0, 0, 1, 0, 2, 0}));
}

// Decodes triangles as the specification describes it, but with lists instead of ring buffers. Makes up the
// data that the codes need.
class TriangleModel {
 public:
  TriangleModel(const std::string& table, std::mt19937& random) : table_(table), random_(random) {}

  void add(unsigned code) {
    const unsigned high = code >> 4, low = code & 15;
    high < 15 ? add_at_edge(edges_[high], low) : add_corners(low);
  }

  std::vector<std::uint32_t> corners;
  std::string data;

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  std::uint32_t invented_index() {
    const auto number = static_cast<std::uint32_t>(random_() % 300);
    data += number < 128 ? bytes_of({static_cast<int>(number)})
                         : bytes_of({static_cast<int>(number & 127) | 128, static_cast<int>(number >> 7)});
    return last_ += number % 2 == 0 ? number / 2 : ~(number / 2);
  }

  void add_at_edge(Edge edge, unsigned low) {
    std::uint32_t c = 0;
    if (low == 0) c = next_++;
    if (low > 0 && low < 13) c = vertices_[low];
    if (low == 13) c = --last_;
    if (low == 14) c = ++last_;
    if (low == 15) c = invented_index();
    if (low == 0 || low > 12) vertices_.push_front(c);
    edges_.push_front({c, edge.second});
    edges_.push_front({edge.first, c});
    corners.insert(corners.end(), {edge.first, edge.second, c});
  }

  void add_corners(unsigned low) {
    auto pair = static_cast<unsigned char>(low < 14 ? table_[low] : static_cast<char>(random_()));
    if (low >= 14) {
      if (random_() % 4 == 0) pair = 0;
      data += static_cast<char>(pair);
      if (pair == 0) next_ = 0;
    }
    const std::array<unsigned, 3> kinds = {low == 15 ? 15U : 0U, pair / 16U, pair % 16U};
    std::array<std::uint32_t, 3> t{};
    for (std::size_t i = 0; i < 3; ++i)
      t[i] = kinds[i] == 0 ? next_++ : kinds[i] < 15 ? vertices_[kinds[i] - 1] : invented_index();
    for (std::size_t i = 0; i < 3; ++i)
      if (kinds[i] == 0 || kinds[i] == 15) vertices_.push_front(t[i]);
    edges_.insert(edges_.begin(), {{t[0], t[2]}, {t[2], t[1]}, {t[1], t[0]}});
    corners.insert(corners.end(), t.begin(), t.end());
  }

  const std::string& table_;
  std::mt19937& random_;
  std::uint32_t next_ = 0, last_ = 0;
  std::deque<std::uint32_t> vertices_ = std::deque<std::uint32_t>(16);
  std::deque<Edge> edges_ = std::deque<Edge>(16);
};

TEST(Meshopt, DecodesRandomTrianglesAsAModelDoes) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    std::string codes, table;
    for (int i = 0; i < 14; ++i) table += bytes_of({static_cast<int>(random() % 15 * 16 + random() % 15)});
    TriangleModel model(table, random);
    for (int i = 0; i < 40; ++i) {
      codes += static_cast<char>(random() % 3 == 0 ? 0xF0 | random() % 16 : random());
      model.add(static_cast<unsigned char>(codes.back()));
    }
    const MeshoptLayout layout{MeshoptMode::triangles, MeshoptFilter::none, 120, 4};
    const std::string stream = "\xE1" + codes + model.data + table + std::string(2, '\0');
    ASSERT_EQ(numbers_of(decode_meshopt(stream, layout)), model.corners) << round;
  }
}

TEST(Meshopt, DecodesIndicesOfTwoSeries) {
  // Each index is stored as the difference from the last index of its series. The differences are 5
  // and -3 in the first series, 1000 and 1 in the second.
  const std::string stream =
      "\xD1" + bytes_of({5 << 2, 1000 * 4 % 128 + 1 + 128, 1000 * 4 / 128, 2 << 2 | 2, 1 << 2 | 1}) +
      std::string(4, '\0');
  const MeshoptLayout layout{MeshoptMode::indices, MeshoptFilter::none, 4, 4};
  EXPECT_EQ(numbers_of(decode_meshopt(stream, layout)), (std::vector<std::uint32_t>{5, 1000, 2, 1001}));
  EXPECT_FALSE(decode_meshopt(stream, {MeshoptMode::indices, MeshoptFilter::none, 3, 4}));
  EXPECT_FALSE(decode_meshopt(stream, {MeshoptMode::indices, MeshoptFilter::none, 5, 4}));
}

// Compresses the elements, decodes them and applies the filter. Returns the result.
std::optional<std::vector<std::byte>> filtered(MeshoptFilter filter, const std::string& elements,
                                               std::size_t stride) {
  return decode_meshopt(compressed_attributes(elements, stride),
                        {MeshoptMode::attributes, filter, elements.size() / stride, stride});
}

TEST(Meshopt, UnfoldsTheOctahedron) {
  // The directions are +x, -y, halfway between +x and +y, and -z, which is at the corners of the folded
  // square. 127 means 1; with fewer bits, 15 means 1.
  const std::string folded = bytes_of({127, 0, 127, 7, 0, -15, 15, 8, 64, 63, 127, 9, 15, 15, 15, 1});
  EXPECT_EQ(text_of(filtered(MeshoptFilter::octahedral, folded, 4)),
            bytes_of({127, 0, 0, 7, 0, -127, 0, 8, 91, 89, 0, 9, 0, 0, -127, 1}));
  const std::string wide = raw(std::array<std::int16_t, 4>{0, 0, 511, 5});
  EXPECT_EQ(text_of(filtered(MeshoptFilter::octahedral, wide, 8)), bytes_of({0, 0, 0, 0, 0xFF, 0x7F, 5, 0}));
  EXPECT_FALSE(filtered(MeshoptFilter::octahedral, std::string(4, '\0'), 4));
}

TEST(Meshopt, ExpandsExponents) {
  std::string packed, expected;
  for (const auto& [exponent, mantissa] :
       {std::pair{0, 5}, {-3, 13}, {2, -7}, {-100, 1}, {-1, -(1 << 23)}, {10, 0}}) {
    packed += bytes_of({mantissa, mantissa >> 8, mantissa >> 16, exponent});
    expected += raw(static_cast<float>(std::ldexp(mantissa, exponent)));
  }
  EXPECT_EQ(text_of(filtered(MeshoptFilter::exponential, packed, 4)), expected);
}

TEST(Meshopt, MixesColours) {
  // The colours are white, red and a half opaque grey of 8 bits, then white of 4 bits, and blue of 16 bits.
  const std::string stored = bytes_of({255, 0, 0, 255, 64, 127, -64, 255, 128, 0, 0, 128 | 64});
  EXPECT_EQ(text_of(filtered(MeshoptFilter::colour, stored, 4)),
            bytes_of({255, 255, 255, 255, 255, 0, 1, 255, 128, 128, 128, 128}));
  EXPECT_EQ(text_of(filtered(MeshoptFilter::colour, bytes_of({15, 0, 0, 8 | 7}), 4)),
            bytes_of({255, 255, 255, 255}));
  const std::string wide = raw(std::array<std::uint16_t, 4>{16384, 0, 16384, 65535});
  EXPECT_EQ(text_of(filtered(MeshoptFilter::colour, wide, 8)), bytes_of({0, 0, 0, 128, 0, 0, 255, 255}));
  EXPECT_FALSE(filtered(MeshoptFilter::colour, std::string(4, '\0'), 4));
}

// The decoder must refuse the bytes or return as many bytes as the layout states.
TEST(Meshopt, SurvivesAnyBytes) {
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    std::string stream = bytes_of({std::array{0xA0, 0xA1, 0xE1, 0xD1}[random() % 4]});
    for (std::size_t size = random() % 120; stream.size() < size + 1;)
      stream += static_cast<char>(random() & random());
    const MeshoptLayout layout{static_cast<MeshoptMode>(random() % 3),
                               static_cast<MeshoptFilter>(random() % 4), random() % 70, random() % 20};
    const auto decoded = decode_meshopt(stream, layout);
    EXPECT_TRUE(!decoded || decoded->size() == layout.count * layout.stride);
  }
}

// A compressed view of a glTF file, as the file's JSON describes it.
struct TestView {
  std::string bytes, mode;
  std::size_t count = 0, stride = 0;
};

std::string json_of(const TestView& view, std::size_t offset, const std::string& extension) {
  const auto number = [](const char* name, std::size_t value) {
    return "\"" + std::string(name) + "\":" + std::to_string(value) + ",";
  };
  return "{" + number("buffer", 1) + number("byteLength", view.count * view.stride) +
         (view.stride == 8 ? number("byteStride", 8) : "") + R"("extensions":{")" + extension + R"(":{)" +
         number("buffer", 0) + number("byteOffset", offset) + number("byteLength", view.bytes.size()) +
         number("byteStride", view.stride) + number("count", view.count) + R"("mode":")" + view.mode +
         "\"}}}";
}

// Returns the corners of the tetrahedron in thousandths, each as four 16-bit numbers.
TestView compressed_corners() {
  std::string positions;
  for (const Vec3& point : tetrahedron_points) {
    for (const double coordinate : point) {
      const int number = static_cast<int>(1000 * coordinate);
      positions += bytes_of({number, number >> 8});
    }
    positions += bytes_of({0, 0});
  }
  return {compressed_attributes(positions, 8), "ATTRIBUTES", tetrahedron_points.size(), 8};
}

// Returns the triangles of the tetrahedron, encoded with explicit indices only.
TestView compressed_triangles() {
  std::string data;
  int last = 0;
  for (const Triangle& triangle : tetrahedron_triangles) {
    data += '\xFF';
    for (const std::uint32_t corner : triangle) {
      data += zigzag(static_cast<int>(corner) - last);
      last = static_cast<int>(corner);
    }
  }
  const std::size_t triangles = tetrahedron_triangles.size();
  return {triangle_stream(std::string(triangles, '\xFF'), data), "TRIANGLES", 3 * triangles, 4};
}

// Returns the tetrahedron in a GLB whose second buffer has no data.
std::string compressed_glb(const std::string& mode, const std::string& extension) {
  const TestView corners = compressed_corners();
  TestView triangles = compressed_triangles();
  triangles.mode = mode;
  const std::string bytes = corners.bytes + triangles.bytes;
  const std::string json =
      R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization",")" + extension +
      R"("],)"
      R"("buffers":[{"byteLength":)" +
      std::to_string(bytes.size()) + R"(},{"byteLength":9999}],"bufferViews":[)" +
      json_of(corners, 0, extension) + "," + json_of(triangles, corners.bytes.size(), extension) +
      R"(],"accessors":[{"bufferView":0,"componentType":5122,"count":4,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5125,"count":12,"type":"SCALAR"}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
      R"("nodes":[{"mesh":0,"scale":[0.001,0.001,0.001]}],"scenes":[{"nodes":[0]}]})";
  return glb_of(json, bytes);
}

TEST(Meshopt, IsReadWithoutTheBufferThatItStandsFor) {
  for (const std::string extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const auto file = file_of(compressed_glb("TRIANGLES", extension), "a.glb");
    EXPECT_EQ(file.mesh.triangles, tetrahedron_triangles);
    ASSERT_EQ(file.mesh.points.size(), tetrahedron_points.size());
    for (std::size_t i = 0; i < tetrahedron_points.size(); ++i)
      EXPECT_LE((file.mesh.points[i] - tetrahedron_points[i]).norm(), 1e-12);
  }
  for (const char* const mode : {"INDICES", "ATTRIBUTES", "OTHERS"}) {
    const std::string message = message_of(compressed_glb(mode, "KHR_meshopt_compression"), "a.glb");
    EXPECT_TRUE(
        message.starts_with(cat("a.glb, mesh 0, accessor 1: expected a bufferView that is compressed as its "
                                "extension says, mode \"",
                                mode, "\", ")))
        << message;
    EXPECT_TRUE(message.ends_with(" bytes that are not")) << message;
  }
}

}  // namespace
}  // namespace relievo
