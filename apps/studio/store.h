// Stores, between runs, the documents with their pictures, and scans that were dropped on the page.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/project.h"

namespace relievo::app::studio {

// A scan that was dropped on the page and arrives in blocks. It is removed unless Store::keep() takes it.
class DroppedScan {
 public:
  virtual ~DroppedScan() = default;

  // Adds bytes at the end. Errors: kind output.
  virtual Result<void> append(std::string_view bytes) = 0;

  // Waits until all bytes that arrived are stored safely, which may take as long as a disk needs. Errors:
  // kind output.
  virtual Result<void> finish() { return {}; }
};

// An entry of the list of kept documents.
struct KeptDocument {
  std::string id;
  ScanSource input;
  bool is_scan_there = false;
  std::string picture;  // as keep_picture() stored it; may be empty
};

// The number of documents that are kept, and the bytes that they take with their scans.
struct KeptAmount {
  std::size_t documents = 0;
  std::uint64_t bytes = 0;
};

// Returns the name of the document of that scan: 16 hexadecimal digits.
std::string document_of(const ScanSource& input);

// Keeps scans. This class keeps no documents; a derived class may. Not for concurrent use, except
// begin_scan().
class Store {
 public:
  static constexpr std::size_t most_recent = 24;

  virtual ~Store() = default;

  // Returns a message for the user if documents are kept in another folder than usual, or cannot be kept.
  // Usually empty.
  virtual std::string notice() const { return {}; }

  // Returns a document as keep_document() stored it; an empty text if it was never kept. Errors: kind output
  // if it cannot be read.
  virtual Result<std::string> document(const std::string& /*id*/) const { return {}; }

  // Keeps a document; its state is JSON of the page. If `is_moving`, the next state follows soon. Errors:
  // kind input if `id` is no document's name, kind output.
  virtual Result<void> keep_document(const std::string&, std::string_view, bool /*is_moving*/) { return {}; }

  // Keeps the document's picture, an address that begins with "data:". Errors: those of keep_document().
  virtual Result<void> keep_picture(const std::string& /*id*/, std::string_view) { return {}; }

  // Makes a document the newest in the list.
  virtual void touch(const std::string& /*id*/) {}

  // Returns the most_recent documents that were opened or changed last, the newest first. If `after` is not
  // empty, returns those that follow that document in this order.
  virtual std::vector<KeptDocument> recent(const std::string& /*after*/) const { return {}; }

  // Returns the number of all documents, which stay until remove() is called for them, and their size.
  virtual KeptAmount amount() const { return {}; }

  // Removes a document, and its dropped scans that no other document needs. Errors: kind input if `id` is no
  // document's name, kind output.
  virtual Result<void> remove(const std::string& /*id*/) { return {}; }

  // Begins a dropped scan. Folders in the name are ignored. May be called from any thread.
  virtual std::unique_ptr<DroppedScan> begin_scan(const std::string& name) const = 0;

  // Keeps a dropped scan that is complete and finished, and returns it as an input. Errors: kind output.
  virtual Result<ScanSource> keep(DroppedScan& scan) = 0;

  // Returns the dropped scan with that hash as an input; nothing if it is not kept.
  virtual std::optional<ScanSource> find_scan(const std::string& /*hash*/) const { return std::nullopt; }
};

// Returns whether a text is the name of a document.
bool is_document(std::string_view id);

// Returns the scan of a document's present step; nothing if the text is not the state of a document.
std::optional<ScanSource> input_of(const std::string& state);

// Returns the last part of a path as a plain file name: without separators and control characters, of at most
// 120 bytes, never empty.
std::string plain_name(const std::string& name);

}  // namespace relievo::app::studio
