// Keeps scans of the studio in memory. In a browser the page itself stores documents.
#pragma once

#include <map>

#include "studio/store.h"

namespace relievo::app::web {

// Names scans by their hash, and keeps their bytes until the page takes them. Documents are stored by
// apps/web/page/store.js instead.
class BrowserStore final : public studio::Store {
 public:
  std::unique_ptr<studio::DroppedScan> begin_scan(const std::string& name) const override;
  Result<ScanSource> keep(studio::DroppedScan& scan) override;
  std::optional<ScanSource> find_scan(const std::string& hash) const override;

  // Returns the bytes of the scan that was kept under that path. A second call returns an empty vector.
  std::vector<std::byte> take_bytes(const std::string& path) { return std::exchange(bytes_[path], {}); }

 private:
  std::map<std::string, std::vector<std::byte>> bytes_;  // maps paths to contents
};

}  // namespace relievo::app::web
