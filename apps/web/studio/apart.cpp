#include "web/studio/apart.h"

#include <cstring>
#include <nlohmann/json.hpp>

#include "common/files.h"
#include "studio/requests.h"

namespace relievo::app::web {
namespace {

using Json = nlohmann::json;
using studio::Answer;

constexpr std::size_t alignment = 8;

std::size_t aligned(std::size_t size) {
  return (size + alignment - 1) / alignment * alignment;
}

// Writes arrays into bytes, each preceded by its number of elements.
class ArrayWriter {
 public:
  template <typename T>
  void add(std::span<const T> values) {
    const std::uint64_t count = values.size();
    append(&count, sizeof count);
    append(values.data(), values.size_bytes());
  }
  template <typename T>
  void add(const std::vector<T>& values) {
    add(std::span(values));
  }

  std::string bytes;

 private:
  void append(const void* data, std::size_t size) {
    if (size > 0) bytes.append(static_cast<const char*>(data), size);
    bytes.resize(aligned(bytes.size()));
  }
};

// Reads back the arrays of an ArrayWriter in the same order. They are valid as long as the bytes.
class ArrayReader {
 public:
  explicit ArrayReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <typename T>
  std::span<const T> next() {
    std::uint64_t count = 0;
    std::memcpy(&count, take(sizeof count), sizeof count);
    const auto size = static_cast<std::size_t>(count);
    return {reinterpret_cast<const T*>(take(size * sizeof(T))), size};
  }
  template <typename T>
  void read(std::vector<T>& values) {
    const std::span<const T> all = next<T>();
    values.assign(all.begin(), all.end());
  }

 private:
  const std::byte* take(std::size_t size) {
    const std::byte* const first = rest_.data();
    rest_ = rest_.subspan(aligned(size));
    return first;
  }

  std::span<const std::byte> rest_;
};

// The numbers of a frame. In the bytes they precede the frame's arrays.
struct Head {
  RenderOptions lengths;  // only mm_per_unit, margin_mm and thickness_mm
  float stretch = 1;
  std::array<float, 2> range = {};
  bool has_surface = false, has_frame = false;
};

void add_surface(const Surface& surface, ArrayWriter& to) {
  to.add(surface.points);
  to.add(surface.normals);
  to.add(surface.triangulation.triangles);
  to.add(surface.triangulation.hull);
  to.add(surface.boundary.is_inside);
}

std::shared_ptr<const Surface> read_surface(ArrayReader& from) {
  const auto surface = std::make_shared<Surface>();
  from.read(surface->points);
  from.read(surface->normals);
  from.read(surface->triangulation.triangles);
  from.read(surface->triangulation.hull);
  from.read(surface->boundary.is_inside);
  return surface;
}

// The surface and the frame that the other instance received last.
struct Sent {
  std::weak_ptr<const ReliefModel> model;
  std::size_t frame = 0;
};

std::string packed(const studio::UndrawnFrame& undrawn, const Sent& sent) {
  const auto& [model, number, shown, render] = undrawn;
  const bool has_surface = sent.model.lock() != model, has_frame = has_surface || sent.frame != number;
  const Head head{render, shown.stretch, *shown.range, has_surface, has_frame};
  ArrayWriter all;
  all.add(std::span<const Head>(&head, 1));
  if (has_surface) add_surface(model->surface(), all);
  if (has_frame) {
    all.add(shown.heights);
    all.add(shown.normals);
  }
  return std::move(all.bytes);
}

// The surface whose frames this instance draws, and the frame that it received last.
struct Received {
  std::optional<FrameRenderer> renderer;
  std::vector<float> heights;
  std::vector<Vec3f> normals;

  void take(const Head& head, ArrayReader& arrays) {
    if (head.has_surface) {
      renderer.reset();
      renderer.emplace(read_surface(arrays));
    }
    if (!head.has_frame) return;
    arrays.read(heights);
    arrays.read(normals);
  }
};

}  // namespace

Answer undrawn_frame(studio::Engine& engine, const Json& json) {
  static Sent sent;
  Result<studio::PictureRequest> request = studio::picture_request(json);
  if (!request) return studio::answer_of(request.error());
  request->is_drawn_apart = !request->turned;  // turned reliefs have another surface in each view
  const Result<studio::PictureAnswer> made = engine.picture(*std::move(request));
  if (!made) return studio::answer_of(made.error());
  Json facts = studio::to_json(*made);
  if (!made->undrawn) return studio::answer_of(made->picture, facts);
  facts["is_undrawn"] = true;
  Answer answer = studio::answer_of(Picture(), facts);
  answer.body = packed(*made->undrawn, sent);
  sent = {made->undrawn->model, made->undrawn->number};
  return answer;
}

Result<Answer> draw(const Json& json) {
  static Received received;
  RELIEVO_TRY(const studio::PictureRequest request, studio::picture_request(json));
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file("frame"));
  ArrayReader arrays(bytes);
  const Head& head = arrays.next<Head>().front();
  received.take(head, arrays);
  RenderOptions render = request.render;
  render.mm_per_unit = head.lengths.mm_per_unit;
  render.margin_mm = head.lengths.margin_mm;
  render.thickness_mm = head.lengths.thickness_mm;
  Picture picture;
  received.renderer->render({received.heights, received.normals, head.stretch, head.range}, render, picture);
  return studio::answer_of(picture, {{"width", picture.image.width},
                                     {"height", picture.image.height},
                                     {"pixels_per_mm", picture.pixels_per_mm}});
}

}  // namespace relievo::app::web
