// Declares the table of options, in which a single entry describes everything about an option. The command
// line, projects, the studio with its page, batch, Python, npm and the documents have no lists of their own;
// they use option_table().
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "relievo/core/choice.h"
#include "relievo/options.h"
#include "relievo/scan/depth_image.h"

namespace relievo {

// The first stage that must be repeated when an option changes. All later stages are repeated, too.
enum class OptionStage {
  input,     // a file is read
  view,      // the visible points are prepared
  model,     // the system for the heights is prepared
  shape,     // the heights are found
  plate,     // the plate is built around the relief
  body,      // the plate gets its base, form and wrap
  triangles  // the triangles of the solid are chosen, and its front is finished
};

inline constexpr std::array<Choice<OptionStage>, 7> option_stages{{{"input", OptionStage::input},
                                                                   {"view", OptionStage::view},
                                                                   {"model", OptionStage::model},
                                                                   {"shape", OptionStage::shape},
                                                                   {"plate", OptionStage::plate},
                                                                   {"body", OptionStage::body},
                                                                   {"triangles", OptionStage::triangles}}};

// A value as users enter it; an empty text means that the option is not given. A length may also be a text
// with a unit, see parse_length().
using OptionValue = std::variant<std::string, double>;

// Values by option name. Missing options have their defaults.
using OptionValues = std::map<std::string, OptionValue, std::less<>>;

// Functions that read an option's value, and return its effective number (the given one or the default).
struct OptionTargets;
struct OptionAccess {
  // Reads a value of the option's type into `to`. Error::input may be empty; then the caller sets it.
  Result<void> (*read)(const OptionValue& value, OptionTargets& to) = nullptr;
  // Returns the option's effective number, if it has one. If the pointer is null, the option is a text.
  std::optional<double> (*number)(const ReliefOptions& options) = nullptr;
};

// An entry of the table.
struct OptionRow {
  std::string_view name;  // command-line flag without dashes, and key in JSON
  std::string_view unit;  // unit of the value, for help
  OptionStage stage = OptionStage::view;
  double min = -std::numeric_limits<double>::infinity();  // range of a number
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string_view> choices = {};  // words that are allowed as the value or at its beginning
  std::string_view help;                       // one line, without range and default
  OptionValue initial = {};                    // the default, if it is a fixed value
  std::string_view otherwise = {};             // the default in words, if it is not a fixed value
  // The value in a new document of the studio, if that differs from the default.
  std::string_view in_studio = {};
  bool is_stated = false;  // whether the studio writes the option into projects even at its default
  bool is_hidden = false;  // true if the studio keeps the option in projects, but has no control for it
  OptionAccess access = {};

  bool is_number() const { return min <= max && max < std::numeric_limits<double>::infinity(); }
  bool is_length() const { return unit == "MM"; }
  bool is_of_relief() const { return stage != OptionStage::input; }
  // Returns whether a change of the option requires preparing the scan again.
  bool is_prepared() const { return stage <= OptionStage::model; }
};

// Returns all options in the order of the help; options of depth images come last.
std::span<const OptionRow> option_table();

// Returns the option with that name; null if there is none.
const OptionRow* find_option(std::string_view name);

// Returns the expected type of an option's value for errors, such as "expected a number".
std::string_view expected_type(const OptionRow& option);

// Returns an error of kind option, naming the option, if the number is outside its range.
Result<void> check_range(const OptionRow& option, double number);

// Reads and checks the values. Returns the options. Options of depth images are ignored, see parse_depth(). A
// base of kind image gets its height map from the caller. Errors: kind option, naming the option, for unknown
// names and for values of the wrong type; those of check() and of the functions that parse texts.
Result<ReliefOptions> parse_options(const OptionValues& values);

// Returns the options of depth images in `values`, except the camera. All other values are ignored. Errors:
// kind option, naming the option.
Result<DepthOptions> parse_depth(const OptionValues& values);

// Returns whether the values ask to keep doubtful points, see ReadOptions. Other options are ignored. Errors:
// kind option, naming the option.
Result<bool> parse_doubtful(const OptionValues& values);

}  // namespace relievo
