// Fuzz target of archives and project files. If the first byte is odd, the rest consists of a glTF file, a
// zero byte, and the buffer of this glTF file; both files are put into an archive. Otherwise the rest is
// itself an archive or a project file.
#include <algorithm>
#include <cstdlib>

#include "common/archive.h"
#include "common/project_file.h"
#include "common/read_inputs.h"
#include "fuzz/fuzz_program.h"
#include "support/zip_encoder.h"

namespace {

using namespace relievo;

template <typename T>
void require_answer(const Result<T>& answer) {
  if (!answer && (answer.error().kind != ErrorKind::input || answer.error().expected.empty())) std::abort();
}

}  // namespace

void run_target(std::string_view input) {
  if (input.empty()) return;
  std::string content(input.substr(1));
  if (input[0] % 2 != 0) {
    const std::size_t end = std::min(content.find('\0'), content.size());
    content = archive_of({{"m/scene.bin", content.substr(std::min(end + 1, content.size()))},
                          {"m/scene.gltf", content.substr(0, end)}});
  }
  const auto bytes = std::as_bytes(std::span(content));
  require_answer(app::unpack_project(bytes, "a.relievo"));
  if (app::is_archive(bytes)) require_answer(app::read_cloud_at(bytes, "a.zip"));
  require_answer(app::unpack_array(bytes, "a.npz"));
}
