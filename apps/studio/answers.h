// Makes the answers to the page's requests from JSON, pictures and errors. Tested by
// apps/studio/tests/server.test.mjs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/picture/render.h"

namespace relievo::app::studio {

struct Answer {
  int status = 200;  // HTTP status
  std::string type;  // MIME type of the body
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers = {};
};

Answer answer_of(const nlohmann::json& json, int status = 200);

// Returns the error with its HTTP status: 400 or 422 for a wrong request, 409 if no relief can be made or
// none is ready, 500 if the disk failed, 507 if the memory ran out. A cancelled request gets 202, which is a
// status of success, because browsers report statuses of failure as errors in their console.
Answer answer_of(const Error& error);

// Returns the pixels as the body, and the facts about them in the header X-Relievo.
Answer answer_of(const Picture& picture, const nlohmann::json& facts);

// Returns an answer with an error message that the page can show.
Answer refusal(int status, const std::string& text);

}  // namespace relievo::app::studio
