// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace peer {

/// Commands on the standard input, one a line; each is answered by `ok COMMAND` on the standard
/// output. When the input ends, so does the peer: it never outlives the test that started it.
class Console {
 public:
  Console();
  /// For poll().
  [[nodiscard]] static int fd() { return 0; }
  /// The words of each whole line that has come. Ends the program when the input has ended.
  [[nodiscard]] std::vector<std::vector<std::string>> commands();
  void say(const std::string& line);

 private:
  std::string pending_;
};

/// A log that a test reads while it is written: a line is there before what it tells of is sent.
class Log {
 public:
  /// No file if the path is empty.
  explicit Log(const std::string& path);
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  ~Log();
  void write(const std::string& line);

 private:
  std::FILE* file_ = nullptr;
};

}  // namespace peer
