// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace rave::isolation {

/// The messages between host and child: one packet each over a SOCK_SEQPACKET pair.
enum class MessageKind : std::uint32_t {
  kDecide = 1,   ///< Host to child; number: the decision. All others except kUpdate go to the host.
  kStarted,      ///< count: dropped log lines, here and in the next three kinds.
  kStartFailed,  ///< number: ErrorCode; text: the reason.
  kDecided,      ///< number: the decision.
  kDecideFailed,   ///< number: the decision; text: the reason.
  kLog,            ///< number: LogLevel, text: the line.
  kCrash,          ///< number: the signal, count: 1 for a stack overflow, text: a Place.
  kWhere,          ///< Answer to kWhereSignal; text: a Place.
  kUpdated,        ///< The program accepted the new parameters.
  kUpdateRefused,  ///< text: the reason.
  kUpdate,         ///< Host to child; text: the result of encode_update().
};

struct MessageHead {
  MessageKind kind{};
  std::uint32_t number = 0;
  std::uint32_t count = 0;
};
static_assert(sizeof(MessageHead) == 12);

struct Message {
  MessageHead head;
  std::string_view text;
};

inline constexpr std::size_t kMaxMessageBytes = 8192;
/// Limits of the log lines of one decision. Their sum is below the default buffer of a socket, so
/// lines are dropped only because of these limits, and a repeated run drops the same lines.
inline constexpr std::size_t kMaxLogLines = 64;
inline constexpr std::size_t kMaxLogLineBytes = 4096;
inline constexpr std::size_t kMaxLogBytes = 65536;

/// File descriptors in the child.
inline constexpr int kChildSocket = 3;
inline constexpr int kChildMemory = 4;

/// Asks a child that does not answer for its source line. The thread sanitizer delivers a signal to
/// a loop without calls only if it takes the signal for a fault of the program itself.
#if defined(__SANITIZE_THREAD__)
inline constexpr int kWhereSignal = 31;  // SIGSYS
#else
inline constexpr int kWhereSignal = 10;  // SIGUSR1
#endif

/// Sends one packet, cutting `text` at the limit. Safe in a signal handler. False if the other
/// side is gone, or with `wait` false if there is no room.
bool send_message(int socket, const MessageHead& head, std::string_view text, bool wait) noexcept;

/// Parses a message from a child; empty if it is none that a child may send. `text` points into
/// `bytes`.
[[nodiscard]] std::optional<Message> parse_message(std::string_view bytes) noexcept;

/// The source position of a program: `file\nline\nfunction\nframe`.
struct Place {
  std::string_view file;      ///< Empty if unknown.
  int line = 0;               ///< 0 if unknown.
  std::string_view function;  ///< As the source or the linker writes it.
  std::string_view frame;     ///< The linker's name of the function that it is inlined in.
};
[[nodiscard]] Place parse_place(std::string_view text) noexcept;

}  // namespace rave::isolation
