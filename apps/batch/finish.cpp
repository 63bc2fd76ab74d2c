#include "batch/finish.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "batch/contact_sheet.h"
#include "batch/index_page.h"
#include "common/files.h"
#include "common/output_files.h"
#include "relievo/core/text.h"
#include "relievo/io/write.h"

namespace relievo::app::batch {
namespace {

namespace fs = std::filesystem;

constexpr int tile_px = 160;

const Record* made_record(const Job& job, const Records& records) {
  const auto found = records.find(job.name);
  return found != records.end() && found->second.is_made ? &found->second : nullptr;
}

Image8 tile_of(const Job& job, const Records& records, const RunSettings& settings) {
  if (!made_record(job, records)) return {};
  const auto preview = std::ranges::find(settings.kinds, "preview", &OutputKind::name);
  const auto bytes = read_file((fs::path(settings.outputs) / output_name(job, *preview)).string());
  return bytes ? tile_of_preview(read_png(*bytes), tile_px) : Image8{};
}

Result<void> write_file(const RunSettings& settings, std::string_view name, std::vector<std::byte> bytes) {
  const OutputFile file{(fs::path(settings.outputs) / name).string(), std::move(bytes)};
  return write_files({&file, 1});
}

Result<std::vector<std::string>> write_sheets(const std::vector<Job>& jobs, const Records& records,
                                              const RunSettings& settings) {
  std::vector<std::string> names;
  for (std::size_t first = 0; first < jobs.size(); first += tiles_per_sheet) {
    std::vector<Tile> tiles;
    for (std::size_t i = first; i < std::min(jobs.size(), first + tiles_per_sheet); ++i)
      tiles.push_back({tile_of(jobs[i], records, settings), jobs[i].name});
    names.push_back(names.empty() ? "contact-sheet.png" : cat("contact-sheet-", names.size() + 1, ".png"));
    RELIEVO_CHECK(write_file(settings, names.back(), write_png(contact_sheet(tiles, tile_px))));
  }
  return names;
}

}  // namespace

Summary summary_of(const std::vector<Job>& jobs, const Records& records) {
  Summary sum;
  for (const Job& job : jobs) {
    const auto found = records.find(job.name);
    ++(found == records.end() ? sum.missing : found->second.is_made ? sum.made : sum.failed);
  }
  return sum;
}

std::vector<std::vector<std::string>> same_scans(const std::vector<Job>& jobs, const Records& records) {
  std::map<std::string, std::vector<std::string>> by_hash;
  for (const Job& job : jobs)
    if (const Record* record = made_record(job, records)) by_hash[record->hash].push_back(job.name);
  std::vector<std::vector<std::string>> same;
  for (const auto& [hash, names] : by_hash)
    if (names.size() > 1) same.push_back(names);
  std::ranges::sort(same);
  return same;
}

Result<void> finish(const std::vector<Job>& jobs, const Records& records, const RunSettings& settings) {
  std::string lines;
  for (const Job& job : jobs)
    if (const auto found = records.find(job.name); found != records.end())
      lines +=
          cat(to_json(found->second).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), "\n");
  RELIEVO_CHECK(write_file(settings, "scans.jsonl", bytes_of(lines)));
  RELIEVO_TRY(const std::vector<std::string> sheets, write_sheets(jobs, records, settings));
  return write_file(settings, "index.html", bytes_of(index_page(jobs, records, settings, sheets)));
}

}  // namespace relievo::app::batch
