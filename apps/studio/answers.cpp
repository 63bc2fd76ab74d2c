#include "studio/answers.h"

#include <nlohmann/json.hpp>

#include "relievo/core/text.h"
#include "studio/request_guard.h"
#include "studio/requests.h"

namespace relievo::app::studio {
namespace {

using Json = nlohmann::json;
using httplib::Request;
using httplib::Response;

int status_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::input:
      return 400;
    case ErrorKind::option:
      return 422;
    case ErrorKind::output:
      return 500;
    default:
      return 409;
  }
}

}  // namespace

void answer(Response& response, const Json& json, int status) {
  response.status = status;
  response.set_content(json.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
}

void answer(Response& response, const Error& error) {
  answer(response, {{"error", error_json(error)}}, status_of(error.kind));
}

void answer(Response& response, const Picture& picture, const Json& about) {
  response.status = 200;
  response.set_header("X-Relievo", about.dump());
  const auto& pixels = picture.image.pixels;
  response.set_content(reinterpret_cast<const char*>(pixels.data()), pixels.size(),
                       "application/octet-stream");
}

void answer(Response& response, const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    refuse(response, 507, "expected more free memory for so much");
  } catch (...) {
    refuse(response, 400, "expected fields of their types");
  }
}

bool is_welcome(const Request& request, Response& response, std::size_t most_bytes) {
  if (request.get_header_value<std::uint64_t>("Content-Length") > most_bytes)
    refuse(response, 413, cat("expected at most ", most_bytes >> 20, " MiB"));
  else if (!request.has_header("Content-Length") && !request.has_header("Transfer-Encoding"))
    refuse(response, 411, "expected a length");
  else if (request.is_multipart_form_data())
    refuse(response, 415, "expected plain bytes or JSON");
  else
    return true;
  return false;
}

bool read_body(const httplib::ContentReader& read, Response& response, std::size_t most_bytes,
               const std::function<Result<void>(std::string_view)>& take) {
  std::size_t size = 0;
  Result<void> taken;
  const bool is_whole = read([&](const char* data, std::size_t more) {
    size += more;
    if (size <= most_bytes) taken = take({data, more});
    return size <= most_bytes && taken;
  });
  if (is_whole) return true;
  if (!taken)
    answer(response, taken.error());
  else if (size > most_bytes)
    refuse(response, 413, cat("expected at most ", most_bytes >> 20, " MiB"));
  else
    refuse(response, 400, "the request ended early");
  return false;
}

}  // namespace relievo::app::studio
