// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <string>

namespace peer {

/// The device's end of a line: a pseudo-terminal behind a link of a fixed name, or a TCP port.
/// One host at a time. Bytes may be given a time before which they do not leave.
class Wire {
 public:
  /// `port` 0 with a link: a pseudo-terminal. Otherwise TCP on the loopback.
  Wire(std::string link, int port, bool tcp);
  ~Wire();
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  /// The cable is pulled out: hosts see the line end, and cannot open it.
  void vanish();
  /// The cable is put in again.
  void come_back();
  [[nodiscard]] bool there() const { return listener_ >= 0 || line_ >= 0; }
  /// The path or port that hosts connect to.
  [[nodiscard]] std::string name() const;

  void send(const std::string& bytes, std::int64_t not_before_ns);
  /// When the next byte may leave; a large number if none waits.
  [[nodiscard]] std::int64_t due_ns() const;
  /// Waits at most until `until_ns` for something to read here or on `other_fd`, sends what is due
  /// and returns what has come.
  [[nodiscard]] std::string exchange(std::int64_t until_ns, int other_fd);
  /// Throws away what has not left.
  void flush() { waiting_.clear(); }

 private:
  struct Piece {
    std::int64_t not_before_ns = 0;
    std::string bytes;
  };

  void open_terminal();
  void listen_on_port();
  void accept_host();
  void drop_line();
  void push_out();

  std::string link_;
  int port_;
  bool tcp_;
  int line_ = -1;      // the terminal's own end, or the connection
  int slave_ = -1;     // kept open, or the terminal would end with each host
  int listener_ = -1;  // TCP only
  std::deque<Piece> waiting_;
};

}  // namespace peer
