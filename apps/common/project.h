// Reads and writes project files. A project is an unfinished relief in JSON. The studio saves and opens
// projects, and `make` makes reliefs from them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "common/read_inputs.h"
#include "relievo/core/image.h"
#include "relievo/option_table.h"
#include "relievo/scene.h"

namespace relievo::app {

// The source of the points: a file, or a generated sample if `sample` is not empty.
struct ScanSource {
  std::string sample;
  std::string path;
  std::string name;  // shown to users
  std::string hash;  // hash of the file's bytes, see hash_of(); empty if not computed yet
};

struct Project {
  ScanSource input;
  OptionValues options;
  std::string base_image_path;  // path of the height map of a base; empty if there is none
  // The height map, or the error from reading it. Null until find_project() reads it.
  Result<std::shared_ptr<const Image<float>>> base_image = nullptr;
};

// Parses the text of a project file. Error messages call the file `name`. An unknown option is an error;
// parse_options() later checks the values. Other entries of the file belong to the studio and are ignored. Errors:
// kind input.
Result<Project> read_project(std::string_view text, std::string_view name);

// Returns the options `own` of a project or of a prepared model, overridden by the options `given` by the user. Some options exclude
// each other, such as height and alpha, or plate and diameter. If `given` has such an option, the options of
// `own` that it excludes are dropped, and so is a method or an outline of `own` that may contradict it.
OptionValues with_given(OptionValues own, const OptionValues& given);

// Returns an object with the value of each option that has a given value or a default.
nlohmann::json to_json(const OptionValues& options);

// Returns the value of a JSON number or text; nothing for other types.
std::optional<OptionValue> value_from_json(const nlohmann::json& json);

// Returns the options in an object that to_json() made, except those that have their default value. Messages call
// the object `name`. Errors: kind input for a name that is not in the table and for a value of a wrong type.
Result<OptionValues> values_from_json(const nlohmann::json& json, std::string_view name);

// Returns the parsed options of an object that to_json() made. Also reads the files that they name: the height map
// of a base at the path "base-image", the fonts, and the list of ornaments. Errors: those of values_from_json(),
// parse_options(), parse_depth(), read_base_image(), take_base_image() and read_ornaments().
Result<ReliefOptions> options_from_json(const nlohmann::json& json, std::string_view name);

// Does the same as options_from_json(), but does not read the fonts and the list of ornaments. Errors: those of
// options_from_json() except for those of read_ornaments().
Result<ReliefOptions> options_without_ornament_files(const nlohmann::json& json, std::string_view name);

// Returns the path under the key "base-image" of an object with options; empty if it has none.
std::string base_image_path_in(const nlohmann::json& options);

// Returns whether both sources are the same sample or the same file. Hashes are not compared.
bool is_same(const ScanSource& a, const ScanSource& b);

nlohmann::json to_json(const ScanSource& input);
Result<ScanSource> input_from_json(const nlohmann::json& json, std::string_view name);

// Computes a 64-bit FNV-1a hash, by which changed files are detected. It is no protection against forgery.
class FileHash {
 public:
  void append(std::string_view bytes);
  std::string text() const;

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325U;
};
std::string hash_of(std::string_view bytes);

// Returns the hash of a file's bytes. Reads the file in blocks. Errors: kind input.
Result<std::string> hash_of_file(const std::string& path);

struct LoadOptions {
  InputArguments in = {};
  std::function<bool()> is_unwanted = {};  // may be empty
};

// Returns the model in the bytes of a scan, or the models of a scene file. The ending of `path` determines
// the format. Files that the scan refers to are read from the folder of `path`. Sets the input's hash and
// reports errors as load_input() does.
Result<Scene> load_scan(ScanSource& input, std::span<const std::byte> bytes, const std::string& path,
                        const LoadOptions& options);

// Returns the model of the input, or the models of a scene file. Sets the input's hash if it has none. A
// relative path starts at `folder`. Errors: kind input, also if the file's hash differs from the input's hash;
// kind option for an unknown sample; kind cancelled as soon as `is_unwanted` returns true.
Result<Scene> load_input(ScanSource& input, const std::string& folder, const LoadOptions& options);

}  // namespace relievo::app
