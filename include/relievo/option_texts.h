// The options of a relief as users type them, in one table: the command line, projects, the studio and the documents
// all come from option_fields().
#pragma once

#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <variant>

#include "relievo/core/length.h"
#include "relievo/core/option_field.h"
#include "relievo/options.h"

namespace relievo {

// A view as users type it.
struct ViewTexts {
  std::string view = "front", up;  // see parse_view()
  std::string crop;                // see parse_crop(); empty: all
  std::string crumbs = "drop";     // or keep, see View
  std::string plane = "keep";      // or drop, see View
  std::string denoise = "auto";    // see parse_denoise()

  bool operator==(const ViewTexts&) const = default;
};

// Returns the view. Errors: kind option, naming the option.
Result<View> parse_view(const ViewTexts& texts);

struct OptionTexts : NumericOptions, ViewTexts {
  std::string method;  // empty: see ReliefOptions
  std::string tone;    // see parse_tone_curve(); empty: none
  std::string mode = "exact";
  std::string outline;          // see outline.h; empty: rectangle, or circle with a diameter
  std::string plate;            // see parse_plate_size(); empty: none
  std::string shift;            // see parse_shift(); empty: none
  std::string base = "plane";   // see parse_base()
  std::string wrap = "none";    // see parse_wrap()
  std::string form = "relief";  // see forms.h
  std::string tool;             // see parse_tool(); empty: none
  std::string finish = "full";
};

// A row of the table.
struct ReliefField : OptionField {
  using Value = std::variant<double NumericOptions::*, std::optional<double> NumericOptions::*,
                             std::string OptionTexts::*>;

  Value value;
  double (*effective)(const ReliefOptions&) = nullptr;  // what rules without a value, where methods differ
};

// Returns all rows, in the order of the help.
std::span<const ReliefField> option_fields();

// Calls f(field, value) for each option; value is double, optional<double> or string.
template <typename Texts, typename F>
requires std::is_same_v<std::remove_const_t<Texts>, OptionTexts>
void visit(Texts& texts, F&& f) {
  for (const ReliefField& field : option_fields())
    std::visit([&](const auto member) { f(static_cast<const OptionField&>(field), texts.*member); },
               field.value);
}

// Returns the options that the texts ask for, read and checked once and for all. A base of kind image has no
// height map yet. Errors: kind option, naming the option: those of check() and of the parse functions.
Result<ReliefOptions> parse_options(const OptionTexts& texts);

}  // namespace relievo
