// Fuzz targets of the readers, one per family of formats. RELIEVO_FUZZ_FAMILY chooses one of the lists of file names
// below. scripts/fuzz finds the list by the word before the colon in the comment at its end. The first byte of an input
// chooses a name from the list; the rest is the file. In texts of meshes a zero byte ends the file, and the files
// beside it follow: first materials or a buffer, up to another zero byte, then a picture.
#include <array>
#include <cstdlib>

#include "fuzz/fuzz_program.h"
#include "relievo/io/stream.h"
#include "support/e57_encoder.h"
#include "support/read_text.h"

namespace {

using namespace relievo;

#if RELIEVO_FUZZ_FAMILY == 0
constexpr std::array names = {"a.obj", "a.stl", "a.off", "a.ply", "a.model"};  // mesh: meshes
#elif RELIEVO_FUZZ_FAMILY == 1
constexpr std::array names = {"a.gltf", "a.glb"};  // gltf: scenes with the files beside them
#elif RELIEVO_FUZZ_FAMILY == 2
constexpr std::array names = {"a.pcd", "a.xyz", "a.pts", "a.csv", "a.ptx", "a.splat"};  // cloud: clouds
#elif RELIEVO_FUZZ_FAMILY == 3
constexpr std::array names = {"a.las", "a.laz", "a.e57"};  // scanner: terrestrial and airborne scanners
#else
constexpr std::array names = {"a.png", "a.tif", "a.npy", "a.pfm",
                              "a.bmp", "a.asc", "a.dat", "a.jpg"};  // picture: pictures
#endif

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
  if (input.empty()) return;
  const auto first = static_cast<unsigned char>(input[0]);
  const std::string name = names[first % names.size()];
  std::string content(input.substr(1));
  if (name == "a.e57") content = with_checksums(std::move(content));
  const auto bytes = std::as_bytes(std::span(content));
  if (!check_answer(read_cloud(bytes, name), name).empty()) std::abort();
  if (name == "a.obj" || name == "a.gltf") {
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
