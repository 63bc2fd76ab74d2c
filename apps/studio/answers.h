// Answers of the studio's server: JSON, pictures and errors, and the bodies of requests, which have limits.
#pragma once

// Before the server's header, which defines a macro _res that Eigen cannot live with.
#include "relievo/picture/render.h"

#include <httplib.h>

#include <exception>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "relievo/core/error.h"

namespace relievo::app::studio {

void answer(httplib::Response& response, const nlohmann::json& json, int status = 200);

// The status says whose fault it is: 400 and 422 the request's, 409 that the engine has nothing to answer with, 500 the
// disk's.
void answer(httplib::Response& response, const Error& error);

// The pixels are the body; what is said about them stands in the header X-Relievo.
void answer(httplib::Response& response, const Picture& picture, const nlohmann::json& about);

// Answers after an exception: JSON of a wrong type where a text or number belongs, and files too large to be made.
void answer(httplib::Response& response, const std::exception_ptr& exception);

// Returns whether a body may come; otherwise refuses it by what its head says of it, before any of it is read.
bool is_welcome(const httplib::Request& request, httplib::Response& response, std::size_t most_bytes);

// Reads a body piece by piece; returns whether all of it came and was taken, and otherwise refuses it.
bool read_body(const httplib::ContentReader& read, httplib::Response& response, std::size_t most_bytes,
               const std::function<Result<void>(std::string_view)>& take);

}  // namespace relievo::app::studio
