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
  // Opens the archive in `bytes`, which must outlive the object. Error messages call the archive `name`.
  // Errors: kind input.
  static Result<Archive> open(std::span<const std::byte> bytes, std::string_view name);

  // Returns the names of all files in the order of the archive. A name contains its folders, separated by
  // slashes.
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

// Returns whether the bytes begin like a ZIP archive that contains at least one file.
bool is_archive(std::span<const std::byte> bytes);

// Returns the name of the only model among the files of an archive. A model is a file with an ending that a
// reader supports. Pictures are not models, and a text file counts as a model only if it is the only file.
// Error messages call the archive `archive`. Errors: kind input if the archive has no model or several
// models.
Result<std::string> find_model(const std::vector<std::string>& names, std::string_view archive);

// Returns whether all files of an archive are NumPy arrays, as in an NPZ file. Hidden files do not count.
bool has_arrays_alone(const std::vector<std::string>& names);

// Returns the name of the array to read from an archive of NumPy (NPZ): the array with a usual name for
// points, otherwise the one with a usual name for depths, otherwise the only array. Errors: kind input if
// there is no such array.
Result<std::string> find_array(const std::vector<std::string>& names, std::string_view archive);

}  // namespace relievo::app
