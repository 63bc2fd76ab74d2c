#include "studio/answers.h"

#include <nlohmann/json.hpp>

#include "studio/requests.h"

namespace relievo::app::studio {
namespace {

using Json = nlohmann::json;

int status_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::input:
      return 400;
    case ErrorKind::option:
      return 422;
    case ErrorKind::output:
      return 500;
    case ErrorKind::cancelled:
      return 202;
    case ErrorKind::memory:
      return 507;
    default:
      return 409;
  }
}

}  // namespace

void answer(Answer& to, const Json& json, int status) {
  to.status = status;
  to.type = "application/json";
  to.body = json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void answer(Answer& to, const Error& error) {
  answer(to, {{"error", error_json(error)}}, status_of(error.kind));
}

void answer(Answer& to, const Picture& picture, const Json& about) {
  const auto& pixels = picture.image.pixels;
  to.status = 200;
  to.headers.emplace_back("X-Relievo", about.dump());
  to.type = "application/octet-stream";
  to.body.assign(reinterpret_cast<const char*>(pixels.data()), pixels.size());
}

void refuse(Answer& to, int status, const std::string& text) {
  answer(to, Json{{"error", {{"kind", "request"}, {"text", text}}}}, status);
}

}  // namespace relievo::app::studio
