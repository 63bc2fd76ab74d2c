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

// Appends arrays to bytes, each after its number of elements.
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

// Returns the arrays of an ArrayWriter in their order. They are valid as long as the bytes.
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

// The numbers of a frame and of its surface.
struct Numbers {
  RenderOptions lengths;  // only mm_per_unit, margin_mm and thickness_mm
  float stretch = 1;
  std::array<float, 2> range = {};
  bool has_surface = false;
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

std::string packed(const studio::UndrawnFrame& frame, bool has_surface) {
  const Numbers numbers{frame.render, frame.shown.stretch, *frame.shown.range, has_surface};
  ArrayWriter all;
  all.add(std::span<const Numbers>(&numbers, 1));
  if (has_surface) add_surface(frame.model->surface(), all);
  all.add(frame.shown.heights);
  all.add(frame.shown.normals);
  return std::move(all.bytes);
}

}  // namespace

Answer undrawn_frame(studio::Engine& engine, const Json& json) {
  static std::weak_ptr<const ReliefModel> sent;  // the model whose surface the other instance has
  Result<studio::PictureRequest> request = studio::picture_request(json);
  if (!request) return studio::answer_of(request.error());
  request->is_drawn_apart = !request->turned;  // turned reliefs have another surface in each view
  const Result<studio::PictureAnswer> made = engine.picture(*std::move(request));
  if (!made) return studio::answer_of(made.error());
  Json facts = studio::to_json(*made);
  if (!made->undrawn) return studio::answer_of(made->picture, facts);
  facts["is_undrawn"] = true;
  Answer answer = studio::answer_of(Picture(), facts);
  answer.body = packed(*made->undrawn, sent.lock() != made->undrawn->model);
  sent = made->undrawn->model;
  return answer;
}

Result<Answer> draw(const Json& json) {
  static std::optional<FrameRenderer> renderer;  // of the surface whose frames this instance draws
  RELIEVO_TRY(const studio::PictureRequest request, studio::picture_request(json));
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file("frame"));
  ArrayReader arrays(bytes);
  const Numbers& numbers = arrays.next<Numbers>().front();
  if (numbers.has_surface) {
    renderer.reset();
    renderer.emplace(read_surface(arrays));
  }
  const auto heights = arrays.next<float>();
  const auto normals = arrays.next<Vec3f>();
  RenderOptions render = request.render;
  render.mm_per_unit = numbers.lengths.mm_per_unit;
  render.margin_mm = numbers.lengths.margin_mm;
  render.thickness_mm = numbers.lengths.thickness_mm;
  Picture picture;
  renderer->render({heights, normals, numbers.stretch, numbers.range}, render, picture);
  return studio::answer_of(picture, {{"width", picture.image.width},
                                     {"height", picture.image.height},
                                     {"pixels_per_mm", picture.pixels_per_mm}});
}

}  // namespace relievo::app::web
