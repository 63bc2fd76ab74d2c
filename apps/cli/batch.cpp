#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "batch/finish.h"
#include "batch/memory_need.h"
#include "batch/run.h"
#include "cli/commands.h"
#include "cli/flags.h"
#include "cli/program.h"
#include "cli/terminal.h"
#include "common/files.h"
#include "common/read_inputs.h"
#include "relievo/core/text.h"

namespace relievo::app::cli {
namespace {

namespace fs = std::filesystem;

struct BatchArguments : MakeOptions {
  std::string input, outputs, kinds = "stl,preview", match, shard;
  std::vector<std::string> jobs;
  bool is_list = false, is_finish = false, is_quiet = false, tries_failed_again = false;
  batch::RunLimits limits;
};

// The jobs of a run, the folder of their outputs, and the kinds of files to make.
struct BatchOrder {
  std::vector<batch::Job> jobs;
  batch::RunSettings settings;
  std::vector<std::string> skipped = {};  // files of the folder that no job has as its scan
};

// ------------------------------------------------------------------------------------------------- options

// Returns the names, without dashes, of the options that `make` and `batch` have in common.
const std::set<std::string>& shared_options() {
  static const std::set<std::string> names = [] {
    MakeOptions unused;
    CLI::App command;
    command.set_help_flag();
    add_make_options(command, unused);
    std::set<std::string> found;
    for (const CLI::Option* option : command.get_options())
      if (!option->get_name().empty()) found.insert(option->get_name().substr(2));  // aliases lack names
    return found;
  }();
  return names;
}

batch::Options given_options(const CLI::App& command) {
  batch::Options options;
  for (const std::string& name : shared_options()) {
    const CLI::Option* const option = command.get_option("--" + name);
    if (option->count() > 0) options[name] = option->results().back();
  }
  return options;
}

// One of the `count` parts into which the jobs are divided. The first part has the index 1.
struct Shard {
  std::size_t index = 1, count = 1;
};

Result<Shard> parse_shard(const std::string& text) {
  if (text.empty()) return Shard{};
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto [slash, failed] = std::from_chars(text.data(), end, shard.index);
  const bool has_slash = failed == std::errc{} && slash != end && *slash == '/';
  const auto last = has_slash ? std::from_chars(slash + 1, end, shard.count) : std::from_chars_result{};
  if (!has_slash || last.ec != std::errc{} || last.ptr != end || shard.index < 1 || shard.index > shard.count)
    return option_error("shard", cat("expected a part of parts, as 3/16, found '", text, "'"));
  return shard;
}

// Returns every count-th job. Neighbouring scans in a catalogue are often alike, so this choice makes all shards
// take about equally long.
std::vector<batch::Job> jobs_of_shard(const std::vector<batch::Job>& jobs, const Shard& shard) {
  std::vector<batch::Job> part;
  for (std::size_t i = shard.index - 1; i < jobs.size(); i += shard.count) part.push_back(jobs[i]);
  return part;
}

std::optional<batch::MakeError> call_make(const std::vector<std::string>& arguments) {
  const ProgramEnd end = run_program(arguments);
  if (end.exit_code == 0) return std::nullopt;
  return batch::MakeError{end.message, end.may_succeed};
}

Result<batch::RunSettings> settings_of(const BatchArguments& arguments) {
  if (arguments.outputs.empty()) return option_error("output", "expected a folder, found none");
  RELIEVO_TRY(std::vector<batch::OutputKind> kinds, batch::parse_output_kinds(arguments.kinds));
  return batch::RunSettings{fs::absolute(arguments.outputs).lexically_normal().string(), std::move(kinds),
                            call_make};
}

Result<BatchOrder> order_of(const BatchArguments& arguments, const CLI::App& command) {
  if (arguments.input.empty()) return option_error("input", "expected a folder or a table, found none");
  // The options that apply to all scans are checked here, before the first job. A wrong option in a row of
  // the table only makes the job of that row fail.
  RELIEVO_CHECK(parse_options(arguments.order.values));
  RELIEVO_CHECK(parse_unit(arguments.units));
  BatchOrder order;
  RELIEVO_TRY(order.settings, settings_of(arguments));
  const auto is_option = [](const std::string& name) { return shared_options().contains(name); };
  batch::Catalogue catalogue{arguments.input, arguments.match, order.settings.outputs,
                             given_options(command)};
  for (const batch::OutputKind& kind : order.settings.kinds) catalogue.endings.push_back(kind.ending);
  RELIEVO_TRY(order.jobs, batch::list_jobs(catalogue, is_option));
  order.skipped = batch::skipped_files(catalogue, order.jobs);
  RELIEVO_CHECK(arguments.is_list ? batch::check_output_folder(arguments.outputs)
                                  : batch::make_output_folder(arguments.outputs));
  return order;
}

// -------------------------------------------------------------------------------------------------- modes

std::vector<batch::PlannedJob> planned_jobs(const std::vector<batch::Job>& jobs,
                                            const BatchArguments& arguments,
                                            const batch::RunSettings& settings) {
  const batch::Records records = batch::read_journals(settings.outputs);
  std::vector<batch::PlannedJob> all;
  for (const batch::Job& job : jobs) {
    batch::PlannedJob& planned = all.emplace_back(job, std::nullopt, batch::memory_need_mb(job));
    const auto found = records.find(job.name);
    if (found == records.end() || (arguments.tries_failed_again && !found->second.is_made)) continue;
    planned.before = found->second;
  }
  return all;
}

// Returns an error if a job has failed or is not done yet. Otherwise prints the number of reliefs.
Result<void> summarise(const std::vector<batch::Job>& jobs, const batch::RunSettings& settings, bool is_quiet,
                       const std::string& page) {
  const batch::Summary sum = batch::summary_of(jobs, batch::read_journals(settings.outputs));
  const std::string see = page.empty() ? "" : cat("; see ", page);
  if (sum.failed + sum.missing > 0)
    return std::unexpected(Error{
        ErrorKind::geometry,
        settings.outputs,
        {},
        cat("expected ", jobs.size(), jobs.size() == 1 ? " relief" : " reliefs", ", made ", sum.made, "; ",
            sum.failed, " failed", sum.missing > 0 ? cat(", ", sum.missing, " are not done yet") : "", see)});
  if (!is_quiet) std::fprintf(stderr, "%s: %zu reliefs%s\n", settings.outputs.c_str(), sum.made, see.c_str());
  return {};
}

void print_facts(const BatchOrder& order, const batch::Records& records) {
  const auto print = [](const std::string& line) { std::fprintf(stderr, "%s\n", on_one_line(line).c_str()); };
  if (!order.skipped.empty()) print(cat("not taken for scans: ", joined(order.skipped)));
  for (const auto& names : batch::same_scans(order.jobs, records))
    print(cat("the same scan, with the same options: ", joined(names)));
}

Result<void> finish_run(const BatchOrder& order, bool is_quiet) {
  const batch::Records records = batch::read_journals(order.settings.outputs);
  RELIEVO_CHECK(batch::finish(order.jobs, records, order.settings));
  if (!is_quiet) print_facts(order, records);
  return summarise(order.jobs, order.settings, is_quiet,
                   (fs::path(order.settings.outputs) / "index.html").string());
}

// Prints one line per job. The flag `--job` takes such a line and does that job, on any machine.
Result<void> list(const BatchOrder& order, const BatchArguments& arguments) {
  for (const batch::PlannedJob& planned : planned_jobs(order.jobs, arguments, order.settings)) {
    nlohmann::json json = to_json(planned.job);
    json["need_mb"] = planned.need_mb;
    if (planned.before) json["before"] = to_json(*planned.before);
    std::printf("%s\n", json.dump().c_str());
  }
  return {};
}

// Returns the job's record from the journals; nothing if the record or the first output is missing. The line
// that list() printed for the job had no record, so the job was done after that. This happens if Dask
// (python/relievo/batch.py) gives the job of a dead worker to another worker: the program that the dead
// worker started may have done the job meanwhile.
std::optional<batch::Record> made_since_listed(const batch::Job& job, const batch::RunSettings& settings) {
  const std::string output = batch::output_name(job, settings.kinds.front());
  if (std::error_code ignored; !fs::exists(fs::path(settings.outputs) / output, ignored)) return std::nullopt;
  const batch::Records records = batch::read_journals(settings.outputs);
  const auto found = records.find(job.name);
  return found == records.end() ? std::nullopt : std::optional(found->second);
}

// Does the job that a line from list() describes, and prints the job's record.
Result<batch::Record> do_job(const std::string& listed, const batch::RunSettings& settings,
                             const batch::Journal& journal) {
  const auto json = nlohmann::json::parse(listed, nullptr, false);
  RELIEVO_TRY(batch::Job job, batch::job_from_json(json));
  RELIEVO_TRY(const Descriptor lock, batch::lock_job(settings.outputs, job.name));
  batch::PlannedJob planned{std::move(job), std::nullopt, 0};
  if (json.contains("before")) planned.before = batch::record_from_line(json["before"].dump());
  if (!planned.before) planned.before = made_since_listed(planned.job, settings);
  batch::Processes processes(settings);
  RELIEVO_CHECK(processes.start(planned, 1));
  const batch::JobResult result = processes.wait();
  if (!result.is_kept) RELIEVO_CHECK(journal.append(result.record));
  nlohmann::json line = to_json(result.record);
  line["is_kept"] = result.is_kept;
  std::printf("%s\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  // If no process reads the records any more, the flush fails and the program ends.
  if (std::fflush(stdout) != 0)
    return system_error(ErrorKind::output, planned.job.name, "expected a reader of records");
  return result.record;
}

// Does the jobs one after the other. A failed job does not stop the others.
Result<void> do_jobs(const BatchArguments& arguments) {
  RELIEVO_TRY(const batch::RunSettings settings, settings_of(arguments));
  RELIEVO_CHECK(batch::make_output_folder(arguments.outputs));
  RELIEVO_TRY(const batch::Journal journal, batch::Journal::open(settings.outputs));
  std::string failed;
  for (const std::string& listed : arguments.jobs) {
    RELIEVO_TRY(const batch::Record record, do_job(listed, settings, journal));
    if (!record.is_made) failed += cat(failed.empty() ? "" : "\n", record.error);
  }
  if (failed.empty()) return {};
  return geometry_error(failed);
}

// Shows on standard error how many jobs are done: a bar with the remaining time if standard error is a
// terminal, otherwise a line after every 5 % of the jobs. In both cases prints a line for each failed job.
class BatchProgress {
 public:
  BatchProgress(std::size_t jobs, bool is_quiet)
      : jobs_(jobs), is_quiet_(is_quiet), is_terminal_(::isatty(STDERR_FILENO) != 0) {}
  BatchProgress(const BatchProgress&) = delete;
  BatchProgress& operator=(const BatchProgress&) = delete;
  ~BatchProgress() {
    if (is_terminal_ && !is_quiet_) std::fputs("\r\x1b[K", stderr);
  }

  // Shows that a job has ended; `done` is the number of jobs that have ended so far.
  void show(const batch::JobResult& result, std::size_t done) {
    if (result.is_kept) ++kept_;
    if (!result.record.is_made) ++failed_;
    const char* const clear = is_terminal_ ? "\r\x1b[K" : "";
    if (!result.record.is_made && !result.is_kept && !is_quiet_)
      std::fprintf(stderr, "%sfailed: %s: %s\n", clear, on_one_line(result.record.name).c_str(),
                   on_one_line(result.record.error).c_str());
    if (is_quiet_) return;
    const std::size_t twentieth = std::max<std::size_t>(1, jobs_ / 20);
    if (is_terminal_)
      std::fprintf(stderr, "\r\x1b[K%s", line(done).c_str());
    else if (done % twentieth == 0 || done == jobs_)
      std::fprintf(stderr, "%s\n", line(done).c_str());
    std::fflush(stderr);
  }

 private:
  std::string line(std::size_t done) const {
    std::string text = cat(done, " of ", jobs_);
    if (kept_ > 0) text += cat(", ", kept_, " done before");
    if (failed_ > 0) text += cat(", ", failed_, " failed");
    text += time_left(done);
    if (!is_terminal_) return text;
    constexpr std::size_t width = 30;
    std::string bar(width, '-');
    const std::size_t filled = width * done / std::max<std::size_t>(1, jobs_);
    bar.replace(0, filled, filled, '#');
    return cat("[", bar, "] ", text);
  }

  // Jobs that an earlier run completed take no time now, so the estimate does not count them.
  std::string time_left(std::size_t done) const {
    const std::size_t made = done - std::min(done, kept_);
    if (made == 0 || done == jobs_) return {};
    const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - started_;
    const double seconds = so_far.count() / static_cast<double>(made) * static_cast<double>(jobs_ - done);
    if (seconds < 90) return cat(", ", std::ceil(seconds), " s left");
    if (seconds < 5400) return cat(", ", std::ceil(seconds / 60), " min left");
    return cat(", ", std::ceil(seconds / 360) / 10, " h left");
  }

  std::size_t jobs_;
  bool is_quiet_, is_terminal_;
  std::size_t failed_ = 0, kept_ = 0;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

Result<void> run_all(const BatchOrder& order, const BatchArguments& arguments, const Shard& shard) {
  const bool is_part = shard.count > 1;
  RELIEVO_TRY(
      const Descriptor lock,
      batch::lock_run(order.settings.outputs, is_part ? cat("-", shard.index, "-of-", shard.count) : ""));
  RELIEVO_TRY(const batch::Journal journal, batch::Journal::open(order.settings.outputs));
  const std::vector<batch::Job> jobs = jobs_of_shard(order.jobs, shard);
  {
    const std::vector<batch::PlannedJob> planned = planned_jobs(jobs, arguments, order.settings);
    BatchProgress progress(jobs.size(), arguments.is_quiet);
    const auto show = [&](const batch::JobResult& result, std::size_t done) { progress.show(result, done); };
    RELIEVO_CHECK(batch::run(planned, order.settings, arguments.limits, journal, show));
  }
  if (is_part) return summarise(jobs, order.settings, arguments.is_quiet, "");
  return finish_run(order, arguments.is_quiet);
}

Result<void> batch_command(const BatchArguments& arguments, const CLI::App& command) {
  if (!arguments.jobs.empty()) return do_jobs(arguments);
  RELIEVO_TRY(const Shard shard, parse_shard(arguments.shard));
  RELIEVO_TRY(const BatchOrder order, order_of(arguments, command));
  if (arguments.is_list) return list(order, arguments);
  if (arguments.is_finish) return finish_run(order, arguments.is_quiet);
  return run_all(order, arguments, shard);
}

// -------------------------------------------------------------------------------------------------- flags

void add_modes(CLI::App& command, BatchArguments& arguments) {
  auto* const shard = command.add_option(
      "--shard", arguments.shard, "do only this part of the scans, as 3/16; --pages comes after all parts");
  shard->type_name("I/N");
  auto* const list =
      command.add_flag("--list", arguments.is_list, "print a line of JSON for each scan and do none");
  auto* const finish = command.add_flag("--pages", arguments.is_finish, "do no scan, write the pages only");
  auto* const job = command.add_option(
      "--job", arguments.jobs, "do the scan of a line that --list has printed; may be given several times");
  job->type_name("JSON")->allow_extra_args(false);
  for (CLI::Option* mode : {list, finish, job}) mode->excludes(shard);
  list->excludes(finish)->excludes(job);
  finish->excludes(job);
}

}  // namespace

void add_batch(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<BatchArguments>();
  CLI::App& command = *program.add_subcommand("batch", "Make reliefs of a whole catalogue of scans");
  command
      .add_option(
          "input", arguments->input,
          "a folder of scans, or a table (CSV): a column 'file', perhaps 'name', and any option below")
      ->type_name("INPUT");
  command.add_option("-o,--output", arguments->outputs, "folder of the reliefs and the pages about them")
      ->type_name("FOLDER");
  command
      .add_option("--files", arguments->kinds,
                  cat("what is made of each scan, at most one solid and one height map: ",
                      batch::output_kind_names()))
      ->type_name("LIST")
      ->capture_default_str();
  command.add_option("--match", arguments->match, "only files of a folder with such names, as '*.ply'")
      ->type_name("PATTERN");
  add_number(command, "--jobs", arguments->limits.processes, CLI::Range(0, 4096),
             "most scans at the same time, 0 for one per processor [0 to 4096]");
  command
      .add_option("--memory", arguments->limits.memory_mb,
                  "memory for all of them in MB; default: most of what is available")
      ->type_name("MB");
  command.add_flag("--retry", arguments->tries_failed_again, "try failed scans again that have not changed");
  add_modes(command, *arguments);
  command.add_flag("--quiet", arguments->is_quiet, "print errors only");
  add_make_options(command, *arguments);
  command.callback([arguments, &command, &result] { result = batch_command(*arguments, command); });
}

}  // namespace relievo::app::cli
