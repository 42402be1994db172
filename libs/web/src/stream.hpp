// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <boost/asio/async_result.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/core/role.hpp>
#include <chrono>
#include <functional>
#include <memory>

namespace boost::asio::ssl {  // their own name. NOLINT(readability-identifier-naming)
class context;
}

namespace rave::web {

namespace asio = boost::asio;
namespace beast = boost::beast;
using Tcp = asio::ip::tcp;
/// Asio's own socket type would call its executor through a virtual function.
using TcpSocket = asio::basic_stream_socket<Tcp, asio::io_context::executor_type>;
using Error = beast::error_code;

/// The first few buffers of a sequence; the rest is for the next call.
template <class Buffer>
class Buffers {
 public:
  using value_type = Buffer;
  using const_iterator = const Buffer*;

  template <class Sequence>
  explicit Buffers(const Sequence& sequence) {
    const auto end = asio::buffer_sequence_end(sequence);
    for (auto it = asio::buffer_sequence_begin(sequence); it != end && size_ < items_.size();
         ++it) {
      const Buffer buffer(*it);
      if (buffer.size() > 0) items_[size_++] = buffer;
    }
  }
  [[nodiscard]] const_iterator begin() const noexcept { return items_.data(); }
  [[nodiscard]] const_iterator end() const noexcept { return items_.data() + size_; }

 private:
  std::array<Buffer, 8> items_{};
  std::size_t size_ = 0;
};

/// A connection with or without TLS as one type, so that HTTP and WebSockets are compiled once.
/// Used in the thread of its io_context.
class Stream {
 public:
  // Asio requires this name.
  using executor_type = TcpSocket::executor_type;  // NOLINT(readability-identifier-naming)

  /// `tls`: null for a connection without TLS; otherwise it must outlive the stream.
  Stream(TcpSocket socket, asio::ssl::context* tls);
  Stream(Stream&&) noexcept = default;
  Stream& operator=(Stream&&) noexcept = default;
  ~Stream() = default;

  [[nodiscard]] executor_type get_executor();
  /// Must be called first; completes at once without TLS.
  void handshake(std::function<void(Error)> done);
  /// Closes the connection after `time`, unless this or expires_never() is called again.
  void expires_after(std::chrono::steady_clock::duration time);
  void expires_never();
  /// Whether bytes came in since the last call.
  [[nodiscard]] bool take_heard() noexcept;
  /// Ends the outgoing direction, within two seconds.
  void finish(std::function<void()> done);
  void close() noexcept;
  /// Limits the kernel's buffer, so that a slow connection is detected at once.
  void set_send_buffer(int bytes);

  template <class Sequence, class Token>
  auto async_read_some(const Sequence& buffers, Token&& token) {
    return asio::async_initiate<Token, void(Error, std::size_t)>(
        [this](auto handler, const Buffers<asio::mutable_buffer>& some) {
          read_some(some, std::make_unique<DoneOf<decltype(handler)>>(std::move(handler)));
        },
        token, Buffers<asio::mutable_buffer>(buffers));
  }
  template <class Sequence, class Token>
  auto async_write_some(const Sequence& buffers, Token&& token) {
    return asio::async_initiate<Token, void(Error, std::size_t)>(
        [this](auto handler, const Buffers<asio::const_buffer>& some) {
          write_some(some, std::make_unique<DoneOf<decltype(handler)>>(std::move(handler)));
        },
        token, Buffers<asio::const_buffer>(buffers));
  }

 private:
  struct Impl;
  /// The handler of an operation, which may be move-only; called once.
  struct Done {
    Done() = default;
    virtual ~Done() = default;
    Done(const Done&) = delete;
    Done& operator=(const Done&) = delete;
    virtual void call(Error error, std::size_t size) = 0;
  };
  template <class Handler>
  struct DoneOf final : Done {
    explicit DoneOf(Handler from) : handler(std::move(from)) {}
    void call(Error error, std::size_t size) override { std::move(handler)(error, size); }
    Handler handler;
  };
  void read_some(const Buffers<asio::mutable_buffer>& buffers, std::unique_ptr<Done> done);
  void write_some(const Buffers<asio::const_buffer>& buffers, std::unique_ptr<Done> done);

  std::shared_ptr<Impl> impl_;  ///< Shared with pending operations.
};

// The functions that Beast requires of a stream under a WebSocket, found by argument-dependent
// lookup.
inline void teardown(beast::role_type /*role*/, Stream& stream, Error& error) {
  stream.close();
  error = {};
}
template <class Handler>
void async_teardown(beast::role_type /*role*/, Stream& stream, Handler&& handler) {
  auto shared = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));
  stream.finish([shared] { std::move (*shared)(Error()); });
}
inline void beast_close_socket(Stream& stream) { stream.close(); }

}  // namespace rave::web
