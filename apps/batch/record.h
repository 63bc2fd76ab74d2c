// The record of a job's outcome, and the journal of all records, from which an interrupted run continues.
// Tested by tests/cli/batch_test.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "common/descriptor.h"

namespace relievo::app::batch {

struct Record {
  std::string name = {}, file = {};
  bool is_made = false;
  std::string error = {};    // one line, if the relief is not made
  bool may_succeed = false;  // whether a failed job may succeed another time, as memory and disks change
  std::string hash = {};     // hash of files, options and version; empty if the scan cannot be read
  double seconds = 0, cpu_seconds = 0, peak_mb = 0;
  std::map<std::string, std::uintmax_t> outputs = {};  // maps file names, relative to the folder, to bytes
  std::string host = {}, finished = {};                // finished: the time in UTC
};

// Returns the record as the JSON object of a line of the journal.
nlohmann::json to_json(const Record& record);

// Returns the record of a line; nothing for other text, such as a line that was written only in part.
std::optional<Record> record_from_line(std::string_view line);

using Records = std::map<std::string, Record>;  // maps names of jobs to their last records

// Returns the records of all journals in the folder of the outputs.
Records read_journals(const std::string& outputs);

// The journal of one machine, a file in the folder of the outputs. Programs of that machine append to it at
// the same time. Other machines have their own journals, as not all shared file systems let several machines
// append to one file.
class Journal {
 public:
  // Creates the folder and the file if they are not there. Errors: kind output.
  static Result<Journal> open(const std::string& outputs);

  // Errors: kind output.
  Result<void> append(const Record& record) const;

 private:
  Journal(std::string path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}

  std::string path_;
  Descriptor file_;
};

// Locks that shard of the folder for this run until the returned object is destroyed. Errors: kind output if
// another run has locked it.
Result<Descriptor> lock_run(const std::string& outputs, const std::string& shard);

// Waits until no other process does the job of that name, and locks the job until the returned object is
// destroyed. Errors: kind output.
Result<Descriptor> lock_job(const std::string& outputs, const std::string& name);

// Returns this machine's name.
std::string host_name();

// Returns the present time in UTC, "2026-11-24T12:00:00.000Z".
std::string time_now();

}  // namespace relievo::app::batch
