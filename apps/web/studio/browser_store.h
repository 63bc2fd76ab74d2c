// Keeps scans for the studio in a browser, where the page keeps the documents.
#pragma once

#include <map>

#include "studio/store.h"

namespace relievo::app::web {

// Names scans by their hash, and keeps their bytes until the page takes them. Keeps no documents: the page
// does so in apps/web/page/store.js.
class BrowserStore final : public studio::Store {
 public:
  std::unique_ptr<studio::DroppedScan> begin_scan(const std::string& name) const override;
  Result<ScanSource> keep(studio::DroppedScan& scan) override;

  // Returns the bytes of a scan that was kept under that path; an empty vector on a second call.
  std::vector<std::byte> take_bytes(const std::string& path) { return std::exchange(bytes_[path], {}); }

 private:
  std::map<std::string, std::vector<std::byte>> bytes_;  // by path
};

}  // namespace relievo::app::web
