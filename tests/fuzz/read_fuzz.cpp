// Fuzz target of all readers: the first byte chooses the name, the rest is the file. With clang and
// -DRELIEVO_FUZZ=ON a libFuzzer program; otherwise it runs over the files named on its command line.
#include <array>
#include <cstdlib>
#include <string>

#include "relievo/io/read.h"
#include "relievo/io/stream.h"
#include "relievo/scan/depth_image.h"
#include "support/read_text.h"

namespace {

using namespace relievo;

constexpr std::array names = {"a.ply",  "a.obj", "a.xyz", "a.stl", "a.off",
                              "a.gltf", "a.glb", "a.pcd", "a.las", "a.png"};

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

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string name = names[data[0] % names.size()];
  const std::span bytes(reinterpret_cast<const std::byte*>(data + 1), size - 1);
  if (!check_answer(read_cloud(bytes, name), name).empty()) std::abort();
  const auto image = read_depth_image(bytes, name);
  const bool has_all = !image || image->values.size() == image->values.index(0, image->values.height);
  if (!has_all) std::abort();
  Bytes source(bytes);
  (void)stream_front(source, name, *parse_view("front"), 1000);
  return 0;
}

#ifndef RELIEVO_LIBFUZZER
#include "run_files.h"

int main(int argc, char** argv) {
  return run_files(argc, argv, [](const std::string& text) {
    for (std::size_t name = 0; name < names.size(); ++name) {
      const std::string input = static_cast<char>(name) + text;
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    }
  });
}
#endif
