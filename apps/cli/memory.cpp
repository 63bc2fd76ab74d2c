#include "cli/memory.h"

#include <sys/auxv.h>
#include <sys/resource.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

#include "common/temporary_file.h"

namespace relievo::app::cli {
namespace {

iovec part(const char* text) {
  return {const_cast<char*>(text), std::strlen(text)};
}

// Ends the process. Must not allocate. If several threads fail at the same time, only the first one prints the line.
void end_process() {
  static std::atomic_flag is_ending;
  while (is_ending.test_and_set()) ::pause();
  remove_temporary_files();
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  char megabytes[24] = {};
  const long kilobytes = usage.ru_maxrss;
  std::to_chars(megabytes, megabytes + sizeof megabytes - 1, kilobytes / 1000 + 1);
  const std::array line = {part("relievo: expected more free memory than the "), part(megabytes),
                           part(" MB that are in use; fewer points and a coarser resolution need less\n")};
  // One call writes the whole line, because other processes of a batch may print at the same time.
  (void)!::writev(STDERR_FILENO, line.data(), line.size());
  ::_exit(1);
}

// Handles std::bad_alloc from allocations that do not call the handler of operator new. If the exception
// leaves a thread, std::terminate() calls this function.
void end_process_or_abort() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    end_process();
  } catch (...) {
  }
  std::abort();
}

}  // namespace

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

void exit_when_out_of_memory() {
  std::set_new_handler(end_process);
  std::set_terminate(end_process_or_abort);
}

}  // namespace relievo::app::cli
