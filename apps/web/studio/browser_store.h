// The studio's store if a browser keeps documents and scans.
#pragma once

#include <map>

#include "studio/store.h"

namespace relievo::app::web {

// Names scans by their hash, and keeps their bytes for the page to take. The page keeps documents itself, see
// apps/web/page/store.js.
class BrowserStore final : public studio::Store {
 public:
  std::unique_ptr<studio::DroppedScan> begin_scan(const std::string& name) const override;
  Result<ScanSource> keep(studio::DroppedScan& scan) override;

  // Returns the bytes of a scan that was kept under that path; none on a second call.
  std::vector<std::byte> take_bytes(const std::string& path) { return std::exchange(bytes_[path], {}); }

 private:
  std::map<std::string, std::vector<std::byte>> bytes_;  // by path
};

}  // namespace relievo::app::web
