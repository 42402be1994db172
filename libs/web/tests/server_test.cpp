// SPDX-License-Identifier: Apache-2.0
// Real sockets: what strangers send, and what the server says.
#include "rave/web/server.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>

#include "rave/base/file.hpp"
#include "rave/base_testing/no_threads.hpp"

namespace rave::web {
namespace {

class Echo final : public Handler {
 public:
  Response serve(const Request& request) override {
    ++served;
    if (request.path == "/file") {
      Response response;
      response.type = "application/octet-stream";
      response.file = file;
      return response;
    }
    return text_response(200, fmt::format("path {}\n", request.path));
  }
  Admission admit(const Request& request) override {
    if (request.cookie("key") == "good") return {};
    return {4401, "not signed in"};
  }
  void opened(std::uint64_t, Socket& socket, const Request&) override {
    ++open;
    socket.send_text(std::make_shared<const std::string>("welcome"));
  }
  Upgrade upgrade(const Request& request) override {
    if (request.path != "/other") return {text_response(404, "not found\n"), {}};
    if (!request.query.contains("pass")) return {text_response(401, "no pass\n"), {}};
    return {std::nullopt, "other.1"};
  }
  void received(std::uint64_t, std::string_view) override { ++messages; }
  bool received_binary(std::uint64_t, std::string_view) override { return false; }
  void closed(std::uint64_t) override {
    --open;
    open.notify_all();
  }

  std::filesystem::path file;  ///< Set before it is asked for.
  std::atomic<int> served = 0;
  std::atomic<int> open = 0;
  std::atomic<int> messages = 0;
};

class WebServer : public testing::Test {
 protected:
  void SetUp() override {
    auto started = Server::start(options(), handler_);
    ASSERT_TRUE(started) << started.error().text();
    server_ = *std::move(started);
  }
  static ServerOptions options() {
    ServerOptions options;
    options.request_bytes = 4096;
    options.idle = std::chrono::seconds(1);
    return options;
  }
  [[nodiscard]] int connected() const {
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(server_->port());
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    return fd;
  }
  /// Sends bytes and reads what comes until the other end closes, or `end` was read.
  [[nodiscard]] std::string ask(const std::string& bytes, std::string_view end = {}) const {
    const int fd = connected();
    EXPECT_EQ(::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL), std::ssize(bytes));
    std::string answer;
    char buffer[4096];
    while (end.empty() || answer.find(end) == std::string::npos) {
      const ssize_t got = ::recv(fd, buffer, sizeof buffer, 0);
      if (got <= 0) break;
      answer.append(buffer, static_cast<std::size_t>(got));
    }
    ::close(fd);
    return answer;
  }
  [[nodiscard]] std::string get(const std::string& target, const std::string& more = {}) const {
    return ask(fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n{}\r\n",
                           target, server_->port(), more));
  }
  [[nodiscard]] std::string upgrading(const std::string& more, const char* path = "/ws") const {
    return fmt::format(
        "GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: Upgrade\r\n"
        "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n{}\r\n",
        path, server_->port(), more);
  }
  [[nodiscard]] std::string upgrade(const std::string& more, std::string_view end,
                                    const char* path = "/ws") const {
    return ask(upgrading(more, path), end);
  }

  Echo handler_;
  std::unique_ptr<Server> server_;
};

TEST_F(WebServer, AnswersWithAStrictPolicy) {
  const std::string answer = get("/a/b?c=d");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
  EXPECT_NE(answer.find("path /a/b\n"), std::string::npos);
  EXPECT_NE(answer.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
  EXPECT_NE(answer.find("X-Content-Type-Options: nosniff"), std::string::npos);
}

TEST_F(WebServer, SendsAFileOfManyPieces) {
  std::string content;
  for (int i = 0; content.size() < 3'000'000; ++i) content += fmt::format("{:08d}", i);
  handler_.file = std::filesystem::temp_directory_path() / fmt::format("rave-web-{}", ::getpid());
  ASSERT_TRUE(write_file_atomically(handler_.file, content));
  const std::string answer = get("/file");
  const std::size_t body = answer.find("\r\n\r\n");
  ASSERT_NE(body, std::string::npos);
  EXPECT_NE(answer.find(fmt::format("Content-Length: {}\r\n", content.size())), std::string::npos);
  EXPECT_TRUE(answer.substr(body + 4) == content);
  // Only the head is asked for.
  const std::string head = ask(fmt::format(
      "HEAD /file HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n\r\n", server_->port()));
  EXPECT_TRUE(head.ends_with("\r\n\r\n"));
  EXPECT_NE(head.find(fmt::format("Content-Length: {}\r\n", content.size())), std::string::npos);
  std::filesystem::remove(handler_.file);
  EXPECT_TRUE(get("/file").starts_with("HTTP/1.1 404"));
}

TEST_F(WebServer, RefusesPathsThatLeadOut) {
  EXPECT_TRUE(get("/../etc/passwd").starts_with("HTTP/1.1 400"));
  EXPECT_TRUE(get("/%2e%2e/etc/passwd").starts_with("HTTP/1.1 400"));
  EXPECT_EQ(handler_.served, 0);
}

TEST_F(WebServer, RefusesNamesThatAreNotItsOwn) {
  const std::string answer =
      ask("GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 421")) << answer;
  EXPECT_EQ(handler_.served, 0);
}

TEST_F(WebServer, RefusesWritingAndSocketsOfOtherOrigins) {
  const std::string post =
      ask(fmt::format("POST / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nOrigin: "
                      "http://evil.example\r\nContent-Length: 0\r\n"
                      "Connection: close\r\n\r\n",
                      server_->port()));
  EXPECT_TRUE(post.starts_with("HTTP/1.1 403")) << post;
  const std::string socket =
      upgrade("Origin: http://evil.example\r\nCookie: key=good\r\n", "refused");
  EXPECT_TRUE(socket.starts_with("HTTP/1.1 403")) << socket;
  EXPECT_EQ(handler_.served, 0);
  EXPECT_EQ(handler_.open, 0);
}

TEST_F(WebServer, RefusesWhatIsTooLargeOrMalformed) {
  EXPECT_TRUE(get("/", "X-Long: " + std::string(9000, 'x') + "\r\n").starts_with("HTTP/1.1 413"));
  EXPECT_EQ(ask("NONSENSE\r\n\r\n").find("200"), std::string::npos);
  EXPECT_TRUE(
      ask(fmt::format("DELETE / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n\r\n",
                      server_->port()))
          .starts_with("HTTP/1.1 405"));
}

TEST_F(WebServer, LetsInWhoIsAdmittedAlone) {
  const std::string in = upgrade("Cookie: key=good\r\n", "welcome");
  EXPECT_TRUE(in.starts_with("HTTP/1.1 101")) << in;
  EXPECT_NE(in.find("welcome"), std::string::npos);
  // The close frame: code 4401, big endian, and the reason.
  const std::string out = upgrade("", "not signed in");
  EXPECT_NE(out.find("\x11\x31not signed in"), std::string::npos);
  EXPECT_EQ(out.find("welcome"), std::string::npos);
}

TEST_F(WebServer, AsksItsHandlerOfOtherPathsForSockets) {
  EXPECT_TRUE(upgrade("", "not found", "/nowhere").starts_with("HTTP/1.1 404"));
  EXPECT_TRUE(upgrade("", "no pass", "/other").starts_with("HTTP/1.1 401"));
  // Whose origin is welcome there, the handler says.
  const std::string in =
      upgrade("Origin: http://friend.example\r\nCookie: key=good\r\n", "welcome", "/other?pass=1");
  EXPECT_TRUE(in.starts_with("HTTP/1.1 101")) << in;
  EXPECT_NE(in.find("Sec-WebSocket-Protocol: other.1\r\n"), std::string::npos) << in;
  // Nor can a request that writes take that way.
  const std::string post =
      ask(fmt::format("POST /other?pass=1 HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n"
                      "Origin: http://friend.example\r\nContent-Length: 0\r\n\r\n",
                      server_->port()));
  EXPECT_TRUE(post.starts_with("HTTP/1.1 403")) << post;
}

/// Pings of a server are without payload: 0x89 0x00 (RFC 6455, 5.5.2).
constexpr std::string_view kPing("\x89\0", 2);

TEST_F(WebServer, PingsASilentSocketAndThenCutsItOff) {
  // Reads until the other end closes.
  const std::string answer = upgrade("Cookie: key=good\r\n", {});
  EXPECT_NE(answer.find("welcome"), std::string::npos) << answer;
  EXPECT_TRUE(answer.ends_with(kPing));
  handler_.open.wait(1);
  EXPECT_EQ(handler_.open, 0);
}

TEST_F(WebServer, KeepsASocketThatAnswersPings) {
  const int fd = connected();
  const std::string request = upgrading("Cookie: key=good\r\n");
  ASSERT_EQ(::send(fd, request.data(), request.size(), MSG_NOSIGNAL), std::ssize(request));
  // Without its answers it would have been cut off after the first.
  int pings = 0;
  std::string came;
  while (pings < 3) {
    char buffer[4096];
    const ssize_t got = ::recv(fd, buffer, sizeof buffer, 0);
    ASSERT_GT(got, 0) << "after " << pings << " pings";
    came.append(buffer, static_cast<std::size_t>(got));
    if (!came.ends_with(kPing)) continue;
    ++pings;
    came.clear();
    // A pong of a client has a mask.
    ASSERT_EQ(::send(fd, "\x8a\x80\0\0\0\0", 6, MSG_NOSIGNAL), 6);
  }
  EXPECT_EQ(handler_.open, 1);
  ::close(fd);
}

TEST_F(WebServer, EndsWithConnectionsThatSayNothing) {
  const int silent = connected();
  server_->stop();
  char byte = 0;
  EXPECT_LE(::recv(silent, &byte, 1, 0), 0);
  ::close(silent);
}

TEST(WebServerStart, WithoutAThreadIsAnErrorAndThePortIsFreeAgain) {
  Echo handler;
  ServerOptions options;
  {
    const auto first = Server::start({}, handler);
    ASSERT_TRUE(first);
    options.port = (*first)->port();
  }
  {
    const base_testing::NoThreads none;
    const auto refused = Server::start(options, handler);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("cannot start the thread of the web server"),
              std::string::npos)
        << refused.error().text();
  }
  const auto next = Server::start(options, handler);
  ASSERT_TRUE(next) << next.error().text();
}

TEST(WebServerStart, TakesTheNextPortWhereOneIsTaken) {
  Echo handler;
  const auto first = Server::start({}, handler);
  ASSERT_TRUE(first);
  ServerOptions options;
  options.port = (*first)->port();
  const auto refused = Server::start(options, handler);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("cannot listen on 127.0.0.1"), std::string::npos);
  options.ports_to_try = 20;
  const auto next = Server::start(options, handler);
  ASSERT_TRUE(next) << next.error().text();
  EXPECT_NE((*next)->port(), (*first)->port());
}

}  // namespace
}  // namespace rave::web
