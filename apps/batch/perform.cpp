#include "batch/perform.h"

#include <algorithm>
#include <filesystem>

#include "batch/memory_need.h"
#include "common/export_file.h"
#include "common/files.h"
#include "common/project.h"
#include "relievo/core/choice.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"

namespace relievo::app::batch {
namespace {

namespace fs = std::filesystem;

std::string flag_of(const FileFormat& format) {
  if (format.write_solid) return "--output";
  return format.name == "preview" ? "--preview" : "--heightmap";
}

std::vector<OutputKind> all_kinds() {
  std::vector<OutputKind> kinds;
  for (const FileFormat& format : file_formats())
    kinds.push_back({std::string(format.name), std::string(format.ending), flag_of(format)});
  kinds.push_back({"report", ".json", "--report"});
  return kinds;
}

// Returns a hash of everything that determines the outputs: the contents of the files, the options and the
// version. Errors: those of read_file() for the job's scan.
Result<std::string> hash_of_input(const Job& job, const std::vector<OutputKind>& kinds) {
  std::string text = cat("relievo ", version);
  for (const InputFile& file : files_of(job)) {
    const Result<std::string> content = hash_of_file(file.path);
    if (!content && file.path == job.file) return content;
    text += cat("\n", content.value_or("missing"));
  }
  for (const auto& [option, value] : job.options)
    text += cat("\n", option, "=", is_path(option, value) ? "file" : value);
  for (const OutputKind& kind : kinds) text += cat("\n", kind.name);
  return hash_of(text);
}

bool are_there(const std::map<std::string, std::uintmax_t>& outputs, const std::string& folder) {
  return std::ranges::all_of(outputs, [&](const auto& output) {
    std::error_code failed;
    return fs::file_size(fs::path(folder) / output.first, failed) == output.second && !failed;
  });
}

bool is_still_true(const Record& before, const std::string& hash, const RunSettings& settings) {
  if (before.hash != hash || (!before.is_made && before.may_succeed)) return false;
  return !before.is_made || are_there(before.outputs, settings.outputs);
}

std::optional<MakeError> make_outputs(const Job& job, const RunSettings& settings, int threads) {
  if (const Result<void> made = make_output_folder(settings.outputs, fs::path(job.name).parent_path()); !made)
    return MakeError{cat(job.name, ": ", made.error().message()), true};
  return settings.make(make_arguments(job, settings, threads));
}

}  // namespace

std::string output_kind_names() {
  std::vector<std::string> names;
  for (const OutputKind& kind : all_kinds()) names.push_back(kind.name);
  return either({names.begin(), names.end()});
}

Result<std::vector<OutputKind>> parse_output_kinds(std::string_view list) {
  const std::vector<OutputKind> known = all_kinds();
  std::vector<OutputKind> kinds;
  const auto add = [&](std::string_view name) {
    const auto found = std::ranges::find(known, name, &OutputKind::name);
    if (found == known.end()) return false;
    if (std::ranges::find(kinds, name, &OutputKind::name) == kinds.end()) kinds.push_back(*found);
    return true;
  };
  for (std::string_view rest = list; !rest.empty();) {
    const std::string_view name = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), name.size() + 1));
    if (!add(name))
      return option_error("files", cat("expected ", output_kind_names(), ", found '", name, "'"));
  }
  add("preview");
  const auto count = [&](std::string_view flag) {
    return std::ranges::count(kinds, flag, &OutputKind::flag);
  };
  if (count("--output") > 1)
    return option_error("files", cat("expected one kind of solid, found ", count("--output")));
  if (count("--heightmap") > 1) return option_error("files", "expected one kind of height map, found 2");
  if (count("--output") + count("--heightmap") == 0)
    return option_error("files", "expected a kind of solid or of height map, found neither");
  // `make` requires --output. If no solid is wanted, --output is the path of the height map.
  if (count("--output") == 0) std::ranges::find(kinds, "--heightmap", &OutputKind::flag)->flag = "--output";
  return kinds;
}

std::string output_name(const Job& job, const OutputKind& kind) {
  return job.name + kind.ending;
}

std::vector<std::string> make_arguments(const Job& job, const RunSettings& settings, int threads) {
  // The pages show small previews. A job may ask for larger ones by its options.
  constexpr std::string_view usual_preview_px = "400";
  std::vector<std::string> arguments{"make", job.file, "--quiet", cat("--threads=", threads)};
  for (const OutputKind& kind : settings.kinds)
    arguments.push_back(cat(kind.flag, "=", (fs::path(settings.outputs) / output_name(job, kind)).string()));
  for (const auto& [option, value] : job.options) arguments.push_back(cat("--", option, "=", value));
  if (!job.options.contains("preview-size")) arguments.push_back(cat("--preview-size=", usual_preview_px));
  return arguments;
}

JobResult perform(const PlannedJob& planned, const RunSettings& settings, int threads) {
  JobResult result{false, {planned.job.name, planned.job.file}};
  Record& record = result.record;
  const Result<std::string> hash = hash_of_input(planned.job, settings.kinds);
  if (!hash) {
    record.error = hash.error().message();
    record.may_succeed = true;
    return result;
  }
  if (planned.before && is_still_true(*planned.before, *hash, settings)) return {true, *planned.before};
  record.hash = *hash;
  if (const std::optional<MakeError> error = make_outputs(planned.job, settings, threads)) {
    constexpr std::size_t longest = 4000;  // a longer record might not fit into the buffer of a pipe
    record.error = error->line.substr(0, longest);
    record.may_succeed = error->may_succeed;
    return result;
  }
  record.is_made = true;
  for (const OutputKind& kind : settings.kinds) {
    std::error_code ignored;
    const std::string name = output_name(planned.job, kind);
    record.outputs[name] = fs::file_size(fs::path(settings.outputs) / name, ignored);
  }
  return result;
}

}  // namespace relievo::app::batch
