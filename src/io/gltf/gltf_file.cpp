#include <algorithm>
#include <array>
#include <cmath>

#include "io/gltf/gltf.h"
#include "io/text.h"
#include "relievo/core/json_place.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

struct ComponentType {
  std::size_t code;
  NumberType type;
  double scale;  // factor of normalised values
};
constexpr std::array<ComponentType, 6> component_types = {{{5120, NumberType::int8, 1 / 127.0},
                                                           {5121, NumberType::uint8, 1 / 255.0},
                                                           {5122, NumberType::int16, 1 / 32767.0},
                                                           {5123, NumberType::uint16, 1 / 65535.0},
                                                           {5125, NumberType::uint32, 1},
                                                           {5126, NumberType::float32, 1}}};

// The largest number of vectors in an accessor without a buffer view. Its numbers are 0, except those that a
// sparse accessor replaces. Therefore even a small file could ask for any number of zeros. No mesh has this
// many vertices at the origin.
constexpr std::size_t most_zeros = 1 << 20;

std::size_t components_of(const Json& accessor) {
  constexpr std::array<std::string_view, 4> names = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  const auto type = accessor.find("type");
  if (type == accessor.end() || !type->is_string()) return 0;
  if (type->get_ref<const std::string&>() == "MAT4") return 16;
  const auto found = std::ranges::find(names, type->get_ref<const std::string&>());
  return found == names.end() ? 0 : static_cast<std::size_t>(found - names.begin()) + 1;
}

std::vector<double> decode_vectors(const BufferRows& rows, NumberType type, std::size_t components,
                                   std::size_t count, double scale) {
  if (count == 0) return {};  // an empty buffer has no address
  std::vector<double> numbers(count * components), column(count);
  for (std::size_t c = 0; c < components; ++c) {
    decoder(type, false)(rows.first + c * size_in_bytes(type), rows.stride, count, column.data());
    for (std::size_t i = 0; i < count; ++i) numbers[i * components + c] = scale * column[i];
  }
  return numbers;
}

}  // namespace

std::optional<std::size_t> number_in(const Json& object, const char* name, std::size_t otherwise) {
  const auto found = object.find(name);
  return found == object.end() ? otherwise : whole_number(*found);
}

std::string shown_members(const Json& object, std::initializer_list<const char*> names) {
  std::string shown;
  for (const char* const name : names)
    if (const auto found = object.find(name); found != object.end())
      shown += cat(shown.empty() ? "" : ", ", name, " ", printable(found->dump()));
  return shown.empty() ? "none of them" : shown;
}

const Json* object_in(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found == json.end() || !found->is_object() ? nullptr : &*found;
}

std::optional<std::size_t> whole_number(const Json& value) {
  if (value.is_number_unsigned()) return value.get<std::size_t>();
  if (!value.is_number_float()) return std::nullopt;
  const double number = value.get<double>();
  const bool is_whole = number >= 0 && number < no_index && std::trunc(number) == number;
  return is_whole ? std::optional(static_cast<std::size_t>(number)) : std::nullopt;
}

const Json* GltfFile::element(std::string_view array, std::size_t i) const {
  const auto found = json_.find(std::string(array));
  if (found == json_.end() || !found->is_array() || i >= found->size()) return nullptr;
  return (*found)[i].is_object() ? &(*found)[i] : nullptr;
}

Result<void> GltfFile::split_glb(std::string_view& text) {
  const std::string_view bytes = source_->bytes;
  if (bytes.size() < 20)
    return source_->error_at_byte(bytes.size(), "expected a GLB header, found the end of the file");
  const auto number = [&](std::size_t at) { return std::size_t{little<std::uint32_t>(bytes.data() + at)}; };
  if (number(4) != 2) return source_->error_at_byte(4, cat("expected version 2 of glTF, found ", number(4)));
  if (number(8) > bytes.size())
    return source_->error_at_byte(8, cat("expected ", number(8), " bytes, found ", bytes.size()));
  for (std::size_t at = 12; at + 8 <= number(8); at += 8 + number(at)) {
    if (number(at) > number(8) - at - 8)
      return source_->error_at_byte(
          at, cat("expected a chunk of ", number(at), " bytes, found ", number(8) - at - 8));
    if (number(at + 4) == json_chunk && text.empty()) text = bytes.substr(at + 8, number(at));
    if (number(at + 4) == binary_chunk && binary_.empty()) binary_ = bytes.substr(at + 8, number(at));
  }
  if (text.empty()) return source_->error_at_byte(12, "expected a JSON chunk, found none");
  return {};
}

Result<void> GltfFile::check_version() const {
  const auto asset = json_.find("asset");
  if (asset == json_.end() || !asset->is_object())
    return source_->error("asset", "expected the member asset of a glTF file, found none");
  const auto version = asset->find("version");
  if (version == asset->end() || !version->is_string()) return {};
  const auto& text = version->get_ref<const std::string&>();
  if (text.starts_with("2.")) return {};
  return source_->error("asset.version", "expected version 2 of glTF, found " + in_quotes(text));
}

Result<GltfFile> GltfFile::open(const Source& source) {
  GltfFile file(source);
  std::string_view text = source.bytes.substr(byte_order_mark_size(source.bytes));
  const bool is_binary = text.starts_with("glTF");
  if (is_binary) {
    text = {};
    RELIEVO_CHECK(file.split_glb(text));
  }
  file.json_ = Json::parse(text, nullptr, false);
  if (file.json_.is_discarded())
    return source.error(is_binary ? "JSON" : json_error_place(text),
                        "expected the JSON of a glTF file, found text that is none");
  if (!file.json_.is_object()) return source.error({}, "expected a JSON object, found " + in_quotes(text));
  RELIEVO_CHECK(file.check_version());
  return file;
}

Result<GltfFile::Layout> GltfFile::layout_of(const Json& json, const std::string& place) const {
  const auto code = number_in(json, "componentType", 0), count = number_in(json, "count", 0);
  if (!code || !count)
    return source_->error(place, "expected whole numbers as componentType and count, found " +
                                     shown_members(json, {"componentType", "count"}));
  const auto type = std::ranges::find(component_types, *code, &ComponentType::code);
  const std::size_t components = components_of(json);
  if (type == component_types.end() || components == 0)
    return source_->error(place, cat("expected a known componentType and type, found ", *code, " and ",
                                     in_quotes(json.value("type", Json("none")).dump())));
  if (*count >= no_index)
    return source_->error(place, cat("expected fewer than 4294967295 vectors, found ", *count));
  const bool is_normalised = json.value("normalized", Json(false)) == Json(true);
  return Layout{*count, components, type->type, is_normalised ? type->scale : 1};
}

// Returns the location of the vectors of `in_view`, which is an accessor or a part of a sparse accessor.
Result<BufferRows> GltfFile::rows(const Json& in_view, const Layout& layout, const std::string& place) {
  const auto fail = [&](std::string expected) { return source_->error(place, std::move(expected)); };
  const auto offset = number_in(in_view, "byteOffset", 0),
             view_number = number_in(in_view, "bufferView", no_index);
  if (!offset || !view_number)
    return fail("expected whole numbers as byteOffset and bufferView, found " +
                shown_members(in_view, {"byteOffset", "bufferView"}));
  RELIEVO_TRY(const std::string_view bytes, view(*view_number, place));
  const Json& of_view = *element("bufferViews", *view_number);
  const auto stride = number_in(of_view, "byteStride", 0);
  if (!stride || *stride > 252)
    return fail("expected a whole number up to 252 as byteStride, found " +
                in_quotes(of_view["byteStride"].dump()));
  if (*offset > bytes.size())
    return fail(
        cat("expected a byteOffset inside its bufferView, up to ", bytes.size(), ", found ", *offset));
  const std::size_t row = layout.components * size_in_bytes(layout.type), room = bytes.size() - *offset;
  const BufferRows found{bytes.data() + *offset, *stride > 0 ? *stride : row};
  if (layout.count > 0 && (room < row || (room - row) / found.stride < layout.count - 1))
    return fail(cat("expected room for ", layout.count, " elements, found ", room, " bytes"));
  return found;
}

// Replaces the vectors at the indices that a sparse accessor lists.
Result<void> GltfFile::replace_sparse(const Json& sparse, const Layout& layout, const std::string& place,
                                      AccessorValues& out) {
  const Json *at = object_in(sparse, "indices"), *by = object_in(sparse, "values");
  if (!at || !by)
    return source_->error(place, "expected the indices and values of its sparse part, found " +
                                     shown_members(sparse, {"indices", "values"}));
  Json indices = *at;
  indices["type"] = "SCALAR";
  indices["count"] = sparse.value("count", Json());
  RELIEVO_TRY(const Layout index_layout, layout_of(indices, place));
  RELIEVO_TRY(const BufferRows index_rows, rows(indices, index_layout, place));
  Layout value_layout = layout;
  value_layout.count = index_layout.count;
  RELIEVO_TRY(const BufferRows value_rows, rows(*by, value_layout, place));
  const auto which = decode_vectors(index_rows, index_layout.type, 1, index_layout.count, 1);
  const auto vectors =
      decode_vectors(value_rows, layout.type, layout.components, index_layout.count, layout.scale);
  for (std::size_t i = 0; i < which.size(); ++i) {
    if (!(which[i] >= 0 && which[i] < static_cast<double>(layout.count)))
      return source_->error(place, cat("expected sparse indices below ", layout.count, ", found ", which[i]));
    const std::size_t to = static_cast<std::size_t>(which[i]) * layout.components;
    std::copy_n(vectors.begin() + static_cast<std::ptrdiff_t>(i * layout.components), layout.components,
                out.numbers.begin() + static_cast<std::ptrdiff_t>(to));
  }
  return {};
}

Result<AccessorValues> GltfFile::accessor(std::size_t i, const std::string& at) {
  const std::string place = at + ", accessor " + std::to_string(i);
  const Json* json = element("accessors", i);
  if (!json) return source_->error(place, "expected an accessor, found none of that number");
  RELIEVO_TRY(const Layout layout, layout_of(*json, place));
  const Json* sparse = object_in(*json, "sparse");
  AccessorValues out{layout.components, {}, layout.type};
  if (json->contains("bufferView")) {
    RELIEVO_TRY(const BufferRows found, rows(*json, layout, place));
    out.numbers = decode_vectors(found, layout.type, layout.components, layout.count, layout.scale);
  } else if (layout.count <= most_zeros) {
    out.numbers.assign(layout.count * layout.components, 0);
  } else {
    return source_->error(place,
                          cat("expected at most 1048576 vectors without a bufferView, found ", layout.count));
  }
  if (sparse) RELIEVO_CHECK(replace_sparse(*sparse, layout, place, out));
  return out;
}

}  // namespace relievo::io
