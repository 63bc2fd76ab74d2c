#include "batch/record.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "common/descriptor.h"
#include "common/files.h"
#include "common/owned_folder.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"

namespace relievo::app::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::string_view journal_folder = ".journal";
constexpr const char* no_lock = "expected a lock that can be written";

fs::path journals_in(const std::string& outputs) {
  return fs::path(outputs) / journal_folder;
}

// Opens a file in the folder of the journals. Creates the file and the folder if they are missing.
Result<Descriptor> open_beside_journals(const std::string& outputs, const std::string& name,
                                        const char* expected) {
  RELIEVO_CHECK(make_output_folder(outputs, journal_folder));
  const std::string path = (journals_in(outputs) / name).string();
  Descriptor file(::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666));
  if (!file.is_open()) return system_error(ErrorKind::output, path, expected);
  return file;
}

bool ends_in_a_line(const Descriptor& file) {
  const off_t end = ::lseek(file.number(), 0, SEEK_END);
  char last = '\n';
  return end <= 0 || (::pread(file.number(), &last, 1, end - 1) == 1 && last == '\n');
}

constexpr std::string_view owner = "batch";

Result<void> check_ownership(Ownership found, const std::string& folder) {
  if (found == Ownership::of_others)
    return option_error(
        "output",
        cat("expected an empty folder, or one of relievo batch, found other files in '", folder, "'"));
  if (found == Ownership::unusable)
    return system_error(ErrorKind::output, folder, "expected a folder that can be written to");
  return {};
}

}  // namespace

Json to_json(const Record& record) {
  Json json{{"name", record.name},
            {"file", record.file},
            {"status", record.is_made ? "made" : "failed"},
            {"seconds", record.seconds},
            {"cpu_seconds", record.cpu_seconds},
            {"peak_mb", record.peak_mb},
            {"hash", record.hash},
            {"outputs", record.outputs},
            {"host", record.host},
            {"finished", record.finished},
            {"version", version}};
  if (record.is_made) return json;
  json["error"] = record.error;
  json["may_succeed"] = record.may_succeed;
  return json;
}

std::optional<Record> record_from_line(std::string_view line) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  // A value of a wrong type counts as missing.
  const auto take = [&]<typename T>(const char* key, T& value) {
    const Json found = json.value(key, Json());
    if (std::is_same_v<T, double> ? found.is_number() : found.is_string()) value = found.get<T>();
  };
  Record record;
  take("name", record.name);
  take("file", record.file);
  take("error", record.error);
  take("hash", record.hash);
  take("seconds", record.seconds);
  take("cpu_seconds", record.cpu_seconds);
  take("peak_mb", record.peak_mb);
  take("host", record.host);
  take("finished", record.finished);
  record.is_made = json.value("status", Json()) == "made";
  record.may_succeed = json.value("may_succeed", Json()) == true;
  if (json.contains("outputs") && json["outputs"].is_object())
    for (const auto& [name, bytes] : json["outputs"].items())
      if (bytes.is_number_unsigned()) record.outputs[name] = bytes.get<std::uintmax_t>();
  if (record.name.empty()) return std::nullopt;
  return record;
}

Records read_journals(const std::string& outputs) {
  Records records;
  std::error_code failed;
  for (fs::directory_iterator entry(journals_in(outputs), failed), end; !failed && entry != end;
       entry.increment(failed)) {
    if (entry->path().extension() != ".jsonl") continue;
    const auto bytes = read_file(entry->path().string());
    if (!bytes) continue;
    std::string_view rest = text_in(*bytes);
    while (!rest.empty()) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(rest.size(), line.size() + 1));
      std::optional<Record> record = record_from_line(line);
      if (!record) continue;
      Record& last = records[record->name];
      if (last.finished <= record->finished) last = *std::move(record);
    }
  }
  return records;
}

Result<Journal> Journal::open(const std::string& outputs) {
  const std::string name = cat(host_name(), ".jsonl");
  RELIEVO_TRY(Descriptor file, open_beside_journals(outputs, name, "expected a journal that can be written"));
  return Journal((journals_in(outputs) / name).string(), std::move(file));
}

Result<void> Journal::append(const Record& record) const {
  // One call writes the whole line, so that the lines of several programs never mix. After a power failure
  // the last line of the journal may be unfinished. Then the text begins with a line break, which ends that
  // line.
  const std::string line = cat(ends_in_a_line(file_) ? "" : "\n",
                               to_json(record).dump(-1, ' ', false, Json::error_handler_t::replace), "\n");
  if (::write(file_.number(), line.data(), line.size()) == static_cast<ssize_t>(line.size())) return {};
  return system_error(ErrorKind::output, path_, "expected room to write the journal");
}

Result<Descriptor> lock_run(const std::string& outputs, const std::string& shard) {
  RELIEVO_TRY(Descriptor file, open_beside_journals(outputs, cat("lock", shard), no_lock));
  if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return std::unexpected(
        Error{ErrorKind::output, outputs, {}, "expected a folder that no other run is at work in"});
  return file;  // if the file system does not support locks, the file is not locked
}

Result<Descriptor> lock_job(const std::string& outputs, const std::string& name) {
  RELIEVO_TRY(Descriptor file, open_beside_journals(outputs, "jobs.lock", no_lock));
  // All jobs lock bytes of the same file. A job locks the byte whose position is the hash of the job's name.
  // Network file systems support locks of single bytes, too.
  struct flock byte {};
  byte.l_type = F_WRLCK;
  byte.l_whence = SEEK_SET;
  byte.l_start = static_cast<off_t>(std::hash<std::string>{}(name) >> 2);
  byte.l_len = 1;
  while (::fcntl(file.number(), F_OFD_SETLKW, &byte) != 0 && errno == EINTR) {
  }
  return file;  // if the file system does not support locks, the file is not locked
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "host";
}

std::string time_now() {
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(
                      std::chrono::system_clock::now().time_since_epoch())
                      .count();
  const std::time_t seconds = ms / 1000;
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", utc.tm_year + 1900,
                utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec,
                static_cast<int>(ms % 1000));
  return text.data();
}

Result<void> check_output_folder(const std::string& outputs) {
  return check_ownership(ownership_of(outputs, owner), outputs);
}

Result<void> make_output_folder(const std::string& outputs, const std::filesystem::path& inner) {
  RELIEVO_CHECK(check_ownership(own_folder(outputs, owner), outputs));
  if (inner.empty()) return {};
  std::error_code failed;
  std::filesystem::create_directories(outputs / inner, failed);
  errno = failed.value();
  return check_ownership(failed ? Ownership::unusable : Ownership::owned, outputs);
}

}  // namespace relievo::app::batch
