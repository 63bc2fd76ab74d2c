// Exports the functions of the WebAssembly module.
#include <array>
#include <cstddef>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "web/calls.h"

namespace {

using Json = nlohmann::json;
using namespace relievo::app::web;

// The answer to a call, for the host. It is valid until the next call.
struct AnswerView {
  std::uint32_t is_error;
  const char* text;
  std::size_t text_size;
  const std::byte* bytes;
  std::size_t byte_count;
};

Json error_json(const relievo::Error& error) {
  return {{"kind", name_of(error.kind)},
          {"input", error.input},
          {"place", error.place},
          {"expected", error.expected},
          {"message", error.message()}};
}

relievo::Result<CallAnswer> answer_to(std::string_view text) {
  const Json request = Json::parse(text, nullptr, false);
  if (!request.is_object() || !request.contains("call") || !request["call"].is_string())
    return relievo::option_error("call", "expected an object in JSON with the name of a call");
  return call(request["call"].get<std::string>(), request);
}

}  // namespace

extern "C" {

__attribute__((export_name("relievo_allocate"))) void* relievo_allocate(std::size_t size) {
  return std::malloc(size);
}

__attribute__((export_name("relievo_free"))) void relievo_free(void* memory) {
  std::free(memory);
}

// Calls a function. `request` is a JSON object with the function's name and its arguments.
__attribute__((export_name("relievo_call"))) const AnswerView* relievo_call(const char* request,
                                                                            std::size_t size) {
  static std::string text;
  static std::vector<std::byte> bytes;
  static AnswerView view;
  bytes = {};  // frees the last answer, since the call may need its memory
  relievo::Result<CallAnswer> answer = answer_to({request, size});
  const Json json = answer ? answer->json : error_json(answer.error());
  text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (answer) bytes = std::move(answer->bytes);
  view = {answer ? 0U : 1U, text.data(), text.size(), bytes.data(), bytes.size()};
  return &view;
}
}
