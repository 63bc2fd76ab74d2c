#include "common/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <list>

#include "common/temporary_file.h"
#include "relievo/core/choice.h"
#include "relievo/core/text.h"

namespace relievo::app {
namespace {

std::string folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

// Returns whether both paths lead to the same file, which need not exist.
bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored)) return true;
  const auto full = [](const std::string& path) {
    std::error_code none;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, none), none);
  };
  return full(a) == full(b);
}

Result<void> check_writable(const std::string& path) {
  std::error_code ignored;
  const std::string folder = folder_of(path);
  if (std::filesystem::is_directory(path, ignored))
    return std::unexpected(Error{ErrorKind::output, path, {}, "expected a file name, found a folder"});
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    return std::unexpected(Error{ErrorKind::output, path, {}, "expected a file, found a device or a pipe"});
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return system_error(ErrorKind::output, path,
                        "expected a folder that can be written to, '" + folder + "'");
  return {};
}

std::string_view kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  return S_ISFIFO(mode) ? "a pipe" : "a device";
}

// Files beyond half of the machine's memory could be read, but nothing could be made of them.
std::size_t most_bytes() {
  return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) / 2 *
         static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

// Reads to the end of the file, whose size is known but for pipes and files that grow.
Result<std::vector<std::byte>> read_all(const Descriptor& file, std::size_t size, const std::string& path) {
  const std::size_t most = most_bytes();
  // One more than the size, so that the end is seen without growing.
  std::vector<std::byte> bytes(size > most ? 0 : std::max<std::size_t>(size + 1, 1 << 16));
  for (std::size_t filled = 0; size <= most && filled <= most;) {
    if (filled == bytes.size()) bytes.resize(bytes.size() * 2);
    const ssize_t got = ::read(file.number(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return system_error(ErrorKind::input, path, "expected a file that can be read");
    filled += static_cast<std::size_t>(got);
    if (got > 0) continue;
    bytes.resize(filled);
    return bytes;
  }
  return std::unexpected(
      Error{ErrorKind::input, path, {}, cat("expected at most ", most >> 20, " MiB, half of the memory")});
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::string& path, bool is_pipe_fine) {
  // Without O_NONBLOCK the opening of a pipe that nobody writes to would never return.
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | (is_pipe_fine ? 0 : O_NONBLOCK)));
  if (!file.is_open()) return system_error(ErrorKind::input, path, "expected a file that can be read");
  struct stat status {};
  if (::fstat(file.number(), &status) != 0)
    return system_error(ErrorKind::input, path, "expected a file that can be read");
  if (!S_ISREG(status.st_mode) && !(is_pipe_fine && S_ISFIFO(status.st_mode)))
    return std::unexpected(
        Error{ErrorKind::input, path, {}, cat("expected a file, found ", kind_of(status.st_mode))});
  return read_all(file, static_cast<std::size_t>(status.st_size), path);
}

Result<void> check_output(const std::string& path, const std::vector<std::string_view>& endings,
                          std::span<const std::string> taken) {
  if (!endings.empty() && std::ranges::find(endings, cat(".", ending_of(path))) == endings.end())
    return option_error(path, cat("expected a file ending in ", either(endings)));
  if (std::ranges::any_of(taken, [&](const std::string& other) { return is_same_file(path, other); }))
    return option_error(path, "expected different files for input and outputs");
  return check_writable(path);
}

Result<void> write_files(std::span<const OutputFile> files) {
  std::list<TemporaryFile> temporaries;
  for (const OutputFile& file : files) {
    TemporaryFile& temporary = temporaries.emplace_back(file.path);
    if (auto ok = temporary.append(file.bytes); !ok) return ok;
    if (auto ok = temporary.finish(); !ok) return ok;
  }
  auto file = files.begin();
  for (TemporaryFile& temporary : temporaries)
    if (auto ok = temporary.keep((file++)->path); !ok) return ok;
  return {};
}

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace relievo::app
