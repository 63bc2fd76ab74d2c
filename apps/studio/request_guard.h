// Authorises requests to the studio's server: only its own page, on this machine, may send them.
#pragma once

// Before the server's header, which defines a macro _res that Eigen cannot live with.
#include "relievo/core/types.h"

#include <httplib.h>

#include <optional>
#include <string>

namespace relievo::app::studio {

// Has a random token for the page's address and checks that requests know it and come from there.
class RequestGuard {
 public:
  // Takes the token of a former run, or draws one if there is none.
  explicit RequestGuard(const std::string& former_token);

  void set_port(int port) { port_ = port; }
  const std::string& token() const { return token_; }
  std::string address() const;

  // Returns the path below the token; otherwise refuses, for another host, origin or token.
  std::optional<std::string> admit(const httplib::Request& request, httplib::Response& response) const;

 private:
  std::string token_;
  int port_ = 0;
};

}  // namespace relievo::app::studio
