// Reads tables in CSV, as spreadsheets save them. Tested by tests/cli/batch_jobs_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"

namespace relievo::app::batch {

struct TableRow {
  std::size_t line = 0;  // the line of the file in which the row begins
  std::vector<std::string> cells;
};

struct Table {
  std::vector<std::string> columns;  // the first row
  std::vector<TableRow> rows;        // each with a cell for every column
};

// Returns the table in the text of the file called `name`. Cells are separated by commas, semicolons or tabs:
// by the one of these that comes first in the first row. A cell in quotation marks may contain separators,
// line breaks, and quotation marks, which are doubled. Missing cells at the end of a row are empty; rows of
// empty cells are left out. Errors: kind input, naming the line, for a table without columns, a column
// without a name or with the name of another, more cells than columns, and a quotation mark that is never
// closed.
Result<Table> read_table(std::string_view text, const std::string& name);

}  // namespace relievo::app::batch
