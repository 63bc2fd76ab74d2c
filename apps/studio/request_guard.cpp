#include "studio/request_guard.h"

#include <sys/random.h>

#include <array>
#include <cstdlib>

#include "relievo/core/text.h"
#include "studio/http_answers.h"

namespace relievo::app::studio {
namespace {

using httplib::Request;
using httplib::Response;

constexpr std::size_t most_path = 512;

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) std::abort();
  std::string text;
  for (const unsigned char byte : bytes) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

// Compares in constant time, so that the time does not reveal how much of a guessed token is right.
bool is_equal(std::string_view a, std::string_view b) {
  unsigned different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return different == 0;
}

// Returns whether a host is this machine. The port does not matter, since an ssh tunnel may use another one.
bool is_here(const std::string& host) {
  const std::size_t colon = host.rfind(':');
  const std::string_view name = std::string_view(host).substr(0, colon);
  if (colon == std::string::npos || (name != "127.0.0.1" && name != "localhost")) return false;
  const std::string_view port = std::string_view(host).substr(colon + 1);
  return !port.empty() && port.size() <= 5 && port.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

RequestGuard::RequestGuard(const std::string& former_token)
    : token_(former_token.size() == 32 ? former_token : random_token()) {}

std::string RequestGuard::address() const {
  return cat("http://127.0.0.1:", port_, "/", token_, "/");
}

std::optional<std::string> RequestGuard::admit(const Request& request, Response& response) const {
  const auto say = [&](int status, const char* text) -> std::optional<std::string> {
    refuse(response, status, text);
    return std::nullopt;
  };
  if (request.path.size() > most_path) return say(414, "the address is too long");
  if (request.get_header_value_count("Host") != 1 || !is_here(request.get_header_value("Host")))
    return say(403, "this server answers for this machine only");
  const std::string own_origin = "http://" + request.get_header_value("Host");
  if (request.has_header("Origin") && request.get_header_value("Origin") != own_origin)
    return say(403, "this server answers its own page only");
  const std::size_t slash = request.path.find('/', 1);
  const std::string_view given = std::string_view(request.path).substr(0, slash);
  if (!is_equal(given, "/" + token_)) return say(403, "open the address that `relievo studio` printed");
  if (slash == std::string::npos) {
    response.set_redirect("/" + token_ + "/", 308);
    return std::nullopt;
  }
  return request.path.substr(slash + 1);
}

}  // namespace relievo::app::studio
