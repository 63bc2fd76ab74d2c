// Checks solids with admesh, a program that repairs STL files and reports what it has repaired.
#pragma once

#include <unistd.h>

#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "relievo/io/write.h"
#include "relievo/plate/solid.h"

namespace relievo::test {

inline std::string output_of(const std::string& command) {
  std::string output;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return output;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) output += static_cast<char>(c);
  pclose(pipe);
  return output;
}

// Returns the number that admesh reports for `label` after its repairs; -1 if the report has no such line. A
// line has one or two numbers. If it has two, the first is the number before the repairs, and the second is
// the number after the repairs. Another label may follow.
inline int reported(const std::string& report, const std::string& label) {
  const std::size_t line = report.find("\n" + label);
  if (line == std::string::npos) return -1;
  std::istringstream rest(report.substr(report.find(':', line) + 1));
  int before = -1, after = -1;
  rest >> before;
  while (rest.peek() == ' ') rest.ignore();
  return std::isdigit(rest.peek()) && rest >> after ? after : before;
}

inline bool has_admesh() {
  static const bool is_there = !output_of("command -v admesh").empty();
  return is_there;
}

// Returns the report of admesh. Returns an empty text if there is nothing to repair, or if admesh is not installed.
inline std::string complaint_of_admesh(const Solid& solid, int parts = 1) {
  if (!has_admesh()) return {};
  const auto path = std::filesystem::temp_directory_path() / ("relievo_" + std::to_string(getpid()) + ".stl");
  const std::vector<std::byte> bytes = write_stl(solid);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const std::string report = output_of("LC_ALL=C admesh '" + path.string() + "' 2>&1");
  std::filesystem::remove(path);
  bool is_good = reported(report, "Number of facets") == static_cast<int>(solid.triangles.size()) &&
                 reported(report, "Number of parts") == parts &&
                 report.contains("All facets connected.  No nearby check necessary.");
  for (const char* label : {"Total disconnected facets", "Degenerate facets", "Edges fixed", "Facets removed",
                            "Facets added", "Facets reversed", "Backwards edges", "Normals fixed"})
    is_good &= reported(report, label) == 0;
  return is_good ? "" : report;
}

}  // namespace relievo::test
