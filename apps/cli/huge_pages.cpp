#include "cli/huge_pages.h"

#include <sys/auxv.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace relievo::app::cli {

void restart_with_huge_pages(char** argv) {
  if (::getauxval(AT_SECURE) != 0) return;  // a setuid program loses the variable, and would restart for ever
  constexpr const char *name = "GLIBC_TUNABLES", *request = "glibc.malloc.hugetlb=1";
  if (const char* const given = std::getenv(name)) {
    if (given == std::string_view(request)) ::unsetenv(name);  // so that child processes do not inherit it
    return;
  }
  std::error_code failed;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failed);
  const bool is_loader = program.filename().string().starts_with("ld-");  // started as "ld-linux.so relievo"
  if (failed || is_loader || ::setenv(name, request, 1) != 0) return;
  ::execv(program.c_str(), argv);
  ::unsetenv(name);
}

}  // namespace relievo::app::cli
