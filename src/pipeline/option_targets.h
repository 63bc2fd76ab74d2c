// Defines the variables into which options are read, and the functions that read them for the option table.
#pragma once

#include <optional>
#include <string>
#include <type_traits>

#include "relievo/option_table.h"

namespace relievo {

struct OptionTargets {
  ReliefOptions relief;
  DepthOptions depth;
  bool keeps_doubtful = false;     // see ReadOptions::keeps_doubtful
  std::string side = "front", up;  // together they determine the view
  std::optional<Outline> outline;  // default: a circle if there is a diameter
};

template <typename T, typename Owner>
T& target(T Owner::*member, OptionTargets& to) {
  if constexpr (std::is_same_v<Owner, View>)
    return to.relief.view.*member;
  else if constexpr (std::is_same_v<Owner, DepthOptions>)
    return to.depth.*member;
  else if constexpr (std::is_same_v<Owner, OptionTargets>)
    return to.*member;
  else
    return to.relief.*member;
}

template <auto member>
Result<void> read_number(const OptionValue& value, OptionTargets& to) {
  target(member, to) = std::get<double>(value);
  return {};
}

template <auto of>
std::optional<double> ruling_number(const ReliefOptions& options) {
  if constexpr (requires { (options.*of)(); })
    return (options.*of)();
  else if constexpr (requires { options.view.*of; })
    return options.view.*of;
  else
    return options.*of;
}

// Reads a number into a member. The effective value comes from `ruling`, which is the member itself or a
// function that returns a default if the member is empty.
template <auto member, auto ruling = member>
constexpr OptionAccess number{read_number<member>, ruling_number<ruling>};

// Reads a text into a member with a function that takes only the text.
template <auto member, auto parse>
constexpr OptionAccess text{[](const OptionValue& value, OptionTargets& to) -> Result<void> {
  RELIEVO_TRY(target(member, to), parse(std::get<std::string>(value)));
  return {};
}};

// Reads one of the words in `choices` into a member.
template <auto member, const auto& choices>
constexpr OptionAccess word{[](const OptionValue& value, OptionTargets& to) -> Result<void> {
  RELIEVO_TRY(target(member, to), parse_choice({}, std::get<std::string>(value), choices));
  return {};
}};

}  // namespace relievo
