// Writes a file that gets its final name only when it is complete. Tested by tests/cli/files_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "common/descriptor.h"

namespace relievo::app {

struct TemporaryName;

// A new file in the folder of `path`. keep() moves the file to its final path; without keep() the destructor
// removes it. Until keep() the file has no name, so that even a crash leaves nothing of it. In two cases the file has
// a unique temporary name: while it replaces another file, and on file systems that do not support files without
// names. remove_temporary_files() removes the files with temporary names. If a killed process left one, the next
// TemporaryFile for the same path removes it. The program recognises these files by an attribute, never by the name
// alone.
class TemporaryFile {
 public:
  // Makes the file with the permissions `mode`, reduced by the process's umask.
  explicit TemporaryFile(const std::string& path, unsigned mode = 0666);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  // append(), finish() and keep() return errors of kind output.
  Result<void> append(std::span<const std::byte> bytes);

  // Waits until all bytes are on the disk. Without finish() the file survives a crash of the program, but not
  // of the machine.
  Result<void> finish();

  // Moves the finished file to that path, and replaces an existing file.
  Result<void> keep(const std::string& path);

 private:
  std::string path_;
  Descriptor file_;
  TemporaryName* name_ = nullptr;  // null while the file has no temporary name
};

// Removes from a folder all unfinished files that killed processes or a power failure left there.
void remove_abandoned_files(const std::string& folder);

// Removes the named temporary files of this process. After this call no thread can make or keep a temporary
// file. A signal handler may call this function before the process ends.
void remove_temporary_files();

// Installs signal handlers: Ctrl-C and other signals that end the program then remove its temporary files
// first.
void remove_temporary_files_on_signals();

}  // namespace relievo::app
