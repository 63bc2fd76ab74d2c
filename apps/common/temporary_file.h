// A file that is written under a temporary name. Tested by tests/cli/files_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "common/descriptor.h"

namespace relievo::app {

struct TemporaryName;

// A file in the folder of `path`. keep() moves it to its final path; without keep() it is removed. Until then
// it has no name, so that nothing is left of it even after a crash. It has a unique temporary name while it
// replaces another file, and from the beginning if the file system has no files without names.
// remove_temporary_files() leaves no file with such a name. If a killed process left one, the next
// TemporaryFile for the same path removes it. The program recognises such files by an attribute, never by the
// name alone.
class TemporaryFile {
 public:
  // The file gets the permissions of `mode` that the process's mask allows.
  explicit TemporaryFile(const std::string& path, unsigned mode = 0666);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  // Errors of append(), finish() and keep(): kind output.
  Result<void> append(std::span<const std::byte> bytes);

  // Waits until the disk has all bytes. Without finish() the file outlives a crash of the program, but not of
  // the machine.
  Result<void> finish();

  // Moves the finished file to that path, replacing an existing file.
  Result<void> keep(const std::string& path);

 private:
  std::string path_;
  Descriptor file_;
  TemporaryName* name_ = nullptr;  // null while the file has no temporary name
};

// Removes the unfinished files in a folder that killed processes, or a loss of power, have left. They may
// belong to any path in it.
void remove_abandoned_files(const std::string& folder);

// Removes all temporary files of this process that have names. From then on no thread can make or keep a
// temporary file. It may be called in a signal handler, before the process ends.
void remove_temporary_files();

// From now on Ctrl-C and other signals that end the program remove its temporary files first.
void remove_temporary_files_on_signals();

}  // namespace relievo::app
