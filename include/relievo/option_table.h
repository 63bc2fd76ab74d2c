// The table of options: one row says everything about an option. The command line, projects, the studio with its page,
// batch, Python, npm and the documents have no list of their own, and take from option_table() the rows that they need.
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

// The first work that is done anew when an option changes. The work of all later stages follows it.
enum class OptionStage {
  input,     // a depth image is read
  view,      // the points that are seen are prepared
  model,     // the heights of those points are prepared
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

// A value as users give it; an empty text is none. A length also takes a text with a unit, see parse_length().
using OptionValue = std::variant<std::string, double>;

// Values by the names of their options. An option that is missing has its default.
using OptionValues = std::map<std::string, OptionValue, std::less<>>;

// Reads a value of an option, and returns the number that applies.
struct OptionTargets;
struct OptionAccess {
  // Takes a value of the right type. The input of an error may be empty, for the caller to fill in.
  Result<void> (*read)(const OptionValue& value, OptionTargets& to) = nullptr;
  // Returns the number that applies, be it given or a default; nothing if there is none. Null for texts.
  std::optional<double> (*number)(const ReliefOptions& options) = nullptr;
};

// A row of the table.
struct OptionRow {
  std::string_view name;  // as a command-line flag without its dashes, as a key of JSON
  std::string_view unit;  // of the value, for help
  OptionStage stage = OptionStage::view;
  double min = -std::numeric_limits<double>::infinity();  // smallest and largest value of a number
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string_view> choices = {};  // all words that may stand there, or begin the text
  std::string_view help;                       // one line, without range and default
  OptionValue initial = {};                    // the default, if it depends on nothing else
  std::string_view otherwise = {};             // the default, for people, where it is no value
  std::string_view in_studio = {};  // the value in a new document of the studio, if that is not the default
  bool is_stated = false;           // the studio writes it into projects even where it has its default
  OptionAccess access = {};

  bool is_number() const { return min <= max && max < std::numeric_limits<double>::infinity(); }
  bool is_length() const { return unit == "MM"; }
  bool is_of_relief() const { return stage != OptionStage::input; }
  // A change of these options prepares the scan anew.
  bool is_prepared() const { return stage == OptionStage::view || stage == OptionStage::model; }
};

// Returns all rows, in the order of the help; those of depth images come last.
std::span<const OptionRow> option_table();

// Returns the row of that name; null if there is none.
const OptionRow* find_option(std::string_view name);

// Returns the type of an option's values in the words of an error: "expected a number".
std::string_view expected_type(const OptionRow& option);

// Checks that a number is one that the option may have. Errors: kind option, naming the option.
Result<void> check_range(const OptionRow& option, double number);

// Returns the options that the values ask for, read and checked once and for all. Options of depth images are left to
// parse_depth(). A base of kind image has no height map yet. Errors: kind option, naming the option, for unknown names,
// for values of another type, and those of check() and of the functions that read texts.
Result<ReliefOptions> parse_options(const OptionValues& values);

// Returns the options of depth images that the values ask for, without camera. Other options are not looked at. Errors:
// kind option, naming the option.
Result<DepthOptions> parse_depth(const OptionValues& values);

}  // namespace relievo
