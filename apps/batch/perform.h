// Does one job: reads its inputs and writes its outputs. Tested by tests/cli/batch_test.cpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/jobs.h"
#include "batch/record.h"

namespace relievo::app::batch {

// A kind of file to make from each scan.
struct OutputKind {
  std::string name;    // name of a format of export_file.h, or "report"
  std::string ending;  // appended to the job's name: ".stl", "-heights.png"
  std::string flag;    // the flag of `make` that sets the path of this file
};

// Returns the names of all kinds as a text: "stl, 3mf, ... or report".
std::string output_kind_names();

// Parses a list of kinds such as "stl,preview,report". Adds the preview, which the pages need. Errors: kind option
// if the list has an unknown word, two solids, two height maps, or neither a solid nor a height map.
Result<std::vector<OutputKind>> parse_output_kinds(std::string_view list);

// Returns the path of an output, relative to the folder of the outputs.
std::string output_name(const Job& job, const OutputKind& kind);

// The error of a call of `relievo`. `may_succeed`: the same call may succeed later.
struct MakeError {
  std::string line;
  bool may_succeed = false;
};
// Runs `relievo ARGUMENTS` in this process. Returns the error, or nothing after a success.
using MakeCall = std::function<std::optional<MakeError>(const std::vector<std::string>& arguments)>;

// The settings that all jobs of a run share.
struct RunSettings {
  std::string outputs;  // path of the folder of the outputs
  std::vector<OutputKind> kinds;
  MakeCall make;
};

struct PlannedJob {
  Job job;
  std::optional<Record> before;  // the job's record from the last run
  double need_mb = 0;
};

struct JobResult {
  bool is_kept = false;  // nothing was done, since the record of the last run is still valid
  Record record;
};

// Makes the outputs of a job unless they are up to date. They are up to date if this version made them from
// the same contents and options, and if their sizes have not changed since then. A failed job is repeated
// only if something that determines its outputs has changed, or if Record::may_succeed is true.
JobResult perform(const PlannedJob& planned, const RunSettings& settings, int threads);

// Returns the arguments with which `make` does the job.
std::vector<std::string> make_arguments(const Job& job, const RunSettings& settings, int threads);

}  // namespace relievo::app::batch
