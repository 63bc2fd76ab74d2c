#include "batch/table.h"

#include <algorithm>

#include "relievo/core/text.h"

namespace relievo::app::batch {
namespace {

class TableReader {
 public:
  TableReader(std::string_view text, const std::string& name) : text_(text), name_(name) {
    if (text_.starts_with("\xEF\xBB\xBF"))
      text_.remove_prefix(3);  // skips the byte order mark, which some spreadsheets write
    separator_ = find_separator();
  }

  Result<Table> read() {
    Table table;
    RELIEVO_TRY(TableRow first, read_row());
    table.columns = std::move(first.cells);
    RELIEVO_CHECK(check_columns(table.columns));
    while (!text_.empty()) {
      RELIEVO_TRY(TableRow row, read_row());
      if (std::ranges::all_of(row.cells, &std::string::empty)) continue;
      if (row.cells.size() > table.columns.size())
        return fail(row.line, cat("expected ", table.columns.size(), " cells as in the first row, found ",
                                  row.cells.size()));
      row.cells.resize(table.columns.size());
      table.rows.push_back(std::move(row));
    }
    return table;
  }

 private:
  std::unexpected<Error> fail(std::size_t line, std::string expected) const {
    return input_error(name_, cat("line ", line), std::move(expected));
  }

  char find_separator() const {
    const std::string_view first = text_.substr(0, text_.find_first_of("\r\n"));
    const std::size_t at = first.find_first_of(",;\t");
    return at == std::string_view::npos ? ',' : first[at];
  }

  Result<void> check_columns(const std::vector<std::string>& columns) const {
    for (const std::string& column : columns) {
      if (column.empty()) return fail(1, "expected a name for each column, found none");
      if (std::ranges::count(columns, column) > 1)
        return fail(1, cat("expected columns of different names, found '", column, "' twice"));
    }
    return {};
  }

  Result<TableRow> read_row() {
    TableRow row{line_, {}};
    for (;;) {
      RELIEVO_TRY(std::string cell, read_cell());
      row.cells.push_back(std::move(cell));
      if (text_.empty()) return row;
      const char end = text_[0];
      text_.remove_prefix(end == '\r' && text_.starts_with("\r\n") ? 2 : 1);
      if (end == separator_) continue;
      ++line_;
      return row;
    }
  }

  // Reads the text up to the next separator or line break, without the blanks around it.
  Result<std::string> read_cell() {
    const std::string ends = cat(separator_, "\r\n");
    const std::size_t start = text_.find_first_not_of(' ');
    if (start != std::string_view::npos && text_[start] == '"') {
      text_.remove_prefix(start + 1);
      return read_quoted(ends);
    }
    const std::string_view cell = text_.substr(0, text_.find_first_of(ends));
    text_.remove_prefix(cell.size());
    const std::size_t first = cell.find_first_not_of(' ');
    if (first == std::string_view::npos) return std::string();
    return std::string(cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
  }

  Result<std::string> read_quoted(const std::string& ends) {
    const std::size_t line = line_;
    std::string cell;
    for (;;) {
      const std::size_t mark = text_.find('"');
      if (mark == std::string_view::npos)
        return fail(line, "expected a second quotation mark after the first, found none");
      line_ += static_cast<std::size_t>(std::ranges::count(text_.substr(0, mark), '\n'));
      cell += text_.substr(0, mark);
      text_.remove_prefix(mark + 1);
      if (!text_.starts_with('"')) break;
      cell += '"';
      text_.remove_prefix(1);
    }
    const std::string_view rest = text_.substr(0, text_.find_first_of(ends));
    if (rest.find_first_not_of(' ') != std::string_view::npos)
      return fail(line_, cat("expected the end of the cell after its quotation mark, found '", rest, "'"));
    text_.remove_prefix(rest.size());
    return cell;
  }

  std::string_view text_;  // the text that is not read yet
  const std::string& name_;
  char separator_ = ',';
  std::size_t line_ = 1;
};

}  // namespace

Result<Table> read_table(std::string_view text, const std::string& name) {
  return TableReader(text, name).read();
}

}  // namespace relievo::app::batch
