// Lists the scans of a catalogue, each with the options of its relief. Tested by
// tests/cli/batch_jobs_test.cpp.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "relievo/core/error.h"

namespace relievo::app::batch {

// Maps names of flags of `make`, without their dashes, to values as typed.
using Options = std::map<std::string, std::string>;

struct Job {
  std::string name;  // path of the outputs, without ending, relative to the folder of all outputs
  std::string file;  // absolute, so that any machine that shares the file system finds it
  Options options;
};

struct Catalogue {
  std::string path;     // a folder or a table
  std::string match;    // a pattern of file names such as "*.ply", for folders; empty: all readable scans
  std::string outputs;  // the folder of the outputs, which is not searched for scans
  Options common;       // options for scans without values of their own
};

// Returns the jobs of a folder and of the folders in it, in the order of their paths, or the jobs of a table
// (see table.h), row by row. Pictures beside clouds or meshes are taken for textures and left out. A table
// has the columns `file`, relative to the table; optionally `name`, the name of the outputs; and the options
// for which is_option() is true. An empty cell stands for the common value. A job without a name is called
// like its file; the second job of that name gets -2. Errors: kind input if the path cannot be read or there
// are no scans, if a row has no file, and for names that are not unique or lead out of the folder; kind
// option for other columns.
Result<std::vector<Job>> list_jobs(const Catalogue& catalogue,
                                   const std::function<bool(const std::string&)>& is_option);

// If the catalogue is a folder, returns the files in it that no job reads as its scan, in order and relative
// to the folder. Hidden files and files in the folder of the outputs are left out. If the catalogue is a
// table, returns nothing.
std::vector<std::string> skipped_files(const Catalogue& catalogue, const std::vector<Job>& jobs);

// Returns the files that the job reads: its scan, the files that a scene, a project or a glTF file names, and
// the files that options name. A file that is missing or cannot be parsed adds no others.
std::vector<std::string> files_of(const Job& job);

// Returns whether the value of the option is the path of a file.
bool is_path(const std::string& option, const std::string& value);

nlohmann::json to_json(const Job& job);

// Returns the job from an object that to_json() made. Errors: kind input.
Result<Job> job_from_json(const nlohmann::json& json);

}  // namespace relievo::app::batch
