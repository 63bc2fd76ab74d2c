// Lists the scans of a catalogue, each with the options of its relief, and reads tables in CSV, as spreadsheets save
// them. Tested by tests/cli/batch_jobs_test.cpp.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "common/input_files.h"
#include "relievo/core/error.h"

namespace relievo::app::batch {

struct TableRow {
  std::size_t line = 0;  // number of the line in the file at which the row begins
  std::vector<std::string> cells;
};

struct Table {
  std::vector<std::string> columns;  // the cells of the first row
  std::vector<TableRow> rows;        // each row has a cell for every column
};

// Parses the table in the text of a file. Error messages call the file `name`. The separator is a comma, a semicolon
// or a tab, whichever occurs first in the first row. A cell in quotation marks may contain separators and line
// breaks; a quotation mark in it is doubled. Missing cells at the end of a row are empty. Rows in which all
// cells are empty are left out. Errors: kind input, with the line's number, for a table without columns, a
// column without a name, two columns with the same name, more cells than columns, and an unclosed quotation
// mark.
Result<Table> read_table(std::string_view text, const std::string& name);

// Maps the flags of `make`, without dashes, to their values as typed.
using Options = std::map<std::string, std::string>;

struct Job {
  std::string name;  // path of the output files without their endings, relative to Catalogue::outputs
  std::string file;  // absolute path, which is valid on all machines that share the file system
  Options options;
};

struct Catalogue {
  std::string path;     // a folder or a table
  std::string match;    // for a folder: a pattern of file names, such as "*.ply"; empty: all readable scans
  std::string outputs;  // the folder of the outputs, in which no scans are searched
  Options common;       // options of all scans; the table may override them for one scan
  std::vector<std::string> endings = {};  // endings of each job's outputs, appended to Job::name
};

// Returns the jobs of a folder and its subfolders, sorted by path, or the jobs of a table, row
// by row. In a folder that contains clouds or meshes, pictures count as textures and are left out. A table
// has a column `file`, with paths relative to the table. It may have a column `name` for Job::name, and a
// column for each option for which is_option() returns true. For an empty cell, the option's value in
// Catalogue::common applies. A job without a name is named after its file; -2 is appended if another job has
// that name or an output that this job would have. Errors: kind input if the path cannot be read, if there
// are no scans, if a row has no file, if a name in the table is not unique, if a name leads out of the
// folder, or if a text is not UTF-8; kind option if the table has any other column.
Result<std::vector<Job>> list_jobs(const Catalogue& catalogue,
                                   const std::function<bool(const std::string&)>& is_option);

// Returns those files of the catalogue's folder that are no job's scan. Their paths are sorted, and relative
// to that folder. Leaves out hidden files and the folder of the outputs. Returns nothing if the catalogue is
// a table.
std::vector<std::string> skipped_files(const Catalogue& catalogue, const std::vector<Job>& jobs);

// Returns the files that the job reads: its scan with the files to which it refers, and the files that options
// name.
std::vector<InputFile> files_of(const Job& job);

nlohmann::json to_json(const Job& job);

// Reads a job from the JSON that to_json() wrote. Errors: kind input.
Result<Job> job_from_json(const nlohmann::json& json);

}  // namespace relievo::app::batch
