// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "rave/base/result.hpp"

namespace rave::control {

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int file = -1) noexcept : file_(file) {}
  Descriptor(Descriptor&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
  }
  ~Descriptor() {
    if (file_ >= 0) ::close(file_);
  }
  [[nodiscard]] int get() const noexcept { return file_; }

 private:
  int file_;
};

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

/// A connection to the socket at `path`. Error: kNotFound if nobody listens there, kIo.
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

}  // namespace rave::control
