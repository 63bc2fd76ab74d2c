// Stores documents, scans and the studio's address as files in one folder, which it chooses and reserves. Tested
// by apps/studio/tests/documents.test.mjs and tests/cli/foreign_files.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/descriptor.h"
#include "studio/store.h"

namespace relievo::app::studio {

struct StateFolder {
  std::string path;
  std::string notice;    // message for the user of the page, without a path; usually empty
  std::string detail;    // sentence with the path, only for the terminal
  bool is_ours = false;  // false: the studio must not read or change anything in the folder
  Descriptor lock{-1};   // while this file is open, no other studio can take the folder
};

// Reserves the folder `chosen` for this studio, or the default folder if `chosen` is empty. If another studio
// uses it, tries the same name with -2, -3 and so on. Never takes a folder with files of other programs: if
// the default folder has such files, tries the next name. Errors: kind option if `chosen` has such files.
Result<StateFolder> take_state_folder(const std::string& chosen);

// The last address of the studio. The next run uses this address again, so that pages that are still open
// find the studio.
struct StudioAddress {
  int port = 0;       // 0 if unknown
  std::string token;  // empty if unknown
};

// The crashes that a written file must survive: only those of the program, or also those of the machine.
enum class Durability { program, machine };

// Stores each file as a whole. Removes a document only on request. Removes a scan only if this store has kept
// it and no document needs it. Errors are worded for users and contain no paths. Not for concurrent use.
class DiskStore final : public Store {
 public:
  explicit DiskStore(StateFolder folder);

  std::string notice() const override { return notice_; }
  Result<std::string> document(const std::string& id) const override;
  Result<void> keep_document(const std::string& id, std::string_view state, bool is_moving) override;
  Result<void> keep_thumbnail(const std::string& id, std::string_view thumbnail) override;
  void touch(const std::string& id) override;
  std::vector<KeptDocument> recent(const std::string& after) const override;
  KeptAmount amount() const override;
  Result<void> remove(const std::string& id) override;
  std::unique_ptr<DroppedScan> begin_scan(const std::string& name) const override;
  // Keeps the scan until this program ends, and after that as long as a document needs the scan.
  Result<ScanSource> keep(DroppedScan& scan) override;
  std::optional<ScanSource> find_scan(const std::string& hash) const override;

  StudioAddress address() const;
  void keep_address(const StudioAddress& address) const;

 private:
  Result<void> write(const std::string& name, std::string_view text, Durability durability) const;
  std::vector<std::string> newest_documents() const;
  Result<std::set<std::string>> scans_of(std::vector<std::string> texts) const;
  void remove_unneeded(const std::set<std::string>& candidates) const;

  std::string folder_, notice_;
  Descriptor lock_;
};

}  // namespace relievo::app::studio
