#include "web/studio/browser_store.h"

#include <span>

#include "relievo/core/text.h"

namespace relievo::app::web {
namespace {

struct ScanInMemory final : studio::DroppedScan {
  explicit ScanInMemory(const std::string& scan) : name(studio::plain_name(scan)) {}

  Result<void> append(std::string_view more) override {
    hash.append(more);
    const auto added = std::as_bytes(std::span(more));
    bytes.insert(bytes.end(), added.begin(), added.end());
    return {};
  }

  std::string name;
  FileHash hash;
  std::vector<std::byte> bytes;
};

std::string folder_of(std::string_view hash) {
  return cat("scans/", hash.substr(hash.find(':') + 1), "/");
}

}  // namespace

std::unique_ptr<studio::DroppedScan> BrowserStore::begin_scan(const std::string& name) const {
  return std::make_unique<ScanInMemory>(name);
}

Result<ScanSource> BrowserStore::keep(studio::DroppedScan& scan) {
  auto& kept = static_cast<ScanInMemory&>(scan);  // begin_scan() made it, so it has this type
  const std::string hash = kept.hash.text();
  ScanSource source{{}, folder_of(hash) + kept.name, kept.name, hash};
  bytes_[source.path] = std::move(kept.bytes);
  return source;
}

std::optional<ScanSource> BrowserStore::find_scan(const std::string& hash) const {
  const std::string folder = folder_of(hash);
  const auto found = bytes_.lower_bound(folder);
  if (found == bytes_.end() || !found->first.starts_with(folder)) return std::nullopt;
  return ScanSource{{}, found->first, found->first.substr(folder.size()), hash};
}

}  // namespace relievo::app::web
