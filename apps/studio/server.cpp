#include "studio/server.h"

#include <atomic>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "common/export_file.h"
#include "common/files.h"
#include "common/option_list.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/io/read.h"
#include "relievo/samples/sample.h"
#include "studio/http_server.h"
#include "studio/page_files.h"
#include "studio/request_guard.h"
#include "studio/requests.h"

namespace relievo::app::studio {
namespace {

using Json = nlohmann::json;
using httplib::Request;
using httplib::Response;
using namespace std::chrono_literals;

constexpr std::size_t most_json = 4U << 20, most_scan = std::size_t{4} << 30;
constexpr int most_waiting = 32, most_pages = 8;

void answer(Response& response, const Json& json, int status = 200) {
  response.status = status;
  response.set_content(json.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
}

int status_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::input:
      return 400;
    case ErrorKind::option:
      return 422;
    case ErrorKind::output:
      return 500;
    default:
      return 409;
  }
}

void answer(Response& response, const Error& error) {
  answer(response, {{"error", error_json(error)}}, status_of(error.kind));
}

void answer(Response& response, const Picture& picture, const Json& about) {
  response.status = 200;
  response.set_header("X-Relievo", about.dump());
  const auto& pixels = picture.image.pixels;
  response.set_content(reinterpret_cast<const char*>(pixels.data()), pixels.size(),
                       "application/octet-stream");
}

// JSON of a wrong type where a text or number belongs ends up here, and files too large to be made.
void complain(Response& response, const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    refuse(response, 507, "expected more free memory for so much");
  } catch (...) {
    refuse(response, 400, "expected fields of their types");
  }
}

// Raises a counter by one for as long as it lives.
class ScopedCount {
 public:
  explicit ScopedCount(std::atomic<int>& count) : count_(count), number_(++count) {}
  ScopedCount(const ScopedCount&) = delete;
  ScopedCount& operator=(const ScopedCount&) = delete;
  ~ScopedCount() { --count_; }

  // Returns the count when this was made, itself included.
  int number() const { return number_; }

 private:
  std::atomic<int>& count_;
  int number_;
};

}  // namespace

struct Server::State {
  Engine& engine;
  const Store& store;
  ServerOptions options;
  std::mutex storing;
  RequestGuard guard;
  std::atomic<int> pages = 0, waiting = 0;
  std::atomic<bool> had_page = false, is_stopping = false;
  HttpServer http;

  State(Engine& e, const Store& s, const ServerOptions& o) : engine(e), store(s), options(o) { set_up(); }

  using Action = void (State::*)(const Json&, Response&);
  const std::map<std::string, Action, std::less<>> actions{
      {"open", &State::open},        {"view", &State::choose_view}, {"cancel", &State::cancel},
      {"frame", &State::frame},      {"scan", &State::scan},        {"profile", &State::profile},
      {"export", &State::make_file}, {"state", &State::keep_state}, {"project", &State::check_project}};

  // ------------------------------------------------------------------------------------------------ actions

  void open(const Json& json, Response& response) {
    Result<ScanSource> input = input_from_json(json.value("input", Json()), "input");
    if (!input) return answer(response, input.error());
    engine.open(*input, view_texts(json));
    const std::lock_guard lock(storing);
    (void)store.remember(
        *input);  // a scan can be worked on without; that nothing can be kept is said elsewhere
    answer(response, Json::object());
  }

  void choose_view(const Json& json, Response& response) {
    const auto ok = engine.choose_view(view_texts(json));
    ok ? answer(response, Json::object()) : answer(response, ok.error());
  }

  void cancel(const Json&, Response& response) {
    engine.cancel();
    answer(response, Json::object());
  }

  void frame(const Json& json, Response& response) {
    const Result<PictureRequest> request = picture_request(json);
    if (!request) return answer(response, request.error());
    const Result<PictureAnswer> made = engine.picture(*request);
    if (!made) return answer(response, made.error());
    answer(response, made->picture, to_json(*made));
  }

  void scan(const Json& json, Response& response) {
    const Result<View> view = view_from(json);
    const Result<PictureRequest> size = picture_request(json);
    if (!view || !size) return answer(response, view ? size.error() : view.error());
    const Result<Picture> picture = engine.scan_picture(*view, size->render.width, size->render.height);
    if (!picture) return answer(response, picture.error());
    answer(response, *picture, {{"width", picture->image.width}, {"height", picture->image.height}});
  }

  void profile(const Json& json, Response& response) {
    const Result<PictureRequest> request = picture_request(json);
    const Result<Vec2> from = place_from(json, "from"), to = place_from(json, "to");
    if (!request) return answer(response, request.error());
    if (!from || !to) return answer(response, from ? to.error() : from.error());
    const auto heights = engine.profile(*request, {*from, *to});
    if (!heights) return answer(response, heights.error());
    answer(response, {{"heights_mm", *heights}});
  }

  void make_file(const Json& json, Response& response) {
    const Result<ReliefOptions> wanted = options_from_json(json.value("options", Json()), "options");
    if (!wanted) return answer(response, wanted.error());
    const Result<int> pixels = pixels_from(json);
    if (!pixels) return answer(response, pixels.error());
    std::optional<ScanSource> source;
    if (json.contains("input")) {
      const Result<ScanSource> input = input_from_json(json["input"], "input");
      if (!input) return answer(response, input.error());
      source = *input;
    }
    Result<ExportedFile> file = engine.make_file({source, *wanted, json.value("format", ""), *pixels});
    if (!file) return answer(response, file.error());
    response.status = 200;
    response.body = std::move(file->bytes);
    response.set_header("Content-Type", file->type);
  }

  void keep_state(const Json& json, Response& response) {
    const std::lock_guard lock(storing);
    const auto ok = store.keep_state(json.dump());
    ok ? answer(response, Json::object()) : answer(response, ok.error());
  }

  void check_project(const Json& json, Response& response) {
    const std::string name = json.value("name", "project");
    const Result<Project> project = read_project(json.value("text", ""), name);
    if (!project) return answer(response, project.error());
    if (auto ok = parse_options(project->options); !ok) return answer(response, ok.error());
    answer(response, {{"input", app::to_json(project->input)}, {"options", app::to_json(project->options)}});
  }

  // -------------------------------------------------------------------------------------------------- reads

  Json about() {
    Json samples = Json::array();
    for (const SampleInfo& sample : relievo::samples())
      samples.push_back({{"name", sample.name}, {"description", sample.description}});
    Json recent = Json::array();
    const std::lock_guard lock(storing);
    for (const ScanSource& input : store.recent()) recent.push_back(to_json(input));
    const Json state = Json::parse(store.state(), nullptr, false);
    return {{"version", version},
            {"options", option_list()},
            {"readable", readable_formats()},
            {"endings", readable_endings()},
            {"views", view_list()},
            {"materials", material_list()},
            {"stages", stage_list()},
            {"curve", {{"most_points", ToneCurve::most_points}}},
            {"formats", format_list()},
            {"samples", samples},
            {"recent", recent},
            {"notice", store.notice()},
            {"most_upload", most_scan},
            {"status", to_json(engine.status())},
            {"state", state.is_object() ? state : Json()}};
  }

  void get(const std::string& name, Response& response) {
    if (name == "api/about") return answer(response, about());
    if (name == "api/events") return follow(response);
    if (name == "api/facts") {
      const Result<ModelFacts> facts = engine.facts();
      return facts ? answer(response, to_json(*facts)) : answer(response, facts.error());
    }
    if (name == "api/views") {
      const auto views = engine.suggest_views();
      return views ? answer(response, Json{{"views", *views}}) : answer(response, views.error());
    }
    send_file(name.empty() ? "index.html" : name, response);
  }

  void send_file(const std::string& name, Response& response) {
    const PageFile* const file = find_page_file(name);
    if (!file) return refuse(response, 404, "no such page");
    response.status = 200;
    if (options.page_folder.empty())
      return response.set_content(file->bytes.data(), file->bytes.size(), std::string(file->type));
    const auto bytes = read_file(options.page_folder + "/" + name);
    if (!bytes) return refuse(response, 404, "no such file in the page's folder");
    response.set_content(reinterpret_cast<const char*>(bytes->data()), bytes->size(),
                         std::string(file->type));
  }

  // Streams the engine's status as it changes. The page keeps the stream open for as long as it lives.
  void follow(Response& response) {
    if (pages >= most_pages) return refuse(response, 503, "too many pages are open");
    auto count = std::make_shared<ScopedCount>(pages);
    had_page = true;
    auto last = std::make_shared<std::string>();
    response.status = 200;
    response.set_chunked_content_provider("text/event-stream", [this, count, last](std::size_t,
                                                                                   httplib::DataSink& sink) {
      if (is_stopping) return false;
      const std::string text = to_json(engine.status()).dump();
      const std::string event =
          text == *last ? ":\n"
                        : "data: " + text + "\n\n";  // a comment finds out whether the page is still there
      *last = text;
      const bool is_sent = sink.write(event.data(), event.size());
      std::this_thread::sleep_for(80ms);
      return is_sent;
    });
  }

  // ------------------------------------------------------------------------------------------------- guards

  httplib::Server::HandlerResponse before(const Request& request, Response& response) {
    using enum httplib::Server::HandlerResponse;
    const std::optional<std::string> name = guard.admit(request, response);
    if (!name) return Handled;
    if (request.method == "POST") return Unhandled;
    if (request.method != "GET" && request.method != "HEAD") {
      refuse(response, 405, "expected GET or POST");
      return Handled;
    }
    get(*name, response);
    return Handled;
  }

  // Refuses a body by what its head says of it, before any of it is read.
  static bool is_welcome(const Request& request, Response& response, std::size_t limit) {
    if (request.get_header_value<std::uint64_t>("Content-Length") > limit)
      refuse(response, 413, cat("expected at most ", limit >> 20, " MiB"));
    else if (!request.has_header("Content-Length") && !request.has_header("Transfer-Encoding"))
      refuse(response, 411, "expected a length");
    else if (request.is_multipart_form_data())
      refuse(response, 415, "expected plain bytes or JSON");
    else
      return true;
    return false;
  }

  // Reads a body piece by piece; returns whether all of it came and was taken, and otherwise refuses it.
  static bool read_body(const httplib::ContentReader& read, Response& response, std::size_t limit,
                        const std::function<Result<void>(std::string_view)>& take) {
    std::size_t size = 0;
    Result<void> taken;
    const bool is_whole = read([&](const char* data, std::size_t more) {
      size += more;
      if (size <= limit) taken = take({data, more});
      return size <= limit && taken;
    });
    if (is_whole) return true;
    if (!taken)
      answer(response, taken.error());
    else if (size > limit)
      refuse(response, 413, cat("expected at most ", limit >> 20, " MiB"));
    else
      refuse(response, 400, "the request ended early");
    return false;
  }

  void post(const Request& request, Response& response, const httplib::ContentReader& read) {
    const std::string name = request.path.substr(guard.token().size() + 2);
    if (name == "api/upload") return upload(request, response, read);
    const auto action = actions.find(std::string_view(name).substr(std::min<std::size_t>(name.size(), 4)));
    if (!name.starts_with("api/") || action == actions.end()) return refuse(response, 404, "no such action");
    if (!is_welcome(request, response, most_json)) return;
    std::string body;
    const auto take = [&](std::string_view bytes) {
      body += bytes;
      return Result<void>{};
    };
    if (!read_body(read, response, most_json, take)) return;
    const ScopedCount count(waiting);
    if (count.number() > most_waiting) return refuse(response, 503, "too much at once");
    const Result<Json> json = parse_body(body);
    if (!json) return answer(response, json.error());
    (this->*action->second)(*json, response);
  }

  void upload(const Request& request, Response& response, const httplib::ContentReader& read) {
    if (!is_welcome(request, response, most_scan)) return;
    DroppedScan scan = store.begin_scan(request.get_param_value("name"));
    const auto take = [&](std::string_view bytes) { return scan.append(bytes); };
    if (!read_body(read, response, most_scan, take)) return;
    const std::lock_guard lock(storing);
    const Result<ScanSource> input = store.keep(scan);
    if (!input) return answer(response, input.error());
    answer(response, {{"input", to_json(*input)}});
  }

  void set_up() {
    http.set_tcp_nodelay(true);
    http.set_payload_max_length(most_scan);
    http.set_default_headers({{"Cache-Control", "no-store"},
                              {"Content-Security-Policy",
                               "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' "
                               "data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
                               "frame-ancestors 'none'"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"X-Content-Type-Options", "nosniff"}});
    http.set_pre_routing_handler([this](const Request& q, Response& s) { return before(q, s); });
    http.set_expect_100_continue_handler([this](const Request& q, Response& s) {
      return guard.admit(q, s) && is_welcome(q, s, most_scan) ? 100 : s.status;
    });
    http.Post(".*",
              [this](const Request& q, Response& s, const httplib::ContentReader& r) { post(q, s, r); });
    http.set_exception_handler([](const Request&, Response& s, std::exception_ptr e) { complain(s, e); });
  }

  // Stops the server when no page was there for a while.
  void watch() {
    auto last_seen = std::chrono::steady_clock::now();
    while (!is_stopping) {
      const auto now = std::chrono::steady_clock::now();
      if (pages > 0 || !had_page) last_seen = now;
      if (now - last_seen > options.linger) {
        is_stopping = true;
        http.stop();
        return;
      }
      std::this_thread::sleep_for(100ms);
    }
  }
};

Server::Server(Engine& engine, const Store& store, const ServerOptions& options)
    : state_(std::make_unique<State>(engine, store, options)) {}
Server::~Server() = default;

Result<std::string> Server::bind() {
  const std::optional<int> port = state_->http.bind(state_->options.port);
  if (!port) return std::unexpected(Error{ErrorKind::option, "port", {}, "expected a port that is free"});
  state_->guard.set_port(*port);
  return state_->guard.address();
}

void Server::run() {
  std::thread watcher([this] { state_->watch(); });
  state_->http.run();
  state_->is_stopping = true;
  watcher.join();
}

}  // namespace relievo::app::studio
