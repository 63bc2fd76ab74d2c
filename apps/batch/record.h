// Defines the folder of the outputs, the record of a job's outcome, and the journal of all records. An interrupted run
// continues from the journal. Tested by tests/cli/batch_test.cpp, tests/cli/foreign_files and scripts/fault-campaign.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "common/descriptor.h"
#include "relievo/core/error.h"

namespace relievo::app::batch {

// Checks that a batch may write into the folder, and changes nothing. Errors: kind option if the folder has
// files that no batch made; kind output if it cannot be read.
Result<void> check_output_folder(const std::string& outputs);

// Creates the folder, marks it as the folder of a batch, and creates the folder `inner` inside it. Each job
// calls this again, as the user may remove the folders during a run. Errors: those of check_output_folder().
Result<void> make_output_folder(const std::string& outputs, const std::filesystem::path& inner = {});

struct Record {
  std::string name = {}, file = {};
  bool is_made = false;
  std::string error = {};    // one line; empty if the relief was made
  bool may_succeed = false;  // whether a failed job may succeed later, because memory or a disk was full
  std::string hash = {};     // hash of files, options and version; empty if the scan could not be read
  double seconds = 0, cpu_seconds = 0, peak_mb = 0;
  std::map<std::string, std::uintmax_t> outputs = {};  // maps the paths of outputs to their sizes in bytes
  std::string host = {}, finished = {};                // finished: time in UTC
};

// Returns the record as the JSON object that a line of the journal contains.
nlohmann::json to_json(const Record& record);

// Reads the record from a line of the journal. Returns nothing for other text, such as an incomplete line.
std::optional<Record> record_from_line(std::string_view line);

using Records = std::map<std::string, Record>;  // maps the name of a job to its last record

// Returns the records from all journals in the folder of the outputs.
Records read_journals(const std::string& outputs);

// The journal of one machine: a file in the folder of the outputs. Several programs of that machine may
// append to it at the same time. Each machine has its own journal, since on some network file systems several
// machines cannot append to the same file.
class Journal {
 public:
  // Creates the folder and the file if they are missing. Errors: kind output.
  static Result<Journal> open(const std::string& outputs);

  // Appends the record as a line. Errors: kind output.
  Result<void> append(const Record& record) const;

 private:
  Journal(std::string path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}

  std::string path_;
  Descriptor file_;
};

// Locks a shard of the jobs until the returned object is destroyed. Errors: kind output if another run of the
// same shard has locked it.
Result<Descriptor> lock_run(const std::string& outputs, const std::string& shard);

// Waits until no other process does the job of that name, then locks the job until the returned object is
// destroyed. Errors: kind output.
Result<Descriptor> lock_job(const std::string& outputs, const std::string& name);

std::string host_name();

// Returns the current time in UTC, "2026-11-24T12:00:00.000Z".
std::string time_now();

}  // namespace relievo::app::batch
