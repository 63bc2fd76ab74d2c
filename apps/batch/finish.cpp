#include "batch/finish.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "batch/contact_sheet.h"
#include "common/files.h"
#include "common/output_files.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
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

// The browser lays out a card only when it scrolls into view, so that a page of 20,000 cards opens at once. A
// card shows the front view, which is the left half of the preview. While the pointer is on the card, the
// card shows the oblique view, which is the right half.
constexpr std::string_view style = R"(
:root { color-scheme: light dark; --paper: #ececea; --card: #fafaf8; --ink: #26262a; --soft: #6d6d72; --bad: #a3392c; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #1e1e20; --card: #2a2a2d; --ink: #e6e6e4; --soft: #9b9ba0; --bad: #ee8d80; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 100rem; padding: 2rem; font: 15px/1.45 system-ui, sans-serif; background: var(--paper);
  color: var(--ink); }
h1 { font-weight: 600; font-size: 1.6rem; margin: 0 0 .2rem; }
h2 { font-weight: 600; font-size: 1.1rem; margin: 2rem 0 .6rem; }
p { margin: 0 0 .8rem; color: var(--soft); }
a { color: inherit; }
input { font: inherit; width: min(24rem, 100%); padding: .45rem .8rem; border: 1px solid #8884; border-radius: .5rem;
  background: var(--card); color: inherit; }
.failed { border-collapse: collapse; background: var(--card); border-radius: .6rem; width: 100%; }
.failed th, .failed td { text-align: left; vertical-align: top; padding: .35rem .9rem; border-top: 1px solid #8883;
  overflow-wrap: anywhere; }
.failed tr:first-child > * { border-top: 0; }
.failed th { font-weight: 500; white-space: nowrap; }
.failed td { color: var(--bad); }
.reliefs { display: grid; grid-template-columns: repeat(auto-fill, minmax(11.5rem, 1fr)); gap: 1rem; margin-top: 1rem; }
.card { background: var(--card); border-radius: .6rem; overflow: hidden; content-visibility: auto;
  contain-intrinsic-size: auto 16rem; }
.view { aspect-ratio: 1; background: linear-gradient(#ebebeb, #c8c8c8); display: flex; align-items: center;
  overflow: hidden; }
.front { display: block; width: 100%; margin: auto; overflow: hidden; }
.front img { display: block; width: 200%; transition: transform .35s; }
.tall { width: auto; height: 100%; }
.view:hover img { transform: translateX(-50%); }
.text { padding: .6rem .8rem .7rem; }
.text b { display: block; font-weight: 600; overflow-wrap: anywhere; }
.text span { color: var(--soft); font-size: .85rem; display: block; }
[hidden] { display: none; }
)";

// Hides the cards that do not match the search. Scales the front view, the left half of a preview, to fit its
// square.
constexpr std::string_view script = R"(
const cards = [...document.querySelectorAll('[data-name]')];
document.querySelector('input').addEventListener('input', event => {
  const words = event.target.value.toLowerCase().split(/\s+/);
  for (const card of cards) card.hidden = !words.every(word => card.dataset.name.includes(word));
});
const fit = image => {
  const width = image.naturalWidth / 2, height = image.naturalHeight;
  image.parentElement.style.aspectRatio = `${width} / ${height}`;
  image.parentElement.classList.toggle('tall', height > width);
};
for (const image of document.querySelectorAll('.front img'))
  image.complete ? fit(image) : image.addEventListener('load', () => fit(image));
)";

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(c < 0x80 ? std::tolower(c) : c); });
  return text;
}

std::string options_text(const Options& options) {
  std::string text;
  for (const auto& [option, value] : options) text += cat(text.empty() ? "" : ", ", option, " ", value);
  return text;
}

Options common_options(const std::vector<Job>& jobs) {
  Options common = jobs.empty() ? Options() : jobs.front().options;
  for (const Job& job : jobs)
    std::erase_if(common, [&](const auto& option) {
      const auto found = job.options.find(option.first);
      return found == job.options.end() || found->second != option.second;
    });
  return common;
}

std::string size_text(std::uintmax_t bytes) {
  const double mb = static_cast<double>(bytes) / 1e6;
  return mb < .1 ? cat((bytes + 999) / 1000, " kB")
                 : cat(static_cast<double>(static_cast<int>(mb * 10)) / 10, " MB");
}

std::string link(const std::string& path, const std::string& text) {
  return cat("<a href=\"", url_of_path(path), "\">", escaped_markup(text), "</a>");
}

std::string card(const Job& job, const Record& record, const RunSettings& settings, const Options& common) {
  std::string links, preview;
  for (const OutputKind& kind : settings.kinds) {
    const std::string name = output_name(job, kind);
    if (kind.name == "preview") {
      preview = name;
      continue;
    }
    const auto output = record.outputs.find(name);
    links += cat(links.empty() ? "" : ", ", link(name, kind.name),
                 output == record.outputs.end() ? "" : cat(" ", size_text(output->second)));
  }
  Options own = job.options;
  for (const auto& [option, value] : common) own.erase(option);
  const std::string options = options_text(own);
  return cat("<div class=\"card\" data-name=\"", escaped_markup(lower(cat(job.name, " ", options))),
             "\"><a class=\"view\" href=\"", url_of_path(preview),
             "\"><span class=\"front\"><img loading=\"lazy\" src=\"", url_of_path(preview), "\" alt=\"",
             escaped_markup(job.name), ", from the front and obliquely\"></span></a><div class=\"text\"><b>",
             escaped_markup(job.name), "</b><span>", escaped_markup(options), "</span><span>", links,
             "</span></div></div>\n");
}

// Returns the error message without the path of the scan's folder, which readers of the page do not need.
std::string error_text(const Job& job, const Record& record) {
  if (job.file.empty() || !record.error.starts_with(job.file)) return record.error;
  return std::filesystem::path(job.file).filename().string() + record.error.substr(job.file.size());
}

std::string heading(const std::vector<Job>& jobs, const Summary& sum,
                    const std::vector<std::string>& sheets) {
  std::string text = cat("<h1>", jobs.size(), jobs.size() == 1 ? " scan" : " scans", "</h1>\n<p>", sum.made,
                         sum.made == 1 ? " relief is made" : " reliefs are made");
  if (sum.failed > 0) text += cat(", ", sum.failed, " failed");
  if (sum.missing > 0) text += cat(", ", sum.missing, sum.missing == 1 ? " is" : " are", " not done yet");
  text += cat(", by relievo ", version, ". ", link("scans.jsonl", "Figures of each scan"), ". ");
  for (std::size_t i = 0; i < sheets.size(); ++i)
    text += cat(i == 0 ? "" : " ", link(sheets[i], i == 0 ? std::string("Contact sheet") : cat(i + 1)));
  const std::string common = options_text(common_options(jobs));
  if (!common.empty()) text += cat(".<br>All with ", escaped_markup(common));
  return text + ".</p>\n";
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

std::string url_of_path(std::string_view path) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string url;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = byte < 0x80 && (std::isalnum(byte) != 0 || std::string_view("-._/").contains(c));
    url += is_plain ? std::string(1, c) : cat('%', digits[byte >> 4], digits[byte & 15]);
  }
  return url;
}

std::string index_page(const std::vector<Job>& jobs, const Records& records, const RunSettings& settings,
                       const std::vector<std::string>& sheets) {
  std::string failed, cards;
  const Options common = common_options(jobs);
  for (const Job& job : jobs) {
    const auto found = records.find(job.name);
    if (found == records.end()) continue;
    if (found->second.is_made)
      cards += card(job, found->second, settings, common);
    else
      failed += cat("<tr data-name=\"", escaped_markup(lower(job.name)), "\"><th>", escaped_markup(job.name),
                    "</th><td>", escaped_markup(error_text(job, found->second)), "</td></tr>\n");
  }
  const Summary sum = summary_of(jobs, records);
  std::string html =
      cat("<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" "
          "content=\"width=device-width\"><title>Reliefs of ",
          jobs.size(), " scans</title><style>", style, "</style>\n", heading(jobs, sum, sheets),
          "<input type=\"search\" placeholder=\"Search names and options\" aria-label=\"Search\">\n");
  if (!failed.empty())
    html += cat("<h2>Failed</h2>\n<table class=\"failed\">\n", failed, "</table>\n<h2>Made</h2>\n");
  return cat(html, "<div class=\"reliefs\">\n", cards, "</div>\n<script>", script, "</script></html>\n");
}

}  // namespace relievo::app::batch
