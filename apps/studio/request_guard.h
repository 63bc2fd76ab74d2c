// Authorises requests to the studio's server: only its own page, on this machine, may send them.
#pragma once

// This header comes first, because the server's header defines a macro _res that breaks Eigen.
#include "relievo/core/types.h"

#include <httplib.h>

#include <optional>
#include <string>

namespace relievo::app::studio {

// Has a random token for the page's address, and checks that requests contain the token and come from that
// page.
class RequestGuard {
 public:
  // Takes the token of a former run, or draws a random one if `former_token` is no token.
  explicit RequestGuard(const std::string& former_token);

  void set_port(int port) { port_ = port; }
  const std::string& token() const { return token_; }
  std::string address() const;

  // Returns the rest of the path after the token; refuses a request with a wrong host, origin or token.
  std::optional<std::string> admit(const httplib::Request& request, httplib::Response& response) const;

 private:
  std::string token_;
  int port_ = 0;
};

}  // namespace relievo::app::studio
