// Fuzz target of the studio's web server. An input is the text that one connection sends; in this text,
// byte 1 stands for the token and byte 2 for the host. No scan is open, because request_fuzz.cpp tests
// requests about an open scan. Every answer must begin like an HTTP answer.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include "fuzz/fuzz_program.h"
#include "relievo/core/text.h"
#include "studio/actions.h"
#include "studio/disk/disk_store.h"
#include "studio/server.h"

namespace {

using namespace relievo;
using namespace relievo::app::studio;

// A studio that answers requests until this program ends.
struct Studio {
  std::string folder = std::filesystem::temp_directory_path() / "relievo-fuzz-XXXXXX";
  DiskStore store{*take_state_folder(::mkdtemp(folder.data()))};
  OpenDocuments documents;
  Actions actions{documents, store};
  Server server{actions, store, {0, "", std::chrono::hours(1000)}};

  Studio() {
    if (!server.bind()) std::abort();
    std::thread([this] { server.run(); }).detach();
  }

  std::string filled_in(std::string_view input) const {
    const StudioAddress address = store.address();
    std::string text;
    for (const char c : input) {
      if (c == '\1')
        text += address.token;
      else if (c == '\2')
        text += cat("127.0.0.1:", address.port);
      else
        text += c;
    }
    return text;
  }

  // Sends the text on a new connection, and waits until the studio closes the connection. Returns the first
  // bytes of the answer.
  std::string answer_to(const std::string& text) const {
    const int connection = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(store.address().port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(connection, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) std::abort();
    (void)!::send(connection, text.data(), text.size(), MSG_NOSIGNAL);
    ::shutdown(connection, SHUT_WR);
    std::string begin;
    char bytes[4096];
    for (ssize_t got = 1; (got = ::recv(connection, bytes, sizeof bytes, 0)) > 0;)
      if (begin.empty()) begin.assign(bytes, static_cast<std::size_t>(got));
    ::close(connection);
    return begin;
  }
};

}  // namespace

void run_target(std::string_view input) {
  static const Studio& studio = *new Studio;  // its threads use it until the program ends
  const std::string answer = studio.answer_to(studio.filled_in(input));
  if (!answer.empty() && !std::string_view("HTTP/1.1 ").starts_with(answer.substr(0, 9))) std::abort();
}
