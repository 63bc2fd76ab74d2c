#include "studio/http_answers.h"

#include <new>
#include <system_error>
#include <utility>

#include "relievo/core/text.h"
#include "relievo/core/within_memory.h"

namespace relievo::app::studio {
using httplib::Request;
using httplib::Response;

void send(Answer answer, Response& response) {
  response.status = answer.status;
  response.body = std::move(answer.body);
  response.set_header("Content-Type", answer.type);
  for (const auto& [name, value] : answer.headers) response.set_header(name, value);
}

void refuse(Response& response, int status, const std::string& text) {
  send(refusal(status, text), response);
  response.set_header("Connection", "close");
}

void answer(Response& response, const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    send(answer_of(memory_error()), response);
  } catch (const std::length_error&) {
    send(answer_of(memory_error()), response);
  } catch (const std::system_error&) {
    refuse(response, 503, "expected more threads than the system gives");
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
    send(answer_of(taken.error()), response);
  else if (size > most_bytes)
    refuse(response, 413, cat("expected at most ", most_bytes >> 20, " MiB"));
  else
    refuse(response, 400, "the request ended early");
  return false;
}

}  // namespace relievo::app::studio
