// The table of options: one row states everything about an option. The command line, projects, the studio
// with its page, batch, Python, npm and the documents have no lists of their own; they take the rows that
// they need from option_table().
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

// The first stage of work that is repeated when an option changes. All later stages are repeated, too.
enum class OptionStage {
  input,     // a file is read
  view,      // the visible points are prepared
  model,     // the system for the heights is prepared
  shape,     // the heights are found
  plate,     // the plate is built around the relief
  body,      // the plate is bent and formed
  triangles  // the triangles of the solid are chosen, and its front is finished
};

inline constexpr std::array<Choice<OptionStage>, 7> option_stages{{{"input", OptionStage::input},
                                                                   {"view", OptionStage::view},
                                                                   {"model", OptionStage::model},
                                                                   {"shape", OptionStage::shape},
                                                                   {"plate", OptionStage::plate},
                                                                   {"body", OptionStage::body},
                                                                   {"triangles", OptionStage::triangles}}};

// A value as users give it; an empty text means no value. A length also takes a text with a unit, see
// parse_length().
using OptionValue = std::variant<std::string, double>;

// Values by the names of their options. An option that is missing has its default.
using OptionValues = std::map<std::string, OptionValue, std::less<>>;

// The functions that read a value of an option and return the number that applies.
struct OptionTargets;
struct OptionAccess {
  // Reads a value of the option's type into `to`. The input of an error may be empty; the caller then sets
  // it.
  Result<void> (*read)(const OptionValue& value, OptionTargets& to) = nullptr;
  // Returns the number that applies, given or default; nothing if there is none. The pointer is null for
  // options that are texts.
  std::optional<double> (*number)(const ReliefOptions& options) = nullptr;
};

// A row of the table.
struct OptionRow {
  std::string_view name;  // the command-line flag without its dashes, and the key in JSON
  std::string_view unit;  // unit of the value, for help
  OptionStage stage = OptionStage::view;
  double min = -std::numeric_limits<double>::infinity();  // smallest and largest value of a number
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string_view> choices = {};  // all words that the value may be or begin with
  std::string_view help;                       // one line, without range and default
  OptionValue initial = {};                    // the default, if it depends on nothing else
  std::string_view otherwise = {};             // the default in words, if it is not a fixed value
  std::string_view in_studio = {};  // the value in a new document of the studio, if that is not the default
  bool is_stated = false;           // the studio writes it into projects even if it has its default
  bool is_hidden = false;           // the studio's page has no control for it, but keeps it in projects
  OptionAccess access = {};

  bool is_number() const { return min <= max && max < std::numeric_limits<double>::infinity(); }
  bool is_length() const { return unit == "MM"; }
  bool is_of_relief() const { return stage != OptionStage::input; }
  // Returns whether the scan must be prepared again when the option changes.
  bool is_prepared() const { return stage <= OptionStage::model; }
};

// Returns all rows, in the order of the help; the options of depth images come last.
std::span<const OptionRow> option_table();

// Returns the row of that name; null if there is none.
const OptionRow* find_option(std::string_view name);

// Returns the type of an option's values in the words of an error: "expected a number".
std::string_view expected_type(const OptionRow& option);

// Checks that a number is one that the option may have. Errors: kind option, naming the option.
Result<void> check_range(const OptionRow& option, double number);

// Reads and checks the values, and returns the options. Options of depth images are left to parse_depth(). A
// base of kind image has no height map yet. Errors: kind option, naming the option, for unknown names, for
// values of another type, and those of check() and of the functions that read texts.
Result<ReliefOptions> parse_options(const OptionValues& values);

// Returns the options of depth images that the values ask for, without camera. Other options are ignored.
// Errors: kind option, naming the option.
Result<DepthOptions> parse_depth(const OptionValues& values);

// Returns whether the values ask for doubtful points, see ReadOptions. Other options are ignored. Errors: kind option,
// naming the option.
Result<bool> parse_doubtful(const OptionValues& values);

}  // namespace relievo
