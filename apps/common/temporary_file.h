// A file that is written under a temporary name. Tested by tests/cli/files_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "common/descriptor.h"

namespace relievo::app {

struct TemporaryName;

// A file in the folder of `path` that takes a place when kept and is gone otherwise. It has no name until it is kept, so that
// nothing of it is left, however the process ends. Where the file system has no such files, and for the moment in which it
// replaces another, it has a name that nothing else has; remove_temporary_files() knows these. One that a killed process left
// is removed by the next one for that path: it is known by an attribute, never by its name alone.
class TemporaryFile {
 public:
  // The file gets the permissions of `mode` that the process's mask allows.
  explicit TemporaryFile(const std::string& path, unsigned mode = 0666);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  // Errors of all: kind output.
  Result<void> append(std::span<const std::byte> bytes);

  // Waits until the disk has all bytes: without that, the file outlives a crash of the program, but not of the machine.
  Result<void> finish();

  // Moves the finished file to that path, in place of what is there.
  Result<void> keep(const std::string& path);

 private:
  std::string path_;
  Descriptor file_;
  TemporaryName* name_ = nullptr;  // null while it has none
};

// Removes all temporary files of this process that have names, and from then on lets no thread make or keep
// one. It may be called in a signal handler, before the process ends.
void remove_temporary_files();

// From now on Ctrl-C and other signals that end the program remove its temporary files first.
void remove_temporary_files_on_signals();

}  // namespace relievo::app
