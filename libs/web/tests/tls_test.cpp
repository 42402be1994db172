// SPDX-License-Identifier: Apache-2.0
// Real TLS over real sockets, checked as a browser does it.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "rave/keys/web_keys.hpp"
#include "rave/web/server.hpp"

namespace rave::web {
namespace {

namespace fs = std::filesystem;

class Hello final : public Handler {
 public:
  Response serve(const Request& request) override {
    return text_response(200, "path " + request.path + "\n");
  }
  Admission admit(const Request& /*request*/) override { return {}; }
  void opened(std::uint64_t, Socket& socket, const Request&) override {
    socket.send_text(std::make_shared<const std::string>(std::string(100'000, 'w') + "whole"));
  }
  void received(std::uint64_t, std::string_view) override { ++messages; }
  void closed(std::uint64_t) override {}

  std::atomic<int> messages = 0;
};

std::int64_t now_s() {
  return std::chrono::duration_cast<std::chrono::seconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

class WebTls : public testing::Test {
 protected:
  void SetUp() override {
    // libssl writes without MSG_NOSIGNAL.
    std::signal(SIGPIPE, SIG_IGN);
    std::string name = fs::temp_directory_path() / "rave-tls-XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    ASSERT_TRUE(keys::make_web_keys({folder_ / "web", {"127.0.0.1", "lab.example"}, 10, now_s()}));
    auto started = Server::start(options(), handler_);
    ASSERT_TRUE(started) << started.error().text();
    server_ = *std::move(started);
  }
  void TearDown() override {
    server_.reset();
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  [[nodiscard]] ServerOptions options() const {
    ServerOptions options;
    options.certificate = folder_ / "web/server.pem";
    options.key = folder_ / "web/server_key.pem";
    options.message_burst = 50;
    options.messages_per_s = 1;
    return options;
  }
  [[nodiscard]] std::string error_of(const ServerOptions& options) {
    const auto started = Server::start(options, handler_);
    return started ? "none" : started.error().message;
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
  static void write_to(SSL* tls, const std::string& bytes) {
    EXPECT_EQ(SSL_write(tls, bytes.data(), static_cast<int>(bytes.size())),
              static_cast<int>(bytes.size()));
  }
  static std::string read_from(SSL* tls, std::string_view end) {
    std::string answer;
    char buffer[4096];
    while (end.empty() || answer.find(end) == std::string::npos) {
      const int got = SSL_read(tls, buffer, sizeof buffer);
      if (got <= 0) break;
      answer.append(buffer, static_cast<std::size_t>(got));
    }
    return answer;
  }
  struct Client {
    int most_version = 0;  ///< 0: the newest.
    std::string as = "lab.example";
    std::string then{};  ///< Sent after the first answer.
    std::string_view then_end{};
  };
  /// Sends over TLS and reads until the other end closes, or `end` was read. Empty: no handshake.
  [[nodiscard]] std::string ask(const std::string& bytes, std::string_view end = {}) const {
    return ask(bytes, end, Client{});
  }
  [[nodiscard]] std::string ask(const std::string& bytes, std::string_view end,
                                const Client& client) const {
    const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(
        SSL_CTX_new(TLS_client_method()), SSL_CTX_free);
    SSL_CTX_set_security_level(context.get(), 0);
    if (client.most_version != 0) {
      SSL_CTX_set_max_proto_version(context.get(), client.most_version);
    }
    SSL_CTX_load_verify_file(context.get(), (folder_ / "web/authority.pem").c_str());
    SSL_CTX_set_verify(context.get(), SSL_VERIFY_PEER, nullptr);
    const int fd = connected();
    const std::unique_ptr<SSL, decltype(&SSL_free)> tls(SSL_new(context.get()), SSL_free);
    SSL_set1_host(tls.get(), client.as.c_str());
    SSL_set_fd(tls.get(), fd);
    std::string answer;
    if (SSL_connect(tls.get()) == 1) {
      write_to(tls.get(), bytes);
      answer = read_from(tls.get(), end);
      if (!client.then.empty()) {
        write_to(tls.get(), client.then);
        answer += read_from(tls.get(), client.then_end);
      }
    }
    ERR_clear_error();
    ::close(fd);
    return answer;
  }
  [[nodiscard]] std::string get(const std::string& host) const {
    return ask(fmt::format("GET /a HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n", host));
  }
  [[nodiscard]] std::string upgrade(const std::string& origin) const {
    return fmt::format(
        "GET /ws HTTP/1.1\r\nHost: lab.example:{}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
        "Origin: {}\r\n\r\n",
        server_->port(), origin);
  }

  fs::path folder_;
  Hello handler_;
  std::unique_ptr<Server> server_;
};

TEST_F(WebTls, ServesUnderTheNamesOfItsCertificate) {
  for (const std::string& host :
       {fmt::format("lab.example:{}", server_->port()), std::string("127.0.0.1")}) {
    const std::string answer = get(host);
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
    EXPECT_NE(answer.find("Strict-Transport-Security: max-age="), std::string::npos);
  }
  EXPECT_TRUE(get("evil.example").starts_with("HTTP/1.1 421"));
  EXPECT_EQ(server_->origin(), fmt::format("https://127.0.0.1:{}", server_->port()));
}

TEST_F(WebTls, CarriesWebSocketsOfItsOwnOrigin) {
  const std::string origin = fmt::format("https://lab.example:{}", server_->port());
  const std::string in = ask(upgrade(origin), "whole");
  EXPECT_TRUE(in.starts_with("HTTP/1.1 101")) << in.substr(0, 200);
  EXPECT_NE(in.find("whole"), std::string::npos);
  // The same name without TLS is another origin: anybody on the line can write such a page.
  const std::string plain = fmt::format("http://lab.example:{}", server_->port());
  EXPECT_TRUE(ask(upgrade(plain), "refused").starts_with("HTTP/1.1 403"));
}

TEST_F(WebTls, ClosesWhoSendsTooMuch) {
  // A message of one masked letter; its mask is zero.
  Client client;
  for (int i = 0; i < 200; ++i) client.then += std::string("\x81\x81\0\0\0\0x", 7);
  client.then_end = "too many messages";
  const std::string answer =
      ask(upgrade(fmt::format("https://lab.example:{}", server_->port())), "whole", client);
  EXPECT_NE(answer.find("\x11\x4dtoo many messages"), std::string::npos);
  EXPECT_LE(handler_.messages, 51);
}

TEST_F(WebTls, RefusesOldVersionsWrongNamesAndPlainText) {
  const std::string request = "GET / HTTP/1.1\r\nHost: lab.example\r\nConnection: close\r\n\r\n";
  EXPECT_TRUE(ask(request, {}, Client{TLS1_2_VERSION}).starts_with("HTTP/1.1 200"));
  EXPECT_EQ(ask(request, {}, Client{TLS1_1_VERSION}), "");
  EXPECT_EQ(ask(request, {}, Client{0, "bank.example"}), "");
  const int fd = connected();
  EXPECT_EQ(::send(fd, request.data(), request.size(), MSG_NOSIGNAL), std::ssize(request));
  char buffer[512];
  const ssize_t got = ::recv(fd, buffer, sizeof buffer, 0);
  EXPECT_EQ(std::string(buffer, static_cast<std::size_t>(std::max<ssize_t>(got, 0))).find("HTTP"),
            std::string::npos);
  ::close(fd);
}

TEST_F(WebTls, EndsInTheMiddleOfAHandshake) {
  const int silent = connected();
  server_->stop();
  char byte = 0;
  EXPECT_LE(::recv(silent, &byte, 1, 0), 0);
  ::close(silent);
}

TEST_F(WebTls, SaysWhatIsWrongWithACertificate) {
  ServerOptions wrong = options();
  wrong.key.clear();
  EXPECT_EQ(error_of(wrong), "TLS needs a certificate and its key");
  wrong.key = folder_ / "none.pem";
  EXPECT_NE(error_of(wrong).find("none.pem"), std::string::npos);
  wrong.key = folder_ / "web/authority_key.pem";
  EXPECT_NE(error_of(wrong).find("is not the private key of"), std::string::npos);
  std::ofstream(folder_ / "text.pem") << "not a certificate";
  wrong.certificate = folder_ / "text.pem";
  EXPECT_NE(error_of(wrong).find("text.pem` is not a certificate"), std::string::npos);
  wrong.certificate = folder_ / "web/authority.pem";
  EXPECT_NE(error_of(wrong).find("names no host"), std::string::npos);
  ASSERT_TRUE(keys::make_web_keys({folder_ / "old", {"lab.example"}, 1, now_s() - 9 * 86'400}));
  wrong.certificate = folder_ / "old/server.pem";
  wrong.key = folder_ / "old/server_key.pem";
  EXPECT_NE(error_of(wrong).find("has expired"), std::string::npos);
}

}  // namespace
}  // namespace rave::web
