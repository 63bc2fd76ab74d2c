// Stores on disk, between runs, the page's state, recent inputs, and scans that were dropped on the page. Tested by
// apps/studio/tests/server.test.mjs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/project.h"
#include "common/temporary_file.h"

namespace relievo::app::studio {

// A scan that was dropped on the page and arrives piece by piece. It is gone unless Store::keep() takes it.
class DroppedScan {
 public:
  DroppedScan(const std::string& folder, const std::string& name);

  // Errors: kind output.
  Result<void> append(std::string_view bytes);

 private:
  friend class Store;
  std::string name_;
  FileHash hash_;
  TemporaryFile file_;
};

// Files in one folder, each replaced as a whole. Not for concurrent use.
class Store {
 public:
  static constexpr std::size_t most_recent = 8;

  // Uses the folder alone: while another studio does, this one takes the folder of that name with -2, or -3 and so on.
  explicit Store(const std::string& folder);

  // Returns what the user should know of the place: that it is another one, or cannot be written to. Usually empty.
  const std::string& notice() const { return notice_; }

  // Returns $XDG_STATE_HOME/relievo, or ~/.local/state/relievo, or without a home a folder for temporary files.
  static std::string default_folder();

  // Returns the page's own state as keep_state() stored it; an empty text before, and if it cannot be read.
  std::string state() const;
  Result<void> keep_state(std::string_view state) const;

  // Returns recent inputs, the newest first, without those whose files are gone.
  std::vector<ScanSource> recent() const;

  // Puts the input first, and removes dropped scans that are no longer recent.
  Result<void> remember(const ScanSource& input) const;

  // Begins a dropped scan. Of the name, folders are ignored. May be called from any thread.
  DroppedScan begin_scan(const std::string& name) const;

  // Keeps a dropped scan that is complete, and returns it as an input. Errors: kind output.
  Result<ScanSource> keep(DroppedScan& scan) const;

 private:
  bool claim(const std::string& folder);
  Result<void> write(const std::string& name, std::string_view text) const;
  void remove_old_scans(const std::vector<ScanSource>& recent) const;

  std::string folder_, notice_;
  Descriptor lock_{-1};
};

}  // namespace relievo::app::studio
