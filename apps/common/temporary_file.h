// A file that is written under a temporary name. Tested by tests/cli/files_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "common/descriptor.h"

namespace relievo::app {

struct TemporaryName;

// A file beside `path`, in the same folder, that takes a place when kept and is gone otherwise. It is locked while it is
// written. Where a process ended without warning, its file is removed by the next one for that path. There may be eight at
// the same time; remove_temporary_files() knows them.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& path);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  // Errors of all: kind output.
  Result<void> append(std::span<const std::byte> bytes);

  // Gives the file the permissions of a new one and, if `is_durable`, waits until the disk has all bytes: without that,
  // the file outlives a crash of the program, but not of the machine.
  Result<void> finish(bool is_durable = true);

  // Moves the finished file to that path, in place of what is there.
  Result<void> keep(const std::string& path);

 private:
  std::string path_;
  TemporaryName* name_ = nullptr;
  Descriptor file_{-1};
  bool is_kept_ = false;
};

// Removes all of this process, and lets no thread make or keep one from now on. It may be called in a signal handler,
// before the process ends.
void remove_temporary_files();

// From now on Ctrl-C and other signals that end the program remove its temporary files first.
void remove_temporary_files_on_signals();

}  // namespace relievo::app
