// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "child_process.hpp"
#include "deadline.hpp"
#include "message.hpp"
#include "rave/base/descriptor.hpp"
#include "rave/base/result.hpp"
#include "rave/robot/interface.hpp"

namespace rave::isolation {

/// The host's side of the connection to one child. The first failure ends the child and is kept.
class Link {
 public:
  /// `who` begins each error message, such as "program `wander` of robot `anna`". `last_word_s` is
  /// the time that a late child has to report its source line.
  Link(std::string who, HostServices host, ChildProcess child, Descriptor socket,
       double last_word_s);
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  ~Link();

  /// The first failure, if there was one.
  [[nodiscard]] const Status& state() const noexcept { return state_; }
  [[nodiscard]] int process_id() const noexcept { return child_.id(); }

  /// Wakes the child to compute `decision`.
  Status ask(std::uint32_t decision);
  /// Sends a message that the child answers.
  Status tell(MessageKind kind, std::string_view text);
  /// The reason why the program refused the last message; empty if it did not.
  [[nodiscard]] std::string take_refusal() { return std::exchange(refusal_, {}); }
  /// Waits for `kind` with `number` and passes on log lines meanwhile. `late` describes what the
  /// child failed to do in time, such as "has not decided for 1.0 s".
  Status await(MessageKind kind, std::uint32_t number, const Deadline& deadline,
               std::string_view late);

 private:
  enum class Receipt { kMessage, kNothing, kClosed, kGarbage };
  Receipt receive(int timeout_ms, Message& message);
  /// Success if `message` is the awaited one; empty to continue waiting.
  std::optional<Status> handle(const Message& message, MessageKind kind, std::uint32_t number);
  Status end_of_conversation();
  Status stuck(std::string_view late);
  Status give_up(ErrorCode code, const std::string& what);
  void report_dropped(std::uint32_t count) const;

  std::string who_;
  HostServices host_;
  ChildProcess child_;
  Descriptor socket_;
  double last_word_s_;
  std::vector<char> buffer_;
  std::string refusal_;
  Status state_;
};

}  // namespace rave::isolation
