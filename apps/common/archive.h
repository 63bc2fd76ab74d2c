// Reads files of a ZIP archive.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"

struct zip;

namespace relievo::app {

class Archive {
 public:
  // Opens the archive in `bytes`, which must outlive the object. Errors call it `name`. Errors: kind input.
  static Result<Archive> open(std::span<const std::byte> bytes, std::string_view name);

  // Returns the names of all files, with their folders and slashes, in the order of the archive.
  std::vector<std::string> names() const;

  // Returns a file's content. Errors: kind input for a file that is missing, longer than 4 GiB, or damaged.
  Result<std::vector<std::byte>> content(const std::string& name) const;

 private:
  struct Discard {
    void operator()(zip* archive) const;
  };

  std::string name_;
  std::unique_ptr<zip, Discard> zip_;
};

// Returns whether the bytes begin like a ZIP archive with at least one file.
bool is_archive(std::span<const std::byte> bytes);

// Returns the name of the only model among the files of an archive. A model is a file whose ending some
// reader supports; pictures do not count, and a text only if it is the only file. Errors call the archive `archive`: kind input if it has
// no model or several.
Result<std::string> find_model(const std::vector<std::string>& names, std::string_view archive);

}  // namespace relievo::app
