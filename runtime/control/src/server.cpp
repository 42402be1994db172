// SPDX-License-Identifier: Apache-2.0
#include "rave/control/server.hpp"

#include <poll.h>
#include <sys/stat.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "answering.hpp"
#include "rave/base/bell.hpp"
#include "rave/base/thread.hpp"
#include "rave/control/folder.hpp"
#include "rave/control/protocol.hpp"
#include "rave/process/unix_socket.hpp"

namespace rave::control {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxConnections = 32;

/// Whether the peer runs as this user or as root.
bool is_own(int file) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (::getsockopt(file, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return false;
  return peer.uid == ::geteuid() || peer.uid == 0;
}

Answer answer_line(runtime::RunControl& control, std::string_view line) {
  const auto request = parse_request(line);
  if (!request) return {false, request.error().message, {}};
  if (auto answer = answer_at_once(control, *request)) return *std::move(answer);
  return answer_of(control.ask(request->run));
}

}  // namespace

struct Server::Impl {
  struct Connection {
    Descriptor file;
    std::string received;
  };

  void run();
  void accept_one();
  /// False if the connection must be closed.
  bool read_some(Connection& connection);
  bool send(const Connection& connection, std::string_view text) const;

  runtime::RunControl* control = nullptr;
  fs::path path;
  Descriptor listener;
  Bell wake;
  std::vector<Connection> connections;
  std::thread thread;
};

void Server::Impl::accept_one() {
  Descriptor file(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC));
  if (file.get() < 0 || !is_own(file.get())) return;
  // The oldest connection has had the most time to send its request.
  if (connections.size() >= kMaxConnections) connections.erase(connections.begin());
  connections.push_back({std::move(file), {}});
}

bool Server::Impl::send(const Connection& connection, std::string_view text) const {
  // A peer that does not read must not delay the others for long.
  const timeval patience{1, 0};
  ::setsockopt(connection.file.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  return process::send_all(connection.file.get(), text);
}

bool Server::Impl::read_some(Connection& connection) {
  char part[4096];
  const ssize_t size = ::recv(connection.file.get(), part, sizeof part, MSG_DONTWAIT);
  if (size < 0) return errno == EAGAIN || errno == EINTR;
  if (size == 0) return false;
  connection.received.append(part, static_cast<std::size_t>(size));
  for (std::size_t end = connection.received.find('\n'); end != std::string::npos;
       end = connection.received.find('\n')) {
    const Answer answer = answer_line(*control, {connection.received.data(), end});
    connection.received.erase(0, end + 1);
    if (!send(connection, write_answer(answer))) return false;
  }
  if (connection.received.size() <= kMaxLineBytes) return true;
  // The end of this line is unknown, so no later line can be read: close the connection after
  // giving the reason.
  static_cast<void>(send(connection, write_answer({false, too_long_text(), {}})));
  return false;
}

void Server::Impl::run() {
  std::vector<pollfd> watched;
  for (;;) {
    watched.assign({{wake.descriptor(), POLLIN, 0}, {listener.get(), POLLIN, 0}});
    for (const Connection& connection : connections) {
      watched.push_back({connection.file.get(), POLLIN, 0});
    }
    if (::poll(watched.data(), watched.size(), -1) < 0) continue;
    if (watched[0].revents != 0) return;
    for (std::size_t i = connections.size(); i-- > 0;) {
      if (watched[i + 2].revents == 0 || read_some(connections[i])) continue;
      connections.erase(connections.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (watched[1].revents != 0) accept_one();
  }
}

Result<std::unique_ptr<Server>> Server::start(const std::string& run,
                                              runtime::RunControl& control) {
  static_cast<void>(running_runs());  // Removes the sockets of runs that have died.
  RAVE_TRY_ASSIGN(const fs::path folder, socket_folder());
  auto impl = std::make_unique<Impl>();
  impl->control = &control;
  impl->path = folder / (run + ".sock");
  // Renamed to its final name only once it listens, else it would be taken for the socket of a dead
  // run.
  const fs::path made = folder / (run + ".new");
  RAVE_TRY_ASSIGN(const sockaddr_un address, process::address_of(made));
  RAVE_TRY(process::address_of(impl->path));
  impl->listener = Descriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  std::error_code ignored;
  fs::remove(made, ignored);
  if (impl->wake.descriptor() < 0 || impl->listener.get() < 0 ||
      ::bind(impl->listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) !=
          0 ||
      ::chmod(made.c_str(), 0600) != 0 || ::listen(impl->listener.get(), 16) != 0 ||
      ::rename(made.c_str(), impl->path.c_str()) != 0) {
    const int error = errno;
    fs::remove(made, ignored);
    return fail(ErrorCode::kIo, "cannot open the socket `{}`: {}", impl->path.string(),
                std::strerror(error));
  }
  if (auto started = start_thread(impl->thread, "requests of other terminals",
                                  [raw = impl.get()] { raw->run(); });
      !started) {
    fs::remove(impl->path, ignored);
    return tl::unexpected(started.error());
  }
  return std::unique_ptr<Server>(new Server(std::move(impl)));
}

Server::Server(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Server::~Server() {
  std::error_code ignored;
  fs::remove(impl_->path, ignored);
  impl_->wake.ring();
  impl_->thread.join();
}

}  // namespace rave::control
