#include "common/output_files.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <list>
#include <new>

#include "common/files.h"
#include "common/temporary_file.h"
#include "relievo/core/choice.h"
#include "relievo/core/text.h"

namespace relievo::app {
namespace {

// Returns the target of a symbolic link, so that writing does not replace the link itself. Returns other
// paths unchanged.
std::string without_link(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_symlink(path, failed)) return path;
  const std::filesystem::path target = std::filesystem::canonical(path, failed);
  return failed ? path : target.string();
}

std::string folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

// Returns whether both paths name the same file. The file may be missing.
bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored)) return true;
  const auto full = [](const std::string& path) {
    std::error_code failed;
    const std::filesystem::path absolute = std::filesystem::absolute(path, failed),
                                canonical = std::filesystem::weakly_canonical(absolute, failed);
    if (failed == std::errc::not_enough_memory) throw std::bad_alloc();  // as operator new does
    return failed ? absolute : canonical;
  };
  return full(a) == full(b);
}

Result<void> check_writable(const std::string& path) {
  std::error_code ignored;
  const std::string folder = folder_of(without_link(path));
  if (std::filesystem::is_directory(path, ignored))
    return std::unexpected(Error{ErrorKind::output, path, {}, "expected a file name, found a folder"});
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    return std::unexpected(Error{ErrorKind::output, path, {}, "expected a file, found a device or a pipe"});
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return system_error(ErrorKind::output, path,
                        "expected a folder that can be written to, '" + folder + "'");
  return {};
}

}  // namespace

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
    TemporaryFile& temporary = temporaries.emplace_back(without_link(file.path));
    if (auto ok = temporary.append(file.bytes); !ok) return ok;
    if (auto ok = temporary.finish(); !ok) return ok;
  }
  auto file = files.begin();
  for (TemporaryFile& temporary : temporaries)
    if (auto ok = temporary.keep(without_link((file++)->path)); !ok) return ok;
  return {};
}

}  // namespace relievo::app
