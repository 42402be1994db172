// SPDX-License-Identifier: Apache-2.0
// A connection with or without TLS behind one type, so that the large templates of Beast are
// compiled once.
#include "stream.hpp"

#include <boost/asio/basic_waitable_timer.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <optional>
#include <utility>

namespace rave::web {

struct Stream::Impl {
  // Beast's stream sends the header and body of a frame in one TLS record.
  using Timer = asio::basic_waitable_timer<std::chrono::steady_clock,
                                           asio::wait_traits<std::chrono::steady_clock>,
                                           TcpSocket::executor_type>;
  using Tls = beast::ssl_stream<TcpSocket>;

  Impl(TcpSocket from, asio::ssl::context* context) : timer(from.get_executor()) {
    if (context == nullptr) {
      plain.emplace(std::move(from));
    } else {
      tls.emplace(std::move(from), *context);
    }
  }
  [[nodiscard]] TcpSocket& socket() { return tls ? tls->next_layer() : *plain; }
  void close() noexcept {
    Error ignored;
    timer.cancel(ignored);
    socket().close(ignored);
  }

  std::optional<TcpSocket> plain;
  std::optional<Tls> tls;
  Timer timer;
  bool heard = false;
};

Stream::Stream(TcpSocket socket, asio::ssl::context* tls)
    : impl_(std::make_shared<Impl>(std::move(socket), tls)) {}

Stream::executor_type Stream::get_executor() { return impl_->socket().get_executor(); }

void Stream::handshake(std::function<void(Error)> done) {
  if (!impl_->tls) {
    done({});
    return;
  }
  impl_->tls->async_handshake(asio::ssl::stream_base::server,
                              [impl = impl_, done = std::move(done)](Error error) { done(error); });
}

void Stream::expires_after(std::chrono::steady_clock::duration time) {
  impl_->timer.expires_after(time);
  // Weak: a timer alone must not keep a connection.
  impl_->timer.async_wait([weak = std::weak_ptr(impl_)](Error error) {
    if (error) return;
    if (const auto impl = weak.lock()) impl->close();
  });
}

void Stream::expires_never() {
  Error ignored;
  impl_->timer.cancel(ignored);
}

bool Stream::take_heard() noexcept { return std::exchange(impl_->heard, false); }

void Stream::finish(std::function<void()> done) {
  const auto end = [impl = impl_, done = std::move(done)] {
    Error ignored;
    impl->socket().shutdown(TcpSocket::shutdown_send, ignored);
    done();
  };
  if (!impl_->tls || !impl_->socket().is_open()) {
    asio::post(get_executor(), end);
    return;
  }
  // The other side has to answer the end of TLS, and may not.
  expires_after(std::chrono::seconds(2));
  impl_->tls->async_shutdown([end](Error /*error*/) { end(); });
}

void Stream::close() noexcept { impl_->close(); }

void Stream::set_send_buffer(int bytes) {
  Error ignored;
  impl_->socket().set_option(asio::socket_base::send_buffer_size(bytes), ignored);
  // Small frames go out at once instead of waiting for the answer to the last one (Nagle).
  impl_->socket().set_option(Tcp::no_delay(true), ignored);
}

void Stream::read_some(const Buffers<asio::mutable_buffer>& buffers, std::unique_ptr<Done> done) {
  auto kept = [impl = impl_, done = std::move(done)](Error error, std::size_t size) {
    impl->heard = impl->heard || size > 0;
    done->call(error, size);
  };
  if (impl_->tls) {
    impl_->tls->async_read_some(buffers, std::move(kept));
  } else {
    impl_->plain->async_read_some(buffers, std::move(kept));
  }
}

void Stream::write_some(const Buffers<asio::const_buffer>& buffers, std::unique_ptr<Done> done) {
  auto kept = [impl = impl_, done = std::move(done)](Error error, std::size_t size) {
    done->call(error, size);
  };
  if (impl_->tls) {
    impl_->tls->async_write_some(buffers, std::move(kept));
  } else {
    impl_->plain->async_write_some(buffers, std::move(kept));
  }
}

}  // namespace rave::web
