// One job from its inputs to its outputs. Tested by tests/cli/batch_test.cpp.
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
  std::string name;    // as a format of export_file.h, or "report"
  std::string ending;  // with its dot; what stands before it belongs to the name of the job
  std::string flag;    // of `make`
};

// Returns the kinds of a list such as "stl,preview,report". The preview is always among them: the pages need it. Errors:
// kind option for other words, for no solid or two of them, and for two height maps.
Result<std::vector<OutputKind>> parse_output_kinds(std::string_view list);

// Returns the path of an output, relative to the folder of the outputs.
std::string output_name(const Job& job, const OutputKind& kind);

// The error of a call. If `may_succeed` is true, another call may not have it.
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
  std::optional<Record> before;  // of the last run
  double need_mb = 0;
};

struct Performed {
  bool is_kept = false;  // nothing was to do: the record of the last run is still true
  Record record;
};

// Makes the outputs of a job, unless they are there already: the same contents of its files, options and version, and
// outputs of the recorded sizes. An error that will come again is not tried again, either.
Performed perform(const Work& work, const Workshop& workshop, int threads);

// The arguments of `make` for the job.
std::vector<std::string> make_arguments(const Job& job, const Workshop& workshop, int threads);

}  // namespace relievo::app::batch
