#include "studio/server.h"

#include <sys/random.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "common/files.h"
#include "relievo/core/text.h"
#include "studio/http_answers.h"
#include "studio/http_server.h"
#include "studio/page_files.h"
#include "studio/requests.h"

namespace relievo::app::studio {
namespace {

using Json = nlohmann::json;
using httplib::Request;
using httplib::Response;
using namespace std::chrono_literals;

constexpr std::size_t most_json = 4U << 20, most_path = 512;
constexpr int most_waiting = 32, most_pages = 8;
// The largest number of simultaneous uploads: a quarter of the threads, so that the others can answer requests.
constexpr int most_files = 24;

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) std::abort();
  std::string text;
  for (const unsigned char byte : bytes) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

// Compares in constant time, so that the time does not reveal how much of a guessed token is right.
bool is_equal(std::string_view a, std::string_view b) {
  unsigned different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return different == 0;
}

// Returns whether a host is this machine. The port does not matter, since an ssh tunnel may use another one.
bool is_here(const std::string& host) {
  const std::size_t colon = host.rfind(':');
  const std::string_view name = std::string_view(host).substr(0, colon);
  if (colon == std::string::npos || (name != "127.0.0.1" && name != "localhost")) return false;
  const std::string_view port = std::string_view(host).substr(colon + 1);
  return !port.empty() && port.size() <= 5 && port.find_first_not_of("0123456789") == std::string_view::npos;
}

// Authorises requests: only the studio's own page on this machine may send them, and they must contain a random
// token, which is part of the page's address.
class RequestGuard {
 public:
  // Uses the token of a former run. If `former_token` is not a valid token, makes a new random one.
  explicit RequestGuard(const std::string& former_token)
      : token_(former_token.size() == 32 ? former_token : random_token()) {}

  void set_port(int port) { port_ = port; }
  const std::string& token() const { return token_; }
  std::string address() const { return cat("http://127.0.0.1:", port_, "/", token_, "/"); }

  // Returns the part of the path after the token. Refuses a request with a wrong host, origin or token, and
  // then returns nothing.
  std::optional<std::string> admit(const Request& request, Response& response) const {
    const auto say = [&](int status, const char* text) -> std::optional<std::string> {
      refuse(response, status, text);
      return std::nullopt;
    };
    if (request.path.size() > most_path) return say(414, "the address is too long");
    if (request.get_header_value_count("Host") != 1 || !is_here(request.get_header_value("Host")))
      return say(403, "this server answers for this machine only");
    const std::string own_origin = "http://" + request.get_header_value("Host");
    if (request.has_header("Origin") && request.get_header_value("Origin") != own_origin)
      return say(403, "this server answers its own page only");
    const std::size_t slash = request.path.find('/', 1);
    const std::string_view given = std::string_view(request.path).substr(0, slash);
    if (!is_equal(given, "/" + token_)) return say(403, "open the address that `relievo studio` printed");
    if (slash == std::string::npos) {
      response.set_redirect("/" + token_ + "/", 308);
      return std::nullopt;
    }
    return request.path.substr(slash + 1);
  }

 private:
  std::string token_;
  int port_ = 0;
};

class ScopedCount {
 public:
  explicit ScopedCount(std::atomic<int>& count) : count_(count), number_(++count) {}
  ScopedCount(const ScopedCount&) = delete;
  ScopedCount& operator=(const ScopedCount&) = delete;
  ~ScopedCount() { --count_; }

  // Returns the value of the count just after this object increased it.
  int number() const { return number_; }

 private:
  std::atomic<int>& count_;
  int number_;
};

class StatusStream {
 public:
  StatusStream(std::atomic<int>& pages, Actions& actions, const std::string& run_name)
      : count_(pages), actions_(actions), run_name_(run_name) {}

  // Returns a comment line and the events since the last call. The comment line is sent even without events, since
  // sending is the only way to find out whether the page is still open. The text of the first call begins with the
  // retry time and the name of the run instead of the comment line.
  std::string next() {
    std::string text = is_new_ ? cat("retry: 300\ndata: ", Json{{"run", run_name_}}.dump(), "\n\n") : ":\n";
    is_new_ = is_busy_ = false;
    for (Json& status : actions_.statuses()) {
      const std::string document = status["document"];
      is_busy_ |= status.value("busy", false);
      status["run"] = run_name_;
      std::string line = status.dump(-1, ' ', false, Json::error_handler_t::replace);
      if (last_[document] == line) continue;
      text += cat("data: ", line, "\n\n");
      last_[document] = std::move(line);
    }
    return text;
  }

  // Returns the pause before the next call. It is short while a document is being prepared, so that the page
  // shows the progress without delay.
  std::chrono::milliseconds pause() const { return is_busy_ ? 15ms : 80ms; }

 private:
  ScopedCount count_;
  Actions& actions_;
  std::string run_name_;
  bool is_new_ = true, is_busy_ = false;     // is_busy_: a document was being prepared at the last call
  std::map<std::string, std::string> last_;  // maps documents to their last statuses
};

}  // namespace

struct Server::State {
  Actions& actions;
  const DiskStore& store;
  ServerOptions options;
  const std::string run_name = std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
  RequestGuard guard;
  std::atomic<int> pages = 0, waiting = 0, files = 0;
  std::atomic<bool> had_page = false, is_stopping = false;
  HttpServer http;

  State(Actions& a, const DiskStore& s, const ServerOptions& o)
      : actions(a), store(s), options(o), guard(s.address().token) {
    set_up();
  }

  // ------------------------------------------------------------------------------------ GET requests

  void get(const std::string& name, Response& response) {
    if (name == "api/about") return send(answer_of(actions.about()), response);
    if (name == "api/events") return follow(response);
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

  // Streams the name of this run, followed by the statuses of open documents as they change. The stream stays
  // open as long as the page is open.
  void follow(Response& response) {
    if (pages >= most_pages) return refuse(response, 503, "too many pages are open");
    had_page = true;
    auto stream = std::make_shared<StatusStream>(pages, actions, run_name);
    response.status = 200;
    response.set_chunked_content_provider("text/event-stream",
                                          [this, stream](std::size_t, httplib::DataSink& sink) {
                                            if (is_stopping) return false;
                                            const std::string text = stream->next();
                                            const bool is_sent = sink.write(text.data(), text.size());
                                            std::this_thread::sleep_for(stream->pause());
                                            return is_sent;
                                          });
  }

  // ----------------------------------------------------------------------------------- handlers of requests

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

  void post(const Request& request, Response& response, const httplib::ContentReader& read) {
    const std::string name = request.path.substr(guard.token().size() + 2);
    if (name == "api/upload" || name == "api/project") return take_file(name, request, response, read);
    const std::string action = name.starts_with("api/") ? name.substr(4) : "";
    if (!actions.has(action)) return refuse(response, 404, "no such action");
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
    send(json ? actions.run(action, *json) : answer_of(json.error()), response);
  }

  void take_file(const std::string& name, const Request& request, Response& response,
                 const httplib::ContentReader& read) {
    if (!is_welcome(request, response, most_scan)) return;
    const ScopedCount count(files);
    if (count.number() > most_files) return refuse(response, 503, "too many files at once");
    bool is_whole = false;
    const BodyReader body = [&](const auto& take) {
      return is_whole = read_body(read, response, most_scan, take);
    };
    const std::string file = request.get_param_value("name");
    Answer made = name == "api/upload" ? actions.take_scan(file, body) : actions.take_project(file, body);
    if (is_whole) send(std::move(made), response);
  }

  void set_up() {
    http.set_tcp_nodelay(true);
    http.set_payload_max_length(most_scan);
    http.set_default_headers(
        {{"Cache-Control", "no-store"},
         {"Content-Security-Policy",
          "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' "
          "data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
          "frame-ancestors 'none'"},
         {"Referrer-Policy", "no-referrer"},
         {"Cross-Origin-Embedder-Policy", "require-corp"},
         {"Cross-Origin-Opener-Policy", "same-origin"},
         {"Cross-Origin-Resource-Policy", "same-origin"},
         {"Permissions-Policy", "camera=(), display-capture=(), geolocation=(), microphone=(), usb=()"},
         {"X-Content-Type-Options", "nosniff"},
         {"X-Frame-Options", "DENY"}});
    http.set_pre_routing_handler([this](const Request& q, Response& s) { return before(q, s); });
    http.set_expect_100_continue_handler([this](const Request& q, Response& s) {
      return guard.admit(q, s) && is_welcome(q, s, most_scan) ? 100 : s.status;
    });
    http.Post(".*",
              [this](const Request& q, Response& s, const httplib::ContentReader& r) { post(q, s, r); });
    http.set_exception_handler([](const Request&, Response& s, std::exception_ptr e) { answer(s, e); });
  }

  // Stops the server when no page has been open for a while.
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

Server::Server(Actions& actions, const DiskStore& store, const ServerOptions& options)
    : state_(std::make_unique<State>(actions, store, options)) {}
Server::~Server() = default;

Result<std::string> Server::bind() {
  const int wanted = state_->options.port, former = state_->store.address().port;
  std::optional<int> port;
  if (wanted == 0 && former > 0) port = state_->http.bind(former);  // pages that are still open use that port
  if (!port) port = state_->http.bind(wanted);
  if (!port) return std::unexpected(Error{ErrorKind::option, "port", {}, "expected a port that is free"});
  state_->guard.set_port(*port);
  state_->store.keep_address({*port, state_->guard.token()});
  return state_->guard.address();
}

void Server::run() {
  std::thread watcher([this] { state_->watch(); });
  state_->http.run();
  state_->is_stopping = true;
  watcher.join();
}

}  // namespace relievo::app::studio
