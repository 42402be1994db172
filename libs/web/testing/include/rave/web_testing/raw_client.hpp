// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <fmt/format.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace rave::web::testing {

/// A connection that sends any bytes, over TLS if it is given an authority.
class RawClient {
 public:
  RawClient(std::uint16_t port, const std::filesystem::path& authority)
      : context_(nullptr), fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    // libssl writes without MSG_NOSIGNAL.
    std::signal(SIGPIPE, SIG_IGN);
    // So that a test that waits in vain fails.
    const timeval limit{10, 0};
    ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    good_ = ::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    if (!authority.empty()) begin_tls(authority);
  }
  RawClient(RawClient&& other) noexcept
      : context_(std::exchange(other.context_, nullptr)),
        tls_(std::exchange(other.tls_, nullptr)),
        fd_(std::exchange(other.fd_, -1)),
        good_(other.good_) {}
  RawClient& operator=(RawClient&&) = delete;
  ~RawClient() {
    if (tls_ != nullptr) SSL_free(tls_);
    if (context_ != nullptr) SSL_CTX_free(context_);
    if (fd_ >= 0) ::close(fd_);
  }

  [[nodiscard]] bool good() const noexcept { return good_; }
  void send(std::string_view bytes) {
    while (good_ && !bytes.empty()) {
      const auto size = static_cast<int>(bytes.size());
      const int sent =
          tls_ != nullptr ? SSL_write(tls_, bytes.data(), size)
                          : static_cast<int>(::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL));
      good_ = sent > 0;
      if (good_) bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
  }
  /// More bytes into `to`; false: the other end closed, or said nothing for too long.
  bool read(std::string& to) {
    char buffer[16384];
    const int got = tls_ != nullptr ? SSL_read(tls_, buffer, sizeof buffer)
                                    : static_cast<int>(::recv(fd_, buffer, sizeof buffer, 0));
    ERR_clear_error();
    if (got <= 0) return false;
    to.append(buffer, static_cast<std::size_t>(got));
    return true;
  }
  [[nodiscard]] std::string read_all() {
    std::string all;
    while (read(all)) {
    }
    return all;
  }

 private:
  void begin_tls(const std::filesystem::path& authority) {
    context_ = SSL_CTX_new(TLS_client_method());
    SSL_CTX_load_verify_file(context_, authority.c_str());
    SSL_CTX_set_verify(context_, SSL_VERIFY_PEER, nullptr);
    tls_ = SSL_new(context_);
    SSL_set_fd(tls_, fd_);
    good_ = good_ && SSL_connect(tls_) == 1;
  }

  SSL_CTX* context_;
  SSL* tls_ = nullptr;
  int fd_;
  bool good_ = false;
};

/// A WebSocket of a client that can break the rules of the protocol.
class RawSocket {
 public:
  struct Frame {
    int opcode = 0;
    std::string payload;
  };

  RawSocket(std::uint16_t port, const std::filesystem::path& authority, std::string_view headers,
            std::string_view target = "/ws")
      : client_(port, authority) {
    client_.send(
        fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: Upgrade\r\nUpgrade: "
                    "websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
                    "dGhlIHNhbXBsZSBub25jZQ==\r\n{}\r\n",
                    target, port, headers));
    while (buffer_.find("\r\n\r\n") == std::string::npos && client_.read(buffer_)) {
    }
    const std::size_t end = std::min(buffer_.size(), buffer_.find("\r\n\r\n") + 4);
    answer_ = buffer_.substr(0, end);
    buffer_.erase(0, end);
  }
  /// The status line and headers of the server.
  [[nodiscard]] const std::string& answer() const noexcept { return answer_; }
  /// All payloads so far.
  [[nodiscard]] const std::string& heard() const noexcept { return heard_; }

  void send(std::string_view payload, int opcode = 1) {
    std::string frame(1, static_cast<char>(0x80 | opcode));
    // The mask is zero: it leaves the bytes as they are.
    if (payload.size() < 126) {
      frame += static_cast<char>(0x80 | payload.size());
    } else if (payload.size() < 65'536) {
      // A longer form of a length than it needs is no WebSocket.
      frame += static_cast<char>(0x80 | 126);
      frame += static_cast<char>(payload.size() >> 8U);
      frame += static_cast<char>(payload.size());
    } else {
      // The shortest way to write a size is the only one.
      const bool large = payload.size() > 0xffff;
      frame += static_cast<char>(0x80 | (large ? 127 : 126));
      for (int shift = large ? 56 : 8; shift >= 0; shift -= 8) {
        frame += static_cast<char>(payload.size() >> static_cast<unsigned>(shift));
      }
    }
    frame.append(4, '\0');
    client_.send(frame.append(payload));
  }
  /// The next frame; nothing: the connection ended.
  std::optional<Frame> next() {
    while (true) {
      if (auto frame = whole_frame()) return frame;
      if (!client_.read(buffer_)) return std::nullopt;
    }
  }
  /// The code of the close frame that comes sooner or later; 0: none came.
  int close_code() {
    while (const auto frame = next()) {
      if (frame->opcode != 8) continue;
      if (frame->payload.size() < 2) return 0;
      return static_cast<unsigned char>(frame->payload[0]) * 256 +
             static_cast<unsigned char>(frame->payload[1]);
    }
    return 0;
  }
  /// The next text that has this in it; empty: the connection ended.
  std::string text_with(std::string_view what) {
    while (const auto frame = next()) {
      if (frame->opcode == 1 && frame->payload.find(what) != std::string::npos) {
        return frame->payload;
      }
    }
    return {};
  }

 private:
  std::optional<Frame> whole_frame() {
    if (buffer_.size() < 2) return std::nullopt;
    std::size_t size = static_cast<unsigned char>(buffer_[1]) & 0x7fU;
    const std::size_t more = size == 126 ? 2U : (size == 127 ? 8U : 0U);
    if (buffer_.size() < 2 + more) return std::nullopt;
    if (more > 0) size = 0;
    for (std::size_t i = 0; i < more; ++i) {
      size = size * 256 + static_cast<unsigned char>(buffer_[2 + i]);
    }
    if (buffer_.size() < 2 + more + size) return std::nullopt;
    Frame frame{buffer_[0] & 0x0f, buffer_.substr(2 + more, size)};
    buffer_.erase(0, 2 + more + size);
    heard_ += frame.payload;
    if (frame.opcode == 9) send(frame.payload, 10);
    return frame;
  }

  RawClient client_;
  std::string buffer_;
  std::string answer_;
  std::string heard_;
};

}  // namespace rave::web::testing
