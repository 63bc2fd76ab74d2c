#include <algorithm>
#include <array>

#include "io/gltf.h"
#include "io/text.h"

namespace relievo::io {
namespace {

constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

// Returns the bytes; nothing for text that is not base64.
std::optional<std::string> decode_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int held = 0;
  while (text.ends_with('=')) text.remove_suffix(1);
  for (const char c : text) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<char>(bits >> held & 0xFF));
  }
  return bytes;
}

struct ComponentType {
  std::size_t code;
  NumberType type;
  double scale;  // of normalised values
};
constexpr std::array<ComponentType, 6> component_types = {{{5120, NumberType::int8, 1 / 127.0},
                                                           {5121, NumberType::uint8, 1 / 255.0},
                                                           {5122, NumberType::int16, 1 / 32767.0},
                                                           {5123, NumberType::uint16, 1 / 65535.0},
                                                           {5125, NumberType::uint32, 1},
                                                           {5126, NumberType::float32, 1}}};

std::size_t components_of(const Json& accessor) {
  constexpr std::array<std::string_view, 4> names = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  const auto type = accessor.find("type");
  if (type == accessor.end() || !type->is_string()) return 0;
  const auto found = std::ranges::find(names, type->get_ref<const std::string&>());
  return found == names.end() ? 0 : static_cast<std::size_t>(found - names.begin()) + 1;
}

}  // namespace

std::optional<std::size_t> number_in(const Json& object, const char* name, std::size_t otherwise) {
  const auto found = object.find(name);
  if (found == object.end()) return otherwise;
  if (!found->is_number_unsigned()) return std::nullopt;
  return found->get<std::size_t>();
}

void Accessor::decode(std::vector<double>& values) const {
  const std::size_t begin = values.size();
  values.resize(begin + count * components);
  std::vector<double> column(count);
  for (std::size_t c = 0; c < components; ++c) {
    decoder(type, false)(first + c * size_in_bytes(type), stride, count, column.data());
    for (std::size_t i = 0; i < count; ++i) values[begin + i * components + c] = scale * column[i];
  }
}

const Json* GltfFile::element(std::string_view array, std::size_t i) const {
  const auto found = json_.find(std::string(array));
  if (found == json_.end() || !found->is_array() || i >= found->size()) return nullptr;
  return (*found)[i].is_object() ? &(*found)[i] : nullptr;
}

Result<void> GltfFile::split_glb(const Source& source, std::string_view& text) {
  const std::string_view bytes = source.bytes;
  if (bytes.size() < 20)
    return source.error_at_byte(bytes.size(), "expected a GLB header, found the end of the file");
  const auto number = [&](std::size_t at) { return std::size_t{little<std::uint32_t>(bytes.data() + at)}; };
  if (number(4) != 2)
    return source.error_at_byte(4, "expected version 2 of glTF, found " + std::to_string(number(4)));
  if (number(8) > bytes.size())
    return source.error_at_byte(
        8, "expected " + std::to_string(number(8)) + " bytes, found " + std::to_string(bytes.size()));
  for (std::size_t at = 12; at + 8 <= number(8); at += 8 + number(at)) {
    if (number(at) > number(8) - at - 8)
      return source.error_at_byte(at, "expected a chunk of " + std::to_string(number(at)) + " bytes, found " +
                                          std::to_string(number(8) - at - 8));
    if (number(at + 4) == json_chunk && text.empty()) text = bytes.substr(at + 8, number(at));
    if (number(at + 4) == binary_chunk && binary_.empty()) binary_ = bytes.substr(at + 8, number(at));
  }
  if (text.empty()) return source.error_at_byte(12, "expected a JSON chunk, found none");
  return {};
}

Result<void> GltfFile::take_buffers(const Source& source) {
  const auto all = json_.find("buffers");
  if (all == json_.end() || !all->is_array()) return {};
  decoded_.reserve(all->size());  // keeps views into its elements valid
  for (std::size_t i = 0; i < all->size(); ++i) {
    const std::string place = "buffer " + std::to_string(i);
    const Json* buffer = element("buffers", i);
    if (!buffer) return source.error(place, "expected an object, found something else");
    const auto uri = buffer->find("uri");
    std::string_view bytes = binary_;
    if (uri != buffer->end()) {
      if (!uri->is_string()) return source.error(place, "expected a text as uri");
      const std::string_view text = uri->get_ref<const std::string&>();
      const std::size_t data = text.find(";base64,");
      if (!text.starts_with("data:") || data == std::string_view::npos)
        return source.error(
            place, "expected a buffer inside the file, found " + in_quotes(text) + "; save it as .glb");
      auto decoded = decode_base64(text.substr(data + 8));
      if (!decoded) return source.error(place, "expected base64 text, found other characters");
      bytes = decoded_.emplace_back(std::move(*decoded));
    }
    const auto promised = number_in(*buffer, "byteLength", 0);
    if (!promised || *promised > bytes.size())
      return source.error(
          place, "expected as many bytes as its byteLength says, found " + std::to_string(bytes.size()));
    buffers_.push_back(bytes.substr(0, *promised));
  }
  return {};
}

Result<GltfFile> GltfFile::open(const Source& source) {
  GltfFile file;
  std::string_view text = source.bytes.substr(byte_order_mark_size(source.bytes));
  if (text.starts_with("glTF")) {
    text = {};
    if (const auto split = file.split_glb(source, text); !split) return std::unexpected(split.error());
  }
  file.json_ = Json::parse(text, nullptr, false);
  if (file.json_.is_discarded() || !file.json_.is_object())
    return source.error({}, "expected the JSON of a glTF file, found text that is none");
  const auto asset = file.json_.find("asset");
  if (asset == file.json_.end() || !asset->is_object())
    return source.error("asset", "expected the member asset of a glTF file, found none");
  if (const auto taken = file.take_buffers(source); !taken) return std::unexpected(taken.error());
  return file;
}

Result<Accessor> GltfFile::accessor(const Source& source, std::size_t i, const std::string& place) const {
  const auto fail = [&](std::string expected) -> std::unexpected<Error> {
    return source.error(place + ", accessor " + std::to_string(i), std::move(expected));
  };
  const Json* json = element("accessors", i);
  if (!json) return fail("expected an accessor, found none of that number");
  if (json->contains("sparse")) return fail("expected plain numbers, found a sparse accessor");
  Accessor out;
  const auto code = number_in(*json, "componentType", 0), count = number_in(*json, "count", 0),
             offset = number_in(*json, "byteOffset", 0),
             view_number = number_in(*json, "bufferView", no_index);
  if (!code || !count || !offset || !view_number) return fail("expected whole numbers, found others");
  const auto type = std::ranges::find(component_types, *code, &ComponentType::code);
  out.components = components_of(*json);
  if (type == component_types.end() || out.components == 0)
    return fail("expected a known component type, found another");
  const Json* view = element("bufferViews", *view_number);
  if (!view) return fail("expected a bufferView, found none");
  const auto buffer = number_in(*view, "buffer", no_index), start = number_in(*view, "byteOffset", 0),
             length = number_in(*view, "byteLength", 0), stride = number_in(*view, "byteStride", 0);
  if (!buffer || !start || !length || !stride || *buffer >= buffers_.size())
    return fail("expected a bufferView of a buffer, found another");
  const std::string_view bytes = buffers_[*buffer];
  if (*start > bytes.size() || *length > bytes.size() - *start || *offset > *length || *count >= no_index ||
      *stride > 252)
    return fail("expected a view inside its buffer, found one beyond it");
  out.type = type->type;
  if (json->value("normalized", Json(false)) == Json(true)) out.scale = type->scale;
  const std::size_t row = out.components * size_in_bytes(out.type);
  out.count = *count;
  out.stride = *stride > 0 ? *stride : row;
  const std::size_t room = *length - *offset;
  if (out.count > 0 && (room < row || (room - row) / out.stride < out.count - 1))
    return fail("expected room for " + std::to_string(out.count) + " elements, found less");
  out.first = bytes.data() + *start + *offset;
  return out;
}

}  // namespace relievo::io
