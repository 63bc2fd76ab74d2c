#include "studio/answers.h"

#include <nlohmann/json.hpp>

#include "studio/requests.h"

namespace relievo::app::studio {
namespace {

using Json = nlohmann::json;

int status_of(ErrorKind kind) {
  constexpr int statuses[] = {400, 422, 409, 202, 500, 507};  // ordered as ErrorKind
  return statuses[static_cast<int>(kind)];
}

}  // namespace

Answer answer_of(const Json& json, int status) {
  return {status, "application/json", json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

Answer answer_of(const Error& error) {
  return answer_of(Json{{"error", error_json(error)}}, status_of(error.kind));
}

Answer answer_of(const Picture& picture, const Json& facts) {
  const auto& pixels = picture.image.pixels;
  return {200,
          "application/octet-stream",
          {reinterpret_cast<const char*>(pixels.data()), pixels.size()},
          {{"X-Relievo", facts.dump(-1, ' ', true)}}};
}

Answer refusal(int status, const std::string& text) {
  return answer_of(Json{{"error", {{"kind", "request"}, {"text", text}}}}, status);
}

}  // namespace relievo::app::studio
