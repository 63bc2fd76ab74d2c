// Fuzz target of the studio's requests, without HTTP. The first byte chooses an action; the rest is the body of the
// request. One document is open, and pictures and exports are small. Every answer must be one that the page can show.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "fuzz/fuzz_program.h"
#include "relievo/io/write.h"
#include "relievo/samples/sample.h"
#include "studio/actions.h"
#include "studio/disk/disk_store.h"
#include "studio/requests.h"

namespace {

using namespace relievo;
using namespace relievo::app::studio;
using Json = nlohmann::json;

constexpr const char* action_names[] = {"picture",  "scan",   "profile",   "export",       "view",
                                        "reach",    "state",  "thumbnail", "recent",       "leave",
                                        "document", "status", "facts",     "pixels",       "views",
                                        "check",    "piece",  "save",      "cancel_piece", "points"};

// A studio with an open sample.
struct Studio {
  std::string folder = std::filesystem::temp_directory_path() / "relievo-fuzz-XXXXXX";
  DiskStore store{*take_state_folder(::mkdtemp(folder.data()))};
  OpenDocuments documents;
  Actions actions{documents, store};
  std::string document;

  Studio() {
    const std::string scan = folder + "/scan.ply";
    const std::vector<std::byte> ply = write_ply(*make_sample("shell", {.points = 2000}));
    std::ofstream(scan, std::ios::binary).write(reinterpret_cast<const char*>(ply.data()), std::ssize(ply));
    const Answer opened = actions.run("open", {{"input", {{"path", scan}}}, {"tab", "fuzz"}});
    document = Json::parse(opened.body)["document"];
    while (documents.find(document)->status().is_busy)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ~Studio() { std::filesystem::remove_all(folder); }
};

// Changes a request so that it refers to the open document, and reduces its pictures and samples so that
// they take little time.
Json small(Json json, const std::string& document) {
  if (json.value("document", Json("")) != Json("x")) json["document"] = document;
  json["width"] = 48;
  json["height"] = 32;
  if (!json.contains("options")) json["options"] = Json::object();
  if (json["options"].is_object()) json["options"]["resolution"] = 2;
  if (json.contains("pixels")) json["pixels"] = 16;
  return json;
}

}  // namespace

void run_target(std::string_view input) {
  static Studio studio;
  if (input.empty()) return;
  const Result<Json> json = parse_body(input.substr(1));
  Answer made;
  try {
    const char* const action = action_names[static_cast<unsigned char>(input[0]) % std::size(action_names)];
    made = json ? studio.actions.run(action, small(*json, studio.document)) : answer_of(json.error());
  } catch (const Json::exception&) {
    return;  // a field has the wrong type, which the server answers with 400
  }
  constexpr std::array known = {200, 202, 400, 409, 422, 500};
  const bool is_known = std::ranges::find(known, made.status) != known.end();
  if (!is_known) std::abort();
  if (made.status != 200 && Json::parse(made.body)["error"]["text"].get<std::string>().empty()) std::abort();
}
