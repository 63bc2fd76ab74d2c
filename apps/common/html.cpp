#include "common/html.h"

#include <cctype>

#include "relievo/core/text.h"

namespace relievo::app {

std::string url_of_path(std::string_view path) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string url;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = byte < 0x80 && (std::isalnum(byte) != 0 || std::string_view("-._/").contains(c));
    url += is_plain ? std::string(1, c) : cat('%', digits[byte >> 4], digits[byte & 15]);
  }
  return url;
}

}  // namespace relievo::app
