// Who may ask the studio's server: its own page, on this machine.
#pragma once

// Before the server's header, which defines a macro _res that Eigen cannot live with.
#include "relievo/core/types.h"

#include <httplib.h>

#include <optional>
#include <string>

namespace relievo::studio {

// Answers with an error that the page can show, and closes the connection: what else the request holds is not
// read.
void refuse(httplib::Response& response, int status, const std::string& text);

// A secret in the page's address, and the checks that a request knows it and comes from there.
class Guard {
 public:
  Guard();

  void set_port(int port) { port_ = port; }
  const std::string& token() const { return token_; }
  std::string address() const;

  // Returns the path below the token; otherwise refuses, for another host, origin or token.
  std::optional<std::string> admit(const httplib::Request& request, httplib::Response& response) const;

 private:
  bool is_here(const std::string& host) const;

  std::string token_;
  int port_ = 0;
};

}  // namespace relievo::studio
