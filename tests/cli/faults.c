// This library is preloaded into programs and causes faults in them. tests/cli/faults sets these environment
// variables: THREADS, the largest number of threads; SHRINK, a file that becomes shorter just before it is
// read; CLOCK_BACK, which sets the clock back by an hour whenever it is read. With NO_TMPFILE, no file can be
// made without a name. scripts/fault-campaign sets FAULTS, a file of numbers that all processes of a program
// share; the numbers say which calls fail, see the enumeration below. Allocations are counted from the start
// of main(), or from the start of the program if AT_ONCE is set. Allocations by modules whose paths contain a
// word of EXCEPT are not counted.
#define _GNU_SOURCE
#define open declared_open  // the header declares it with a variable number of arguments
#define open64 declared_open64
#include <fcntl.h>
#undef open
#undef open64
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

// With NO_TMPFILE, programs see a file system that cannot make files without names.
static int open_with(const char* path, int flags, mode_t mode) {
  if ((flags & O_TMPFILE) == O_TMPFILE && getenv("NO_TMPFILE")) {
    errno = EOPNOTSUPP;
    return -1;
  }
  return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}
int open(const char* path, int flags, mode_t mode) {
  return open_with(path, flags, mode);
}
int open64(const char* path, int flags, mode_t mode) {
  return open_with(path, flags, mode);
}

// Each kind of call has three numbers: the number of calls so far, the first call that fails (0 for none),
// and the number of successive calls that fail. Allocations of fewer than `least_bytes` bytes are not counted
// and do not fail.
enum {
  allocations = 0,
  writes = 3,
  reads = 6,
  write_error = 9,
  clock_shift_s = 10,
  least_bytes = 11,
  numbers = 16
};
static atomic_long none[numbers];
static atomic_long* shared = none;
static int is_started;
static __thread int is_inside __attribute__((tls_model("initial-exec")));

__attribute__((constructor)) static void begin(void) {
  const char* path = getenv("FAULTS");
  const int file = path ? open_with(path, O_RDWR | O_CLOEXEC, 0) : -1;
  if (file >= 0) {
    void* map = mmap(0, sizeof none, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (map != MAP_FAILED) shared = map;
    close(file);
  }
  is_started = getenv("AT_ONCE") != 0;
}

static int fails(int kind) {
  const long number = ++shared[kind], first = shared[kind + 1];
  return first > 0 && number >= first && number < first + shared[kind + 2];
}

static int is_exempt(const void* caller) {
  const char* except = getenv("EXCEPT");
  Dl_info module;
  if (!except || !dladdr(caller, &module) || !module.dli_fname) return 0;
  char words[200];
  strncpy(words, except, sizeof words - 1)[sizeof words - 1] = 0;
  char* rest;
  for (char* word = strtok_r(words, ",", &rest); word; word = strtok_r(0, ",", &rest))
    if (strstr(module.dli_fname, word)) return 1;
  return 0;
}

static int allocation_fails(size_t size, const void* caller) {
  if (!is_started || shared == none || is_inside || (long)size < shared[least_bytes]) return 0;
  is_inside = 1;
  const int is_to_fail = !is_exempt(caller) && fails(allocations);
  is_inside = 0;
  if (is_to_fail) errno = ENOMEM;
  return is_to_fail;
}

#define FAILS(size) allocation_fails(size, __builtin_return_address(0))
void* malloc(size_t size) {
  return FAILS(size) ? 0 : __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  return FAILS(count * size) ? 0 : __libc_calloc(count, size);
}
void* realloc(void* block, size_t size) {
  return FAILS(size) ? 0 : __libc_realloc(block, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  return FAILS(size) ? 0 : __libc_memalign(alignment, size);
}
int posix_memalign(void** block, size_t alignment, size_t size) {
  if (FAILS(size)) return ENOMEM;
  return (*block = __libc_memalign(alignment, size)) ? 0 : ENOMEM;
}

void* _ZSt15set_new_handlerPFvvE(void* handler) {  // std::set_new_handler, called first by main()
  void* library = dlopen("libstdc++.so.6", RTLD_NOW | RTLD_NOLOAD);  // loaded locally if a module needs it
  void* (*original)(void*) = (void* (*)(void*))dlsym(library, "_ZSt15set_new_handlerPFvvE");
  is_started = 1;
  return original(handler);
}

// Calls fail on regular files only, not on connections or the terminal.
static int file_fails(int kind, int file) {
  struct stat about;
  if (shared == none || fstat(file, &about) != 0 || !S_ISREG(about.st_mode) || !fails(kind)) return 0;
  errno = kind == writes ? (int)shared[write_error] : EIO;
  return 1;
}

static void shrink_before(size_t size) {
  const char* path = getenv("SHRINK");
  if (path && size > 8192) (void)!truncate(path, 5000);
}

ssize_t read(int file, void* bytes, size_t size) {
  shrink_before(size);
  return file_fails(reads, file) ? -1 : syscall(SYS_read, file, bytes, size);
}
ssize_t pread(int file, void* bytes, size_t size, off_t offset) {
  shrink_before(size);
  return file_fails(reads, file) ? -1 : syscall(SYS_pread64, file, bytes, size, offset);
}
ssize_t write(int file, const void* bytes, size_t size) {
  return file_fails(writes, file) ? -1 : syscall(SYS_write, file, bytes, size);
}
ssize_t writev(int file, const struct iovec* parts, int count) {
  return file_fails(writes, file) ? -1 : syscall(SYS_writev, file, parts, count);
}
int fsync(int file) {
  return file_fails(writes, file) ? -1 : (int)syscall(SYS_fsync, file);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* how, void* (*start)(void*), void* argument) {
  int (*create)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*) =
      dlsym(RTLD_NEXT, "pthread_create");
  static atomic_long given;
  const char* most = getenv("THREADS");
  return most && atomic_fetch_add(&given, 1) >= atol(most) ? EAGAIN : create(thread, how, start, argument);
}

int clock_gettime(clockid_t which, struct timespec* now) {
  static atomic_long back;
  const int result = syscall(SYS_clock_gettime, which, now);
  if (which != CLOCK_REALTIME) return result;
  if (getenv("CLOCK_BACK")) now->tv_sec -= atomic_fetch_add(&back, 3600);
  now->tv_sec += shared[clock_shift_s];
  return result;
}
