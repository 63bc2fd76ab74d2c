// Loads the buffers of a glTF file: the bytes after the JSON of a GLB, base64 text, or files beside it. Also
// loads buffer views, which may be compressed.
#include <algorithm>
#include <charconv>
#include <span>

#include "io/gltf/gltf.h"
#include "io/gltf/meshopt.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// Returns the bytes of a base64 text. If the text is not base64, returns nothing and sets `wrong` to the
// index of the first bad character.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text, std::size_t& wrong) {
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int held = 0;
  while (text.ends_with('=')) text.remove_suffix(1);
  for (wrong = 0; wrong < text.size(); ++wrong) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = digits.find(text[wrong]);
    if (digit == std::string_view::npos) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> held & 0xFF));
  }
  return bytes;
}

// Returns the text with each escape %XX replaced by its byte. An incomplete escape is not changed.
std::string without_escapes(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const std::string_view digits = text.substr(i + 1, 2);
    const bool is_escape =
        text[i] == '%' && digits.size() == 2 &&
        std::from_chars(digits.data(), digits.data() + 2, byte, 16).ptr == digits.data() + 2;
    plain += is_escape ? static_cast<char>(byte) : text[i];
    if (is_escape) i += 2;
  }
  return plain;
}

bool has_parent_part(std::string_view name) {
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find_first_of("/\\", begin), name.size());
    if (name.substr(begin, end - begin) == "..") return true;
    begin = end + 1;
  }
  return false;
}

// Returns the named member if it is a text, else `otherwise`.
std::string text_in(const Json& object, const char* name, const char* otherwise) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

std::optional<MeshoptLayout> meshopt_layout(const Json& json) {
  const auto mode = meshopt_mode(text_in(json, "mode", ""));
  const auto filter = meshopt_filter(text_in(json, "filter", "NONE"));
  const auto count = number_in(json, "count", 0), stride = number_in(json, "byteStride", 0);
  if (!mode || !filter || !count || !stride) return std::nullopt;
  return MeshoptLayout{*mode, *filter, *count, *stride};
}

}  // namespace

std::optional<std::string> name_in_uri(std::string_view uri) {
  std::string name = without_escapes(uri);
  const bool leads_out = name.starts_with('/') || name.starts_with('\\') || has_parent_part(name);
  // A colon before the first slash belongs to a scheme or a drive letter.
  const bool has_scheme = name.find(':') < name.find('/');
  if (name.empty() || leads_out || has_scheme || name.contains('\0')) return std::nullopt;
  return name;
}

// Returns the bytes of a "data:" URI, after the first comma. They are base64 or plain text, possibly with
// escapes.
Result<std::vector<std::byte>> GltfFile::data_in_uri(std::string_view uri, const std::string& place) const {
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos)
    return source_->error(place, "expected a comma before the data of the uri, found none");
  const std::string plain = without_escapes(uri.substr(comma + 1));
  if (!uri.substr(0, comma).ends_with(";base64")) {
    const auto bytes = std::as_bytes(std::span(plain));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  }
  std::size_t wrong = 0;
  auto decoded = decode_base64(plain, wrong);
  if (!decoded)
    return source_->error(place, cat("expected base64 text, found ", in_quotes(plain.substr(wrong, 1)),
                                     " as character ", wrong + 1));
  return std::move(*decoded);
}

// Returns the bytes in a URI, or the bytes of the file that it refers to.
Result<std::string_view> GltfFile::load(const std::string& uri, const std::string& place) {
  const auto known = loaded_.find(uri);
  std::vector<std::byte> bytes;
  if (known == loaded_.end() && uri.starts_with("data:")) {
    RELIEVO_TRY(bytes, data_in_uri(uri, place));
  } else if (known == loaded_.end()) {
    const auto name = name_in_uri(uri);
    if (!name) return source_->error(place, "expected a file in the same folder, found " + in_quotes(uri));
    auto file = source_->beside ? (*source_->beside)(*name) : source_->error(place, {});
    if (!file)
      return source_->error(place, "expected the file " + in_quotes(*name) +
                                       " beside it, found none that can be read; a .glb needs no other file");
    bytes = std::move(*file);
  }
  const auto& kept = known == loaded_.end() ? loaded_[uri] = std::move(bytes) : known->second;
  return std::string_view(reinterpret_cast<const char*>(kept.data()), kept.size());
}

std::optional<std::string_view> GltfFile::image(std::size_t i) {
  const std::string place = "image " + std::to_string(i);
  const Json* json = element("images", i);
  if (!json) return std::nullopt;
  const auto uri = json->find("uri");
  const bool has_uri = uri != json->end() && uri->is_string();
  const auto bytes = has_uri ? load(uri->get_ref<const std::string&>(), place)
                             : view(number_in(*json, "bufferView", no_index).value_or(no_index), place);
  return bytes ? std::optional(*bytes) : std::nullopt;
}

Result<std::string_view> GltfFile::buffer(std::size_t i, const Json& json) {
  const std::string place = "buffer " + std::to_string(i);
  const auto uri = json.find("uri");
  std::string_view bytes = binary_;
  if (uri != json.end()) {
    if (!uri->is_string())
      return source_->error(place, "expected a text as uri, found " + in_quotes(uri->dump()));
    RELIEVO_TRY(bytes, load(uri->get_ref<const std::string&>(), place));
  }
  const auto promised = number_in(json, "byteLength", 0);
  if (!promised || *promised > bytes.size())
    return source_->error(place, cat("expected the bytes that it says, ", shown_members(json, {"byteLength"}),
                                     ", found ", bytes.size()));
  return bytes.substr(0, *promised);
}

Result<std::string_view> GltfFile::part_of_buffer(const Json& part, const std::string& place) {
  const auto number = number_in(part, "buffer", no_index), start = number_in(part, "byteOffset", 0),
             length = number_in(part, "byteLength", 0);
  if (!number || !start || !length)
    return source_->error(place, "expected whole numbers as buffer, byteOffset and byteLength, found " +
                                     shown_members(part, {"buffer", "byteOffset", "byteLength"}));
  const Json* json = element("buffers", *number);
  if (!json) return source_->error(place, "expected a buffer, found none of that number");
  RELIEVO_TRY(const std::string_view bytes, buffer(*number, *json));
  if (*start > bytes.size() || *length > bytes.size() - *start)
    return source_->error(place, cat("expected a view inside its buffer of ", bytes.size(), " bytes, found ",
                                     *length, " from byte ", *start, " on"));
  return bytes.substr(*start, *length);
}

// The extension of a compressed view names the buffer with the compressed bytes. The buffer that the view
// itself names may be missing.
Result<std::string_view> GltfFile::view(std::size_t i, const std::string& place) {
  const Json* json = element("bufferViews", i);
  if (!json) return source_->error(place, "expected a bufferView, found none");
  const Json* extensions = object_in(*json, "extensions");
  const Json* meshopt = nullptr;
  for (const char* const name : {"KHR_meshopt_compression", "EXT_meshopt_compression"})
    if (extensions && !meshopt) meshopt = object_in(*extensions, name);
  if (!meshopt) return part_of_buffer(*json, place);
  const auto known = decoded_.find(i);
  if (known == decoded_.end()) {
    RELIEVO_TRY(const std::string_view compressed, part_of_buffer(*meshopt, place));
    const auto layout = meshopt_layout(*meshopt);
    auto decoded = layout ? decode_meshopt(compressed, *layout) : std::nullopt;
    if (!decoded)
      return source_->error(place, cat("expected a bufferView that is compressed as its extension says, ",
                                       shown_members(*meshopt, {"mode", "filter", "count", "byteStride"}),
                                       ", found ", compressed.size(), " bytes that are not"));
    decoded_[i] = std::move(*decoded);
  }
  const auto& bytes = decoded_[i];
  return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace relievo::io
