#include <algorithm>
#include <cmath>

#include "io/gltf/gltf.h"
#include "io/text.h"
#include "relievo/core/json_place.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

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

}  // namespace relievo::io
