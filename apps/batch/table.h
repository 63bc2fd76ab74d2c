// Reads tables in CSV, as spreadsheets save them. Tested by tests/cli/batch_jobs_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

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

}  // namespace relievo::app::batch
