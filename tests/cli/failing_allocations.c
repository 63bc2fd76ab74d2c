// Preloaded into `relievo make --threads 1`, lets each allocation fail once: at every EVERY-th call the process forks, and the
// child goes on with this allocation failed. It must end with exit code 1 and one line that begins with "relievo: expected", or
// with 0 where a library does without. Counting begins when main() sets the handler of operator new: what libraries allocate before is
// theirs. What a child does to files is left undone, as they are its parent's. Writes to the file
// COUNTS how many allocations there were, and how many children ended in which way. Built and run by tests/cli/allocations.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

static long every = -1, calls, refused, made, failed;
static int is_child, is_inside = 1;

static void complain(int status, const char* message) {
  void* frames[40];
  ++failed;
  dprintf(2, "FAILED: allocation %ld: status %x: %s\n", calls, (unsigned)status, message);
  backtrace_symbols_fd(frames, backtrace(frames, 40), 2);
}

// Returns true in the child, whose allocation fails. The parent waits for its end.
static int fails_here(void) {
  if (is_child || is_inside) return 0;
  is_inside = 1;
  if (every < 0) every = getenv("EVERY") ? atol(getenv("EVERY")) : 0;
  int fails = 0, ends[2];
  if (++calls && every > 0 && calls % every == 0 && pipe(ends) == 0) {
    const pid_t child = fork();
    if (child == 0) {
      is_child = fails = 1;
      dup2(ends[1], 2);
      alarm(60);
    }
    close(ends[1]);
    if (child > 0) {
      char message[4096];
      size_t length = 0;
      int status = -1;
      for (ssize_t n; length + 1 < sizeof message && (n = read(ends[0], message + length, sizeof message - 1 - length)) > 0;) length += n;
      message[length] = 0;
      waitpid(child, &status, 0);
      const char* end = strchr(message, '\n');
      if (status == 0) ++made;
      else if (WIFEXITED(status) && WEXITSTATUS(status) == 1 && end && !end[1] && !strncmp(message, "relievo: expected ", 18)) ++refused;
      else complain(status, message);
    }
    close(ends[0]);
  }
  is_inside = 0;
  if (fails) errno = ENOMEM;
  return fails;
}

void* _ZSt15set_new_handlerPFvvE(void* handler) {  // std::set_new_handler
  void* (*original)(void*) = (void* (*)(void*))dlsym(RTLD_NEXT, "_ZSt15set_new_handlerPFvvE");
  void* former = original(handler);
  is_inside = 0;
  return former;
}

void* malloc(size_t size) { return fails_here() ? 0 : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return fails_here() ? 0 : __libc_calloc(count, size); }
void* realloc(void* block, size_t size) { return fails_here() ? 0 : __libc_realloc(block, size); }
void* aligned_alloc(size_t alignment, size_t size) { return fails_here() ? 0 : __libc_memalign(alignment, size); }
int posix_memalign(void** block, size_t alignment, size_t size) {
  if (fails_here()) return ENOMEM;
  return (*block = __libc_memalign(alignment, size)) ? 0 : ENOMEM;
}

ssize_t write(int file, const void* bytes, size_t size) { return is_child && file != 2 ? (ssize_t)size : syscall(SYS_write, file, bytes, size); }
int unlink(const char* path) { return is_child ? 0 : (int)syscall(SYS_unlink, path); }
int rename(const char* from, const char* to) { return is_child ? 0 : (int)syscall(SYS_rename, from, to); }

__attribute__((destructor)) static void print_counts(void) {
  const char* path = getenv("COUNTS");
  if (is_child || !path) return;
  is_inside = 1;
  FILE* file = fopen(path, "w");
  if (file) fprintf(file, "%ld %ld %ld %ld\n", calls, refused, made, failed), fclose(file);
}
