// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "rave/base/descriptor.hpp"
#include "rave/base/result.hpp"

namespace rave::process {

/// The address of a Unix socket. Errors: kInvalidArgument (the path has more than 107 bytes). Any
/// thread.
[[nodiscard]] inline Result<sockaddr_un> address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& text = path.native();
  if (text.size() >= sizeof address.sun_path) {
    return fail(ErrorCode::kInvalidArgument, "the path `{}` is too long for a socket", text);
  }
  std::memcpy(address.sun_path, text.c_str(), text.size() + 1);
  return address;
}

/// Connects to the socket at `path`, and waits while it takes no more connections. Errors:
/// kNotFound (no process listens there), kInvalidArgument (the path is too long), kIo. Any thread.
[[nodiscard]] inline Result<Descriptor> connect_to(const std::filesystem::path& path) {
  RAVE_TRY_ASSIGN(const sockaddr_un address, address_of(path));
  Descriptor file(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (file.get() < 0) return fail(ErrorCode::kIo, "no socket: {}", std::strerror(errno));
  if (::connect(file.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const bool gone = errno == ECONNREFUSED || errno == ENOENT;
    return fail(gone ? ErrorCode::kNotFound : ErrorCode::kIo, "cannot reach `{}`: {}",
                path.string(), std::strerror(errno));
  }
  return file;
}

/// Sends a whole text; false, with errno, if the peer does not take it. One thread per socket.
[[nodiscard]] inline bool send_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = ::send(file, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

}  // namespace rave::process
