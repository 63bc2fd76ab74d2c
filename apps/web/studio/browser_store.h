// The studio's store where a browser keeps documents and scans: what it hands over are names.
#pragma once

#include <map>

#include "studio/store.h"

namespace relievo::app::web {

// Names scans by their hash, and keeps their bytes for the page to take. Documents are the page's own affair,
// see apps/web/page/store.js.
class BrowserStore final : public studio::Store {
 public:
  const std::string& notice() const override { return notice_; }
  Result<std::string> document(const std::string&) const override { return {}; }
  Result<void> keep_document(const std::string&, std::string_view, bool) override { return {}; }
  Result<void> keep_picture(const std::string&, std::string_view) override { return {}; }
  void touch(const std::string&) override {}
  std::vector<studio::KeptDocument> recent(const std::string&) const override { return {}; }
  studio::KeptAmount amount() const override { return {}; }
  Result<void> remove(const std::string&) override { return {}; }
  std::unique_ptr<studio::DroppedScan> begin_scan(const std::string& name) const override;
  Result<ScanSource> keep(studio::DroppedScan& scan) override;
  std::optional<ScanSource> find_scan(const std::string&) const override { return std::nullopt; }

  // Returns the bytes of a scan that was kept under that path; none on a second call.
  std::vector<std::byte> take_bytes(const std::string& path) { return std::exchange(bytes_[path], {}); }

 private:
  std::string notice_;
  std::map<std::string, std::vector<std::byte>> bytes_;  // by path
};

}  // namespace relievo::app::web
