// Keeps documents and scans, and the studio's address, in files of one folder. Tested by
// apps/studio/tests/documents.test.mjs.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "studio/disk/state_folder.h"
#include "studio/store.h"

namespace relievo::app::studio {

// The last address of the studio. It is used again, so that pages that are still open find the studio.
struct StudioAddress {
  int port = 0;       // 0 if not known
  std::string token;  // empty if not known
};

// The crashes that a file must survive: those of the program, or also those of the machine.
enum class Durability { program, machine };

// Keeps files in one folder, and replaces each as a whole. Removes documents only on request, and only scans
// that it has kept itself and that no document needs. Errors are worded for users, without paths. Not for
// concurrent use.
class DiskStore final : public Store {
 public:
  explicit DiskStore(StateFolder folder);

  std::string notice() const override { return notice_; }
  Result<std::string> document(const std::string& id) const override;
  Result<void> keep_document(const std::string& id, std::string_view state, bool is_moving) override;
  Result<void> keep_picture(const std::string& id, std::string_view picture) override;
  void touch(const std::string& id) override;
  std::vector<KeptDocument> recent(const std::string& after) const override;
  KeptAmount amount() const override;
  Result<void> remove(const std::string& id) override;
  std::unique_ptr<DroppedScan> begin_scan(const std::string& name) const override;
  // The scan stays for as long as this program runs, and then for as long as a document needs it.
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
