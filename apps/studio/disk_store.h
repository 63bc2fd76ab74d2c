// Keeps documents and scans, and the studio's address, in files of one folder. Tested by
// apps/studio/tests/documents.test.mjs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/descriptor.h"
#include "studio/store.h"

namespace relievo::app::studio {

// The last address of the studio. It is used again, so that pages that are still open find the studio.
struct StudioAddress {
  int port = 0;       // 0 if not known
  std::string token;  // empty if not known
};

// Files in one folder, each replaced as a whole. Not for concurrent use.
class DiskStore final : public Store {
 public:
  // Uses the folder alone: while another studio does, this one takes the folder of that name with -2, or -3 and so on.
  explicit DiskStore(const std::string& folder);

  // Returns $XDG_STATE_HOME/relievo, or ~/.local/state/relievo, or without a home a folder for temporary files.
  static std::string default_folder();

  const std::string& notice() const override { return notice_; }
  std::string document(const std::string& id) const override;
  Result<void> keep_document(const std::string& id, std::string_view state, bool is_moving) override;
  Result<void> keep_picture(const std::string& id, std::string_view picture) override;
  void touch(const std::string& id) override;
  std::vector<KeptDocument> recent() const override;
  std::unique_ptr<DroppedScan> begin_scan(const std::string& name) const override;
  // The scan stays for as long as this program runs and its document is recent.
  Result<ScanSource> keep(DroppedScan& scan) override;
  std::optional<ScanSource> find_scan(const std::string& hash) const override;

  StudioAddress address() const;
  void keep_address(const StudioAddress& address) const;

 private:
  bool claim(const std::string& folder);
  Result<void> write(const std::string& name, std::string_view text, bool is_durable = true) const;
  std::vector<std::string> newest_documents() const;
  void take_former_state();
  void remove_old_scans() const;

  std::string folder_, notice_;
  Descriptor lock_{-1};
};

}  // namespace relievo::app::studio
