// Fuzz target of all readers. The first byte of an input chooses the channels of a picture. The rest of the
// line is the ending of the file's name, such as "obj"; all that follows is the file. In OBJ and glTF a zero
// byte ends the file, and the files beside it follow: first materials or a buffer, up to another zero byte,
// then a picture.
#include <cstdlib>

#include "fuzz/fuzz_program.h"
#include "relievo/io/stream.h"
#include "support/e57_encoder.h"
#include "support/read_text.h"

namespace {

using namespace relievo;

// Returns the file with correct checksums, because the reader of E57 refuses files with wrong ones.
std::string with_checksums(std::string file) {
  for (std::size_t page = 0; page + 1024 <= file.size(); page += 1024) {
    const std::uint32_t checksum = bitwise_crc32c(std::string_view(file).substr(page, 1020));
    file = patched(std::move(file), page + 1020, std::byteswap(checksum));
  }
  return file;
}

// Splits off the part of the content before the first zero byte. The zero byte is removed, too.
std::string_view next_part(std::string_view& content) {
  const std::size_t end = std::min(content.find('\0'), content.size());
  const std::string_view part = content.substr(0, end);
  content.remove_prefix(std::min(end + 1, content.size()));
  return part;
}

// Returns the files beside a text. Each is given under all names by which the text might refer to it.
FilesBeside files_beside(std::string_view rest) {
  const std::string_view words = next_part(rest);
  return [words, rest](const std::string& name) -> Result<std::vector<std::byte>> {
    const bool is_picture = !name.ends_with(".mtl") && !name.ends_with(".bin");
    const auto bytes = std::as_bytes(std::span(is_picture ? rest : words));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  };
}

class Bytes : public ByteSource {
 public:
  explicit Bytes(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::uint64_t size() const override { return bytes_.size(); }
  Result<void> read(std::uint64_t offset, std::span<std::byte> to) override {
    if (offset > bytes_.size() || to.size() > bytes_.size() - offset) std::abort();
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), to.size(), to.begin());
    return {};
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace

void run_target(std::string_view input) {
  const std::size_t line_end = input.substr(0, 10).find('\n');
  if (line_end == 0 || line_end == std::string_view::npos) return;
  const auto first = static_cast<unsigned char>(input[0]);
  const std::string ending(input.substr(1, line_end - 1)), name = "a." + ending;
  std::string content(input.substr(line_end + 1));
  if (ending == "e57") content = with_checksums(std::move(content));
  const auto bytes = std::as_bytes(std::span(content));
  if (!check_answer(read_cloud(bytes, name), name).empty()) std::abort();
  if (ending == "obj" || ending == "gltf") {
    std::string_view rest = content;
    const auto text = std::as_bytes(std::span(next_part(rest)));
    if (!check_answer(read_cloud(text, name, files_beside(rest)), name).empty()) std::abort();
  }
  const PictureChannels channels{(first & 64) != 0, first >> 7};
  const auto image = read_depth_image(bytes, name, channels);
  const bool has_all = !image || image->values.size() == image->values.index(0, image->values.height);
  if (!has_all) std::abort();
  Bytes source(bytes);
  (void)stream_front(source, name, *parse_view("front"), 1000);
}
