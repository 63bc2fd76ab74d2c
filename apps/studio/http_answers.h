// Answers requests over HTTP, and reads their bodies, whose size is limited. Tested by
// apps/studio/tests/server.test.mjs.
#pragma once

#include "studio/answers.h"

// This header must be included last, because it defines a macro _res that breaks Eigen.
#include <httplib.h>

#include <exception>
#include <functional>
#include <string_view>

namespace relievo::app::studio {

void send(Answer answer, httplib::Response& response);

// Sends an error message that the page can show, and closes the connection without reading the rest of the
// request.
void refuse(httplib::Response& response, int status, const std::string& text);

// Answers a request that ended with an exception: memory or threads ran out, or a JSON value had the wrong
// type.
void answer(httplib::Response& response, const std::exception_ptr& exception);

// Returns whether the head of a request is acceptable. Otherwise refuses the request before any part of its
// body is read.
bool is_welcome(const httplib::Request& request, httplib::Response& response, std::size_t most_bytes);

// Reads a body in blocks and passes each to `take`. If the body does not arrive completely, or `take` does
// not accept it, refuses the request and returns false.
bool read_body(const httplib::ContentReader& read, httplib::Response& response, std::size_t most_bytes,
               const std::function<Result<void>(std::string_view)>& take);

}  // namespace relievo::app::studio
