// SPDX-License-Identifier: Apache-2.0
#include "link.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "describe.hpp"

namespace rave::isolation {
namespace {

/// The time that a child has to end after it was asked to.
constexpr int kEndMs = 500;
/// After its socket has closed, a child is expected to end within this time.
constexpr int kEndAfterCloseMs = 1000;
/// More messages than a child can send in one decision within the limits of message.hpp; the rest
/// is for threads of a program that log between decisions.
constexpr int kMaxMessages = 4096;

ErrorCode error_code(std::uint32_t number) {
  return number <= static_cast<std::uint32_t>(ErrorCode::kState) ? static_cast<ErrorCode>(number)
                                                                 : ErrorCode::kPlugin;
}

}  // namespace

Link::Link(std::string who, HostServices host, ChildProcess child, Descriptor socket,
           double last_word_s)
    : who_(std::move(who)),
      host_(host),
      child_(std::move(child)),
      socket_(std::move(socket)),
      last_word_s_(last_word_s),
      // One byte more than the longest message: a longer one is then recognised by its size instead
      // of being cut to a valid one.
      buffer_(kMaxMessageBytes + 1) {}

Link::~Link() {
  socket_.reset();  // The closed socket asks the child to end.
  if (!child_.wait_for_end(kEndMs)) child_.kill();
}

Status Link::ask(std::uint32_t decision) {
  RAVE_TRY(state_);
  if (!send_message(socket_.get(), {MessageKind::kDecide, decision, 0}, {}, false)) {
    // Messages that the child sent before it ended explain the reason.
    return await(MessageKind::kDecided, decision, Deadline(last_word_s_), "did not read its input");
  }
  return {};
}

Status Link::tell(MessageKind kind, std::string_view text) {
  RAVE_TRY(state_);
  refusal_.clear();
  if (!send_message(socket_.get(), {kind, 0, 0}, text, false)) {
    return await(MessageKind::kUpdated, 0, Deadline(last_word_s_), "did not read its input");
  }
  return {};
}

Link::Receipt Link::receive(int timeout_ms, Message& message) {
  pollfd watch{socket_.get(), POLLIN, 0};
  const int ready = ::poll(&watch, 1, timeout_ms);
  if (ready <= 0) return Receipt::kNothing;  // Also after a signal: the caller repeats the call.
  const ssize_t size = ::recv(socket_.get(), buffer_.data(), buffer_.size(), MSG_DONTWAIT);
  if (size == 0) return Receipt::kClosed;
  if (size < 0) {
    // A connection reset is reported once, before the data that the child had sent.
    return errno == EAGAIN || errno == EINTR || errno == ECONNRESET ? Receipt::kNothing
                                                                    : Receipt::kClosed;
  }
  const auto parsed = parse_message({buffer_.data(), static_cast<std::size_t>(size)});
  if (!parsed) return Receipt::kGarbage;
  message = *parsed;
  return Receipt::kMessage;
}

Status Link::await(MessageKind kind, std::uint32_t number, const Deadline& deadline,
                   std::string_view late) {
  RAVE_TRY(state_);
  // The limit counts messages, not time: a child that sends without end would otherwise keep the
  // host reading until the deadline.
  for (int messages = 0; messages < kMaxMessages;) {
    const int remaining_ms = deadline.remaining_ms();
    Message message;
    switch (receive(remaining_ms, message)) {
      case Receipt::kNothing:
        // The socket is read once more at the deadline, so an answer that is already there counts.
        if (remaining_ms == 0) return stuck(late);
        break;
      case Receipt::kClosed:
        return end_of_conversation();
      case Receipt::kGarbage:
        return give_up(ErrorCode::kPlugin, "sent a malformed message to its host");
      case Receipt::kMessage:
        ++messages;
        if (const auto result = handle(message, kind, number)) return *result;
    }
  }
  return give_up(ErrorCode::kPlugin,
                 fmt::format("sent more than {} messages in one decision", kMaxMessages));
}

std::optional<Status> Link::handle(const Message& message, MessageKind kind, std::uint32_t number) {
  const MessageHead& head = message.head;
  if (head.kind == MessageKind::kLog) {
    if (head.number <= static_cast<std::uint32_t>(LogLevel::kError)) {
      host_.write(static_cast<LogLevel>(head.number), message.text);
    }
    return {};
  }
  if (head.kind == MessageKind::kCrash) {
    const std::string signal =
        head.count != 0 ? "stack overflow" : signal_name(static_cast<int>(head.number));
    return give_up(ErrorCode::kPlugin,
                   fmt::format("crashed: {}{}", signal, at_place(parse_place(message.text))));
  }
  if (head.kind == kind && (kind == MessageKind::kStarted || head.number == number)) {
    report_dropped(head.count);
    return Status{};
  }
  if (head.kind == MessageKind::kUpdateRefused && kind == MessageKind::kUpdated) {
    report_dropped(head.count);
    refusal_ = message.text.empty() ? "it refuses" : std::string(message.text);
    return Status{};
  }
  if (head.kind == MessageKind::kStartFailed && kind == MessageKind::kStarted) {
    report_dropped(head.count);
    return give_up(error_code(head.number), fmt::format("did not start: {}", message.text));
  }
  if (head.kind == MessageKind::kDecideFailed && kind == MessageKind::kDecided) {
    report_dropped(head.count);
    return give_up(ErrorCode::kPlugin, std::string(message.text));
  }
  return give_up(ErrorCode::kPlugin, "sent a message to its host at the wrong time");
}

Status Link::end_of_conversation() {
  // The socket closes before the process has ended; its exit code says more than the closed socket.
  if (child_.wait_for_end(kEndAfterCloseMs)) {
    return give_up(ErrorCode::kPlugin, child_.how());
  }
  return give_up(ErrorCode::kPlugin, "closed its connection to the host");
}

Status Link::stuck(std::string_view late) {
  // The handler in the child finds the source line of the loop and sends it, before the child is
  // killed.
  child_.signal(kWhereSignal);
  const Deadline deadline(last_word_s_);
  int remaining_ms = 0;
  do {
    remaining_ms = deadline.remaining_ms();
    Message message;
    const Receipt receipt = receive(remaining_ms, message);
    if (receipt == Receipt::kClosed || receipt == Receipt::kGarbage) break;
    if (receipt != Receipt::kMessage) continue;
    if (message.head.kind == MessageKind::kCrash) {
      return *handle(message, MessageKind::kCrash, 0);
    }
    if (message.head.kind != MessageKind::kWhere) continue;
    const std::string place = at_place(parse_place(message.text));
    if (place.empty()) break;
    return give_up(ErrorCode::kTimeout, fmt::format("{}; it was{}", late, place));
  } while (remaining_ms > 0);
  return give_up(ErrorCode::kTimeout, std::string(late));
}

Status Link::give_up(ErrorCode code, const std::string& what) {
  // A child that broke the protocol is not spoken to again. The run continues without its robot.
  child_.kill();
  socket_.reset();
  state_ = fail(code, "{} {}", who_, what);
  return state_;
}

void Link::report_dropped(std::uint32_t count) const {
  if (count == 0) return;
  host_.write(LogLevel::kWarning,
              fmt::format("dropped {} surplus log lines of one decision", count));
}

}  // namespace rave::isolation
