#include "batch/memory_need.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/files.h"
#include "common/read_inputs.h"
#include "relievo/io/read.h"

namespace relievo::app::batch {
namespace {

namespace fs = std::filesystem;

constexpr double mb = 1 << 20;

// These figures are upper bounds of measured values (docs/batch.md). `least_mb` is so large because even for
// a small scan the blur of the normals may need 2^24 cells of 12 bytes, and the solid may need about half a
// million samples. `bytes_per_point` covers reading, preparing and sampling a cloud.
constexpr double least_mb = 220, bytes_per_point = 340, bytes_per_triangle = 150, bytes_per_pixel = 60,
                 bytes_per_texel = 8, bytes_per_visible_point = 900, streaming_mb = 40,
                 bytes_per_streamed_point = 480;

double number_or(const Options& options, const std::string& name, double otherwise) {
  const auto found = options.find(name);
  if (found == options.end()) return otherwise;
  double value = otherwise;
  std::from_chars(found->second.data(), found->second.data() + found->second.size(), value);
  return value;
}

// Returns what the beginning of the file says about its size.
ScanSize size_of(const std::string& path, std::uint64_t bytes) {
  std::vector<char> head(std::min<std::uint64_t>(bytes, 1 << 16));
  std::ifstream(path, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
  return scan_size(std::as_bytes(std::span(head)), path, bytes);
}

// Estimates the memory, in MB, that is needed to read one file and to make a relief of its points.
double need_of_file_mb(const std::string& path, double wanted_points, double stream_above_mb) {
  const std::optional<std::uint64_t> known = file_size(path);
  if (!known) return 0;
  const std::uint64_t bytes = *known;
  const ScanSize size = size_of(path, bytes);
  const auto points = static_cast<double>(size.points), triangles = static_cast<double>(size.triangles),
             pixels = static_cast<double>(size.pixels);
  const double visible = bytes_per_visible_point * wanted_points;
  if (size.is_stated && size.triangles == 0 && static_cast<double>(bytes) > 1e6 * stream_above_mb)
    return streaming_mb + (bytes_per_streamed_point * wanted_points + visible) / mb;
  const double cloud = static_cast<double>(bytes) + bytes_per_point * points +
                       bytes_per_triangle * triangles + bytes_per_pixel * pixels;
  const bool is_sampled = size.triangles + size.pixels > 0;
  return (cloud + (is_sampled ? visible : 0)) / mb;
}

// Estimates the memory, in MB, that a texture needs.
double need_of_texture_mb(const std::string& path) {
  const std::optional<std::uint64_t> bytes = file_size(path);
  if (!bytes) return 0;
  return (static_cast<double>(*bytes) + bytes_per_texel * static_cast<double>(size_of(path, *bytes).pixels)) /
         mb;
}

double number_in(const std::string& path) {
  std::ifstream file(path);
  double number = -1;
  return file >> number ? number : -1;
}

// Returns the memory, in MB, that this process may still allocate before its control group reaches the
// group's limit. Returns infinity if the group has no limit.
double left_in_control_group_mb() {
  std::ifstream groups("/proc/self/cgroup");
  double left = std::numeric_limits<double>::infinity();
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::")) continue;
    // A group is also subject to the limits of the groups that contain it.
    for (fs::path group = line.substr(3);; group = group.parent_path()) {
      const std::string folder = "/sys/fs/cgroup" + group.string();
      const double most = number_in(folder + "/memory.max"), taken = number_in(folder + "/memory.current");
      if (most >= 0 && taken >= 0) left = std::min(left, (most - taken) / mb);
      if (group == group.parent_path()) break;
    }
  }
  return left;
}

}  // namespace

double memory_need_mb(const Job& job) {
  const double points = number_or(job.options, "points", PointsWanted{}.points),
               stream_above_mb = number_or(job.options, "stream-above", InputArguments{}.stream_above_mb);
  double need = least_mb;
  for (const InputFile& file : files_of(job))
    need +=
        file.is_texture ? need_of_texture_mb(file.path) : need_of_file_mb(file.path, points, stream_above_mb);
  return need;
}

double available_memory_mb() {
  double available =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / mb;
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("MemAvailable:"))
      available = std::stod("0" + line.substr(line.find_first_of("0123456789"))) / 1024;
  return std::min(available, left_in_control_group_mb());
}

}  // namespace relievo::app::batch
