// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "rave/base/descriptor.hpp"
#include "rave/line/address.hpp"
#include "rave/line/host_clock.hpp"
#include "rave/line/wake.hpp"

namespace rave::line {

/// The result of waiting for bytes.
enum class ReadEnd {
  kBytes,    ///< `size` bytes were read.
  kTimeout,  ///< Nothing arrived within the limit.
  kWoken,    ///< The bell rang.
  kLost,     ///< The line is lost; see lost().
};

/// How a wait ended, and how many bytes it read.
struct ReadResult {
  ReadEnd end = ReadEnd::kTimeout;
  std::size_t size = 0;
};

/// An open stream of bytes to a device: a serial line (raw, 8 data bits, no parity, one stop bit,
/// no flow control) or a TCP connection. Owns its descriptor. For one thread at a time.
class ByteLine {
 public:
  /// Opens the line and clears the buffers of a serial line. Waits at most `limit` for a TCP
  /// server, or until `wake` rings (null: none). Errors: kNotFound (no such device or host), kIo,
  /// kTimeout, kState (woken).
  [[nodiscard]] static Result<ByteLine> open(const Address& address, Wait limit, const Wake* wake);

  /// Reads available bytes; waits at most `limit` for the first.
  [[nodiscard]] ReadResult read(std::span<char> room, Wait limit, const Wake* wake) noexcept;
  /// Sends all bytes. Errors: kIo (lost), kTimeout (the device does not accept them), kState
  /// (woken).
  [[nodiscard]] Status write(std::string_view bytes, Wait limit, const Wake* wake);
  /// Why the line was lost; empty if it is open.
  [[nodiscard]] const std::string& lost() const noexcept { return lost_; }

 private:
  explicit ByteLine(int fd) : fd_(fd) {}
  ReadResult lose(std::string why) noexcept;

  Descriptor fd_;
  std::string lost_;
};

namespace detail {
/// Waits for one of `events` on `fd`: 1, or 0 after the limit, or -1 when woken.
[[nodiscard]] int wait_ready(int fd, short events, HostTime end, const Wake* wake) noexcept;
[[nodiscard]] Result<int> open_serial(const Address& address);
[[nodiscard]] Result<int> open_tcp(const Address& address, Wait limit, const Wake* wake);
}  // namespace detail

}  // namespace rave::line
