// Stores on disk, between runs, the page's state, recent inputs, and scans that were dropped on the page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/project.h"

namespace relievo::app::studio {

// Files in one folder, each replaced as a whole. Not for concurrent use.
class Store {
 public:
  static constexpr std::size_t most_recent = 8;

  // Uses the folder, which is created when something is kept.
  explicit Store(std::string folder) : folder_(std::move(folder)) {}

  // Returns $XDG_STATE_HOME/relievo, or ~/.local/state/relievo, or without a home a folder for temporary files.
  static std::string default_folder();

  // Returns the page's own state as keep_state() stored it; an empty text before, and if it cannot be read.
  std::string state() const;
  Result<void> keep_state(std::string_view state) const;

  // Returns recent inputs, the newest first, without those whose files are gone.
  std::vector<ScanSource> recent() const;

  // Puts the input first, and removes dropped scans that are no longer recent.
  Result<void> remember(const ScanSource& input) const;

  // Writes a dropped scan and returns it as an input. The name's folders are ignored.
  Result<ScanSource> keep_scan(std::string_view bytes, const std::string& name) const;

 private:
  Result<void> write(const std::string& name, std::string_view text) const;
  void remove_old_scans(const std::vector<ScanSource>& recent) const;

  std::string folder_;
};

}  // namespace relievo::app::studio
