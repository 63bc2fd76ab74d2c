// Gets values from results, and checks their errors.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <source_location>
#include <stdexcept>
#include <string>
#include <string_view>

#include "relievo/core/error.h"
#include "relievo/core/progress.h"
#include "relievo/core/text.h"

namespace relievo {

// Returns the value of a result. If there is none, the test fails with the error's message.
template <typename T>
T value_of(Result<T> result, const std::source_location& place = std::source_location::current()) {
  if (!result)
    throw std::runtime_error(cat(place.file_name(), ":", place.line(), ": ", result.error().message()));
  return std::move(*result);
}
template <typename T>
T value_of(std::optional<T> value, const std::source_location& place = std::source_location::current()) {
  if (!value) throw std::runtime_error(cat(place.file_name(), ":", place.line(), ": found no value"));
  return std::move(*value);
}

// Returns the error's message; "no error" if the result has a value.
template <typename T>
std::string message_of(const Result<T>& result) {
  return result ? "no error" : result.error().message();
}

// A progress that is cancelled from the start.
struct Cancelled : Progress {
  Cancelled() { cancel(); }
};

// The first function expects an error whose message contains `part`. The second also expects the error's kind.
template <typename T>
void expect_error(const Result<T>& result, std::string_view part) {
  const std::string message = message_of(result);
  EXPECT_TRUE(!result && message.contains(part)) << message << ", where this was expected: " << part;
}
template <typename T>
void expect_error(const Result<T>& result, ErrorKind kind, std::string_view part = {}) {
  expect_error(result, part);
  EXPECT_TRUE(result || result.error().kind == kind) << message_of(result);
}

}  // namespace relievo
