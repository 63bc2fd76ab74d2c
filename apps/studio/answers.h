// Answers to the page's requests: JSON, pictures and errors. Tested by apps/studio/tests/server.test.mjs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/picture/render.h"

namespace relievo::app::studio {

struct Answer {
  int status = 200;  // as in HTTP
  std::string type;  // of the body, as browsers know it
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers = {};
};

Answer answer_of(const nlohmann::json& json, int status = 200);

// The status says whose fault it is: 400 and 422 the request's, 409 that the engine has nothing to answer with, 500 the
// disk's. What was cancelled is nobody's fault: 202, which browsers do not complain about.
Answer answer_of(const Error& error);

// The pixels are the body; the facts about them are in the header X-Relievo.
Answer answer_of(const Picture& picture, const nlohmann::json& about);

// Returns an error that the page can show.
Answer refusal(int status, const std::string& text);

}  // namespace relievo::app::studio
