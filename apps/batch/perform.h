// Performs one job, from its inputs to its outputs. Tested by tests/cli/batch_test.cpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/jobs.h"
#include "batch/record.h"

namespace relievo::app::batch {

// A kind of file that is made of each scan.
struct OutputKind {
  std::string name;    // the name of a format of export_file.h, or "report"
  std::string ending;  // appended to the name of the job: ".stl", "-heights.png"
  std::string flag;    // the flag of `make` that asks for such a file
};

// Returns the kinds of a list such as "stl,preview,report". The preview is always among them, because the
// pages need it. Errors: kind option for other words, for two solids or two height maps, and for neither.
Result<std::vector<OutputKind>> parse_output_kinds(std::string_view list);

// Returns the path of an output, relative to the folder of the outputs.
std::string output_name(const Job& job, const OutputKind& kind);

// The error of a call. If `may_succeed` is true, the same call may succeed another time.
struct MakeError {
  std::string line;
  bool may_succeed = false;
};
// Runs `relievo ARGUMENTS` in this process.
using MakeCall = std::function<std::optional<MakeError>(const std::vector<std::string>& arguments)>;

struct Workshop {
  std::string outputs;  // the folder
  std::vector<OutputKind> kinds;
  MakeCall make;
};

struct Work {
  Job job;
  std::optional<Record> before;  // the job's record of the last run
  double need_mb = 0;
};

struct Performed {
  bool is_kept = false;  // whether nothing was done, as the record of the last run is still true
  Record record;
};

// Makes the outputs of a job unless they are up to date: this version made them from the same file contents
// and options, and they still have the recorded sizes. A failed job is not repeated if its error would occur
// again.
Performed perform(const Work& work, const Workshop& workshop, int threads);

// Returns the arguments of `make` for the job.
std::vector<std::string> make_arguments(const Job& job, const Workshop& workshop, int threads);

}  // namespace relievo::app::batch
