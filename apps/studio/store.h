// Stores on disk, between runs, the documents with their pictures, scans that were dropped on the page, and the studio's
// address. Tested by apps/studio/tests/documents.test.mjs.
#pragma once

#include <optional>
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

// A document that is kept, for a list of them.
struct KeptDocument {
  std::string id;
  ScanSource input;
  bool is_scan_there = false;
  std::string picture;  // as keep_picture() stored it; may be empty
};

// The last address of the studio. It is used again, so that pages that are still open find the studio.
struct StudioAddress {
  int port = 0;       // 0 if not known
  std::string token;  // empty if not known
};

// Returns the name of the document of that scan: 16 hexadecimal digits.
std::string document_of(const ScanSource& input);

// Files in one folder, each replaced as a whole. Not for concurrent use.
class Store {
 public:
  static constexpr std::size_t most_recent = 24;

  // Uses the folder alone: while another studio does, this one takes the folder of that name with -2, or -3 and so on.
  explicit Store(const std::string& folder);

  // Returns what the user should know of the place: that it is another one, or cannot be written to. Usually empty.
  const std::string& notice() const { return notice_; }

  // Returns $XDG_STATE_HOME/relievo, or ~/.local/state/relievo, or without a home a folder for temporary files.
  static std::string default_folder();

  // Returns a document as keep_document() stored it; an empty text before, and if it cannot be read.
  std::string document(const std::string& id) const;

  // Keeps a document; its state is JSON of the page. If `is_moving`, the next state follows soon. Errors: kind input if
  // the name is none, kind output.
  Result<void> keep_document(const std::string& id, std::string_view state, bool is_moving) const;

  // Keeps the document's picture, an address that begins with "data:". Errors: as above.
  Result<void> keep_picture(const std::string& id, std::string_view picture) const;

  // Makes a document the newest in the list.
  void touch(const std::string& id) const;

  // Returns the documents that were opened or changed last, the newest first.
  std::vector<KeptDocument> recent() const;

  StudioAddress address() const;
  void keep_address(const StudioAddress& address) const;

  // Begins a dropped scan. Of the name, folders are ignored. May be called from any thread.
  DroppedScan begin_scan(const std::string& name) const;

  // Keeps a dropped scan that is complete, and returns it as an input. The scan stays for as long as this program runs and
  // its document is recent. Errors: kind output.
  Result<ScanSource> keep(DroppedScan& scan) const;

  // Returns the dropped scan with those bytes as an input; none if it is not there.
  std::optional<ScanSource> find_scan(const std::string& hash) const;

 private:
  bool claim(const std::string& folder);
  Result<void> write(const std::string& name, std::string_view text, bool is_durable = true) const;
  std::vector<std::string> newest_documents() const;
  void take_former_state() const;
  void remove_old_scans() const;

  std::string folder_, notice_;
  Descriptor lock_{-1};
};

}  // namespace relievo::app::studio
