// Authorises requests to the studio's server: only the studio's own page on this machine may send them.
#pragma once

// This header must be included first, because the server's header defines a macro _res that breaks Eigen.
#include "relievo/core/types.h"

#include <httplib.h>

#include <optional>
#include <string>

namespace relievo::app::studio {

// Checks that requests come from the page and contain its token, a random text that is part of the page's address.
class RequestGuard {
 public:
  // Uses the token of a former run. If `former_token` is not a valid token, makes a new random one.
  explicit RequestGuard(const std::string& former_token);

  void set_port(int port) { port_ = port; }
  const std::string& token() const { return token_; }
  std::string address() const;

  // Returns the part of the path after the token. Refuses a request with a wrong host, origin or token, and
  // then returns nothing.
  std::optional<std::string> admit(const httplib::Request& request, httplib::Response& response) const;

 private:
  std::string token_;
  int port_ = 0;
};

}  // namespace relievo::app::studio
