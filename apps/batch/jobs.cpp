#include "batch/jobs.h"

#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "common/files.h"
#include "common/wording.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"
#include "relievo/option_table.h"

namespace relievo::app::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string absolute_path(const fs::path& path) {
  return fs::absolute(path).lexically_normal().string();
}

bool is_picture_name(const std::string& path) {
  constexpr std::array endings = {"png", "tif", "tiff", "bmp", "jpg", "jpeg"};
  return std::ranges::find(endings, ending_of(path)) != endings.end();
}

bool is_scan_name(const std::string& path) {
  const std::vector<std::string> endings = readable_endings();
  const std::string ending = cat(".", ending_of(path));
  return std::ranges::find(endings, ending) != endings.end() || ending == ".relievo";
}

// Returns whether the pages may have a picture of this name: contact-sheet.png, contact-sheet-2.png and so
// on.
bool is_of_pages(const std::string& name) {
  return name == "contact-sheet" || name.starts_with("contact-sheet-");
}

// Gives each job a name such that no two outputs of a run are the same file.
class Names {
 public:
  explicit Names(const std::vector<std::string>& endings) : endings_(endings) { endings_.emplace_back(); }

  std::string unused(const std::string& name) {
    const std::string start = is_of_pages(name) ? "scan-" + name : name;
    std::string unused = start;
    for (int i = 2; !take(unused); ++i) unused = cat(start, "-", i);
    return unused;
  }
  // Returns false if the job would write a file of another job, or a picture that the pages show.
  bool take(const std::string& name) {
    if (is_of_pages(name)) return false;
    const auto is_taken = [&](const std::string& ending) { return taken_.contains(name + ending); };
    if (std::ranges::any_of(endings_, is_taken)) return false;
    for (const std::string& ending : endings_) taken_.insert(name + ending);
    return true;
  }

 private:
  std::vector<std::string> endings_;
  std::set<std::string> taken_;
};

// Returns whether the text is UTF-8. nlohmann::json throws on any other text when a job is printed. For a
// text that is not UTF-8, leaving out the wrong bytes and replacing them give different results.
bool is_utf8(const std::string& text) {
  using Handler = Json::error_handler_t;
  const Json json = text;
  return json.dump(-1, ' ', false, Handler::ignore) == json.dump(-1, ' ', false, Handler::replace);
}

Result<void> check_texts(const Job& job, const std::string& catalogue) {
  std::vector<std::string> texts{job.name, job.file};
  for (const auto& [option, value] : job.options) texts.push_back(value);
  const auto wrong = std::ranges::find_if_not(texts, is_utf8);
  if (wrong == texts.end()) return {};
  return input_error(catalogue, {},
                     cat("expected names and options in UTF-8, found ",
                         Json(*wrong).dump(-1, ' ', false, Json::error_handler_t::replace)));
}

// ------------------------------------------------------------------------------------------------- folders

// Returns the sorted paths of the files in the folder and its subfolders. Leaves out hidden files, hidden
// folders and the folder of the outputs.
Result<std::vector<fs::path>> files_in(const Catalogue& catalogue) {
  std::error_code failed;
  std::vector<fs::path> paths;
  const fs::path outputs = fs::weakly_canonical(catalogue.outputs, failed);
  for (fs::recursive_directory_iterator entry(catalogue.path, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    if (entry->is_directory(ignored)) {
      if (name.starts_with('.') || fs::weakly_canonical(entry->path(), ignored) == outputs)
        entry.disable_recursion_pending();
      continue;
    }
    if (!name.starts_with('.')) paths.push_back(entry->path());
  }
  if (failed)
    return input_error(catalogue.path, {}, cat("expected a folder that can be read: ", failed.message()));
  std::ranges::sort(paths);
  return paths;
}

void leave_out_textures(std::vector<fs::path>& paths) {
  std::set<fs::path> with_models;
  for (const fs::path& path : paths)
    if (!is_picture_name(path.string())) with_models.insert(path.parent_path());
  std::erase_if(paths, [&](const fs::path& path) {
    return is_picture_name(path.string()) && with_models.contains(path.parent_path());
  });
}

Result<std::vector<Job>> jobs_of_folder(const Catalogue& catalogue) {
  RELIEVO_TRY(std::vector<fs::path> paths, files_in(catalogue));
  std::erase_if(paths, [&](const fs::path& path) {
    const std::string name = path.filename().string();
    return catalogue.match.empty() ? !is_scan_name(name)
                                   : ::fnmatch(catalogue.match.c_str(), name.c_str(), 0) != 0;
  });
  if (catalogue.match.empty()) leave_out_textures(paths);
  std::vector<Job> jobs;
  Names names(catalogue.endings);
  for (const fs::path& path : paths) {
    fs::path name = path.lexically_relative(catalogue.path);
    name.replace_extension();
    jobs.push_back({names.unused(name.generic_string()), absolute_path(path), catalogue.common});
  }
  return jobs;
}

// -------------------------------------------------------------------------------------------------- tables

bool is_inside(const std::string& name) {
  const fs::path path = fs::path(name).lexically_normal();
  return path.is_relative() && !path.empty() && path.has_filename() && *path.begin() != "..";
}

class TableJobs {
 public:
  TableJobs(const Table& table, const Catalogue& catalogue)
      : table_(table),
        catalogue_(catalogue),
        folder_(fs::path(catalogue.path).parent_path()),
        names_(catalogue.endings) {}

  Result<std::vector<Job>> list() {
    // The names in the column `name` are reserved first, so that no generated name equals one of them.
    for (const TableRow& row : table_.rows)
      if (const std::string& name = cell(row, "name"); !name.empty())
        if (!is_inside(name) || !names_.take(fs::path(name).lexically_normal().string()))
          return fail(
              row, cat("expected a name inside the folder whose files no other row and no page has, found '",
                       name, "'"));
    std::vector<Job> jobs;
    for (const TableRow& row : table_.rows) {
      if (cell(row, "file").empty()) return fail(row, "expected a file, found none");
      jobs.push_back(job_of(row));
    }
    return jobs;
  }

 private:
  std::unexpected<Error> fail(const TableRow& row, std::string expected) const {
    return input_error(catalogue_.path, cat("line ", row.line), std::move(expected));
  }

  const std::string& cell(const TableRow& row, std::string_view column) const {
    static const std::string none;
    const auto at = std::ranges::find(table_.columns, column) - table_.columns.begin();
    return at == std::ssize(table_.columns) ? none : row.cells[static_cast<std::size_t>(at)];
  }

  Job job_of(const TableRow& row) {
    const fs::path file = folder_ / cell(row, "file");
    const std::string& stated = cell(row, "name");
    Job job{
        stated.empty() ? names_.unused(file.stem().string()) : fs::path(stated).lexically_normal().string(),
        absolute_path(file), catalogue_.common};
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const std::string& column = table_.columns[i];
      const std::string& value = row.cells[i];
      if (column == "file" || column == "name" || value.empty()) continue;
      const std::string beside = (folder_ / value).string();
      job.options[column] = is_path(column, beside) ? absolute_path(beside) : value;
    }
    return job;
  }

  const Table& table_;
  const Catalogue& catalogue_;
  fs::path folder_;
  Names names_;
};

std::string nearest_column(const std::string& typed) {
  std::vector<std::string> names{"file", "name"};
  for (const OptionRow& option : option_table()) names.emplace_back(option.name);
  return nearest_name(typed, names);
}

Result<std::vector<Job>> jobs_of_table(const Catalogue& catalogue,
                                       const std::function<bool(const std::string&)>& is_option) {
  const std::string ending = ending_of(catalogue.path);
  const bool may_be_table = ending == "csv" || ending == "txt";  // scans may have these endings, too
  if (is_scan_name(catalogue.path) && !may_be_table)
    return input_error(catalogue.path, {},
                       "expected a folder of scans or a table of them, found a scan; see relievo make");
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(catalogue.path));
  RELIEVO_TRY(const Table table, read_table(text_in(bytes), catalogue.path));
  if (std::ranges::find(table.columns, "file") == table.columns.end())
    return input_error(catalogue.path, "line 1", "expected a column 'file', found none");
  for (const std::string& column : table.columns)
    if (column != "file" && column != "name" && !is_option(column)) {
      const std::string nearest = nearest_column(column);
      return option_error(catalogue.path,
                          cat("expected columns file, name and options of make, found '", column, "'",
                              nearest.empty() ? "" : cat(", the nearest is ", nearest)));
    }
  return TableJobs(table, catalogue).list();
}

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

Result<std::vector<Job>> list_jobs(const Catalogue& catalogue,
                                   const std::function<bool(const std::string&)>& is_option) {
  std::error_code ignored;
  Catalogue resolved = catalogue;
  for (auto& [option, value] : resolved.common)
    if (is_path(option, value)) value = absolute_path(value);
  if (!fs::exists(catalogue.path, ignored))
    return input_error(catalogue.path, {}, "expected a folder or a table, found none");
  const bool is_folder = fs::is_directory(catalogue.path, ignored);
  if (is_folder && fs::equivalent(catalogue.path, catalogue.outputs, ignored))
    return input_error(catalogue.path, {}, "expected another folder than that of the outputs");
  RELIEVO_TRY(std::vector<Job> jobs,
              is_folder ? jobs_of_folder(resolved) : jobs_of_table(resolved, is_option));
  if (jobs.empty()) return input_error(catalogue.path, {}, "expected scans, found none");
  for (const Job& job : jobs) RELIEVO_CHECK(check_texts(job, catalogue.path));
  return jobs;
}

std::vector<std::string> skipped_files(const Catalogue& catalogue, const std::vector<Job>& jobs) {
  std::error_code ignored;
  if (!fs::is_directory(catalogue.path, ignored)) return {};
  std::set<std::string> taken;
  for (const Job& job : jobs) taken.insert(job.file);
  std::vector<std::string> skipped;
  for (const fs::path& path : files_in(catalogue).value_or(std::vector<fs::path>()))
    if (!taken.contains(absolute_path(path)))
      skipped.push_back(path.lexically_relative(catalogue.path).generic_string());
  return skipped;
}

std::vector<InputFile> files_of(const Job& job) {
  std::vector<InputFile> files = files_read_with(job.file);
  for (const auto& [option, value] : job.options)
    for (std::string& file : files_in_option(option, value)) files.push_back({std::move(file)});
  return files;
}

Json to_json(const Job& job) {
  return {{"name", job.name}, {"file", job.file}, {"options", job.options}};
}

Result<Job> job_from_json(const Json& json) {
  const auto is_text = [](const Json& value) { return value.is_string(); };
  if (!json.is_object()) return input_error("job", {}, "expected a job in JSON");
  const Json name = json.value("name", Json()), file = json.value("file", Json()),
             options = json.value("options", Json::object());
  if (!is_text(name) || !is_text(file) || !options.is_object() || !std::ranges::all_of(options, is_text))
    return input_error("job", {}, "expected an object with name, file and options, as --list prints it");
  if (!is_inside(name)) return input_error("job", "name", "expected a name inside the folder");
  return Job{name, file, options.get<Options>()};
}

Result<Table> read_table(std::string_view text, const std::string& name) {
  return TableReader(text, name).read();
}

}  // namespace relievo::app::batch
