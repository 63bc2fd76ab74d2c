// Stores documents, their thumbnails, and scans that were dropped on the page. They stay stored when the
// studio ends.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/project.h"

namespace relievo::app::studio {

// A scan that was dropped on the page and arrives in blocks. Unless Store::keep() takes it, the destructor
// removes it.
class DroppedScan {
 public:
  virtual ~DroppedScan() = default;

  // Appends bytes. Errors: kind output.
  virtual Result<void> append(std::string_view bytes) = 0;

  // Waits until all received bytes are safely on the disk. Errors: kind output.
  virtual Result<void> finish() { return {}; }
};

// An entry of the list of stored documents.
struct KeptDocument {
  std::string id;
  ScanSource input;
  bool is_scan_there = false;
  std::string thumbnail;  // as passed to keep_thumbnail(); may be empty
};

// The number of stored documents, and their size in bytes, including their scans.
struct KeptAmount {
  std::size_t documents = 0;
  std::uint64_t bytes = 0;
};

// Returns the name of the document for that scan: 16 hexadecimal digits.
std::string document_of(const ScanSource& input);

// Stores scans, and in derived classes also documents. Only begin_scan() is for concurrent use.
class Store {
 public:
  static constexpr std::size_t most_recent = 24;

  virtual ~Store() = default;

  // Returns a message for the user if documents are stored in another folder than usual, or cannot be stored;
  // otherwise an empty text.
  virtual std::string notice() const { return {}; }

  // Returns a document as it was passed to keep_document(); an empty text if it is not stored. Errors: kind
  // output if it cannot be read.
  virtual Result<std::string> document(const std::string& /*id*/) const { return {}; }

  // Stores the state of a document, which is JSON from the page. If `is_moving`, the next state will follow soon.
  // Errors: kind input if `id` is not the name of a document; kind output.
  virtual Result<void> keep_document(const std::string&, std::string_view, bool /*is_moving*/) { return {}; }

  // Stores the thumbnail of a document, a small picture, as a data URL. Errors: those of keep_document().
  virtual Result<void> keep_thumbnail(const std::string& /*id*/, std::string_view) { return {}; }

  // Makes a document the most recent one in the list of recent().
  virtual void touch(const std::string& /*id*/) {}

  // Returns at most `most_recent` documents in the order of their last opening or change, newest first. If `after` is
  // not empty, the list begins behind that document.
  virtual std::vector<KeptDocument> recent(const std::string& /*after*/) const { return {}; }

  // Returns the number and the size of all stored documents. A document stays until remove() is called for
  // it.
  virtual KeptAmount amount() const { return {}; }

  // Removes a document, and those of its dropped scans that no other document needs. Errors: kind input if
  // `id` is not the name of a document; kind output.
  virtual Result<void> remove(const std::string& /*id*/) { return {}; }

  // Begins to receive a dropped scan. Ignores folders in the name. May be called from any thread.
  virtual std::unique_ptr<DroppedScan> begin_scan(const std::string& name) const = 0;

  // Stores a dropped scan that is complete, and returns it as an input. Errors: kind output.
  virtual Result<ScanSource> keep(DroppedScan& scan) = 0;

  // Returns the stored scan with that hash as an input; nothing if there is none.
  virtual std::optional<ScanSource> find_scan(const std::string& /*hash*/) const { return std::nullopt; }
};

// Returns whether a text is the name of a document.
bool is_document(std::string_view id);

// Returns the scan in the current step of a document; nothing if the text is not the state of a document.
std::optional<ScanSource> input_of(const std::string& state);

// Returns the last part of a path as a plain file name: without separators and control characters, not empty,
// and of at most 120 bytes.
std::string plain_name(const std::string& name);

}  // namespace relievo::app::studio
