// What the studio keeps on disk between runs: the page's state, recent inputs, and scans that were dropped on
// the page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "project.h"

namespace relievo::studio {

// Files in one folder, each replaced as a whole. Not for concurrent use.
class Store {
 public:
  static constexpr std::size_t most_recent = 8;

  // Uses the folder, which is created when something is kept.
  explicit Store(std::string folder) : folder_(std::move(folder)) {}

  // $XDG_STATE_HOME/relievo, or ~/.local/state/relievo; the temporary folder's if there is no home.
  static std::string default_folder();

  // The page's own state, as it was kept; empty at first or if it cannot be read.
  std::string state() const;
  Result<void> keep_state(std::string_view state) const;

  // Newest first. Inputs whose files are gone are left out.
  std::vector<Input> recent() const;

  // Puts the input first. Dropped scans that are no longer recent are removed.
  Result<void> remember(const Input& input) const;

  // Writes a dropped scan and returns it as an input. The name's folders are ignored.
  Result<Input> keep_scan(std::string_view bytes, const std::string& name) const;

 private:
  Result<void> write(const std::string& name, std::string_view text) const;
  void remove_old_scans(const std::vector<Input>& recent) const;

  std::string folder_;
};

}  // namespace relievo::studio
