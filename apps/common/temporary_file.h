// A file that is written under a temporary name. Tested by tests/cli/files_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "common/descriptor.h"

namespace relievo::app {

struct TemporaryName;

// A file in the folder of `path` that keep() moves to its final path, and that is removed otherwise. It has
// no name until it is kept, so that nothing is left of it even after a crash. Where the file system has no
// files without names, and while it replaces another file, it has a unique temporary name, and
// remove_temporary_files() removes it. If a killed process left such a file, the next one for the same path
// removes it. An attribute identifies it, never its name alone.
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

  // Moves the finished file to that path, replacing an existing file.
  Result<void> keep(const std::string& path);

 private:
  std::string path_;
  Descriptor file_;
  TemporaryName* name_ = nullptr;  // null while the file has none
};

// Removes all temporary files of this process that have names, and from then on lets no thread make or keep
// one. It may be called in a signal handler, before the process ends.
void remove_temporary_files();

// From now on Ctrl-C and other signals that end the program remove its temporary files first.
void remove_temporary_files_on_signals();

}  // namespace relievo::app
