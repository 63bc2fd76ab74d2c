#include "common/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <span>

#include "common/descriptor.h"
#include "relievo/core/text.h"

namespace relievo::app {
namespace {

std::string_view kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  return S_ISFIFO(mode) ? "a pipe" : "a device";
}

std::unexpected<Error> no_file(const std::string& path, mode_t mode) {
  return input_error(path, {}, cat("expected a file, found ", kind_of(mode)));
}

// Returns the largest size of a file that may be read: half of the memory. The other half is needed to make a
// relief of the file.
std::size_t most_bytes() {
#if defined(__wasi__)
  return std::size_t{1} << 31;
#else
  return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) / 2 *
         static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
#endif
}

// Reads to the end of the file. For pipes and for files that grow, `size` is only a first guess.
Result<std::vector<std::byte>> read_all(const Descriptor& file, std::size_t size, const std::string& path) {
  const std::size_t most = most_bytes();
  // The buffer is one byte longer than the file, so that the last read, which finds the end of the file, does not
  // have to enlarge the buffer.
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
  return input_error(path, {}, cat("expected at most ", most >> 20, " MiB, half of the memory"));
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::string& path, bool is_pipe_fine) {
  // Without O_NONBLOCK, opening a pipe without a writer would wait for ever.
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | (is_pipe_fine ? 0 : O_NONBLOCK)));
  if (!file.is_open()) return system_error(ErrorKind::input, path, "expected a file that can be read");
  struct stat status {};
  if (::fstat(file.number(), &status) != 0)
    return system_error(ErrorKind::input, path, "expected a file that can be read");
  if (!S_ISREG(status.st_mode) && !(is_pipe_fine && S_ISFIFO(status.st_mode)))
    return no_file(path, status.st_mode);
  return read_all(file, static_cast<std::size_t>(status.st_size), path);
}

bool is_there(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0;
}

std::string path_in(const std::string& folder, const std::string& path) {
  return (std::filesystem::path(folder) / path).string();
}

std::int64_t time_of_change_ns(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return 0;
  return status.st_mtim.tv_sec * std::int64_t{1'000'000'000} + status.st_mtim.tv_nsec;
}

Result<void> check_file(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) return no_file(path, status.st_mode);
  return {};
}

std::optional<std::uint64_t> file_size(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return static_cast<std::uint64_t>(status.st_size);
}

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::string environment_variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace relievo::app
