// The scans of a catalogue, each with the options of its relief. Tested by tests/cli/batch_jobs_test.cpp.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "relievo/core/error.h"

namespace relievo::app::batch {

// Names of flags of `make`, without their dashes, and values as they are typed.
using Options = std::map<std::string, std::string>;

struct Job {
  std::string name;  // of the outputs, without ending, relative to the folder of all outputs
  std::string file;  // absolute, so that any machine that shares the file system finds it
  Options options;
};

struct Catalogue {
  std::string path;     // a folder or a table
  std::string match;    // a pattern of file names, "*.ply", for folders; empty: all that can be read
  std::string outputs;  // the folder of the outputs, which is left out
  Options common;       // for scans without an own value
};

// Returns the jobs of a folder and the folders in it, in the order of their paths, or of a table (see table.h), row by
// row. Pictures beside clouds or meshes are taken for textures and left out. A table has the columns `file`, relative to
// the table; perhaps `name`, of the outputs; and options, for which is_option() is true. An empty cell stands for the
// common value. Without names, a job is called as its file, and the second of that name gets -2.
// Errors: kind input if the path cannot be read or there are no scans, if a row has no file, and for names that are not
// unique or lead out of the folder; kind option for other columns.
Result<std::vector<Job>> list_jobs(const Catalogue& catalogue,
                                   const std::function<bool(const std::string&)>& is_option);

// Returns the files of a folder that are the file of no job, relative to it and in order; nothing for a table.
std::vector<std::string> skipped_files(const Catalogue& catalogue, const std::vector<Job>& jobs);

// Returns the files that the job reads: its own, those that a scene, a project or a glTF names, and those of options.
// Files that are not there or cannot be parsed name no others.
std::vector<std::string> files_of(const Job& job);

// Returns whether the value of the option is the path of a file.
bool is_path(const std::string& option, const std::string& value);

nlohmann::json to_json(const Job& job);

// Returns the job of an object as to_json() makes it. Errors: kind input.
Result<Job> job_from_json(const nlohmann::json& json);

}  // namespace relievo::app::batch
