// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace rave::isolation {

/// What host and child say to one another: one packet each over a SOCK_SEQPACKET pair.
enum class MessageKind : std::uint32_t {
  kDecide = 1,     ///< Host to child; number: the decision. All but the last go to the host.
  kStarted,        ///< count: log lines that were dropped, here and in the next three.
  kStartFailed,    ///< number: ErrorCode, text: why.
  kDecided,        ///< number: the decision.
  kDecideFailed,   ///< number: the decision, text: why.
  kLog,            ///< number: LogLevel, text: the line.
  kCrash,          ///< number: the signal, count: 1 for a stack overflow, text: a Place.
  kWhere,          ///< Answer to kWhereSignal; text: a Place.
  kUpdated,        ///< New parameters were taken.
  kUpdateRefused,  ///< text: why.
  kUpdate,         ///< Host to child; text: what encode_update() gave.
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
/// Bounds of the log lines of one decision. Their sum stays below what a socket buffers by
/// default, so a line is dropped for their sake only and a run drops the same lines each time.
inline constexpr std::size_t kMaxLogLines = 64;
inline constexpr std::size_t kMaxLogLineBytes = 4096;
inline constexpr std::size_t kMaxLogBytes = 65536;

/// File descriptors of the child.
inline constexpr int kChildSocket = 3;
inline constexpr int kChildMemory = 4;

/// Asks a child that does not answer where it is. The thread sanitizer delivers only what it
/// takes for the program's own fault to a loop that calls nothing.
#if defined(__SANITIZE_THREAD__)
inline constexpr int kWhereSignal = 31;  // SIGSYS
#else
inline constexpr int kWhereSignal = 10;  // SIGUSR1
#endif

/// Sends one packet, cutting `text` at the limit. Safe in a signal handler. False if the other
/// side is gone, or with `wait` false if there is no room.
bool send_message(int socket, const MessageHead& head, std::string_view text, bool wait) noexcept;

/// Reads what a child sent; nothing if it is not a message that a child sends. `text` points into
/// `bytes`.
[[nodiscard]] std::optional<Message> parse_message(std::string_view bytes) noexcept;

/// Where in the source a program was: `file\nline\nfunction\nframe`.
struct Place {
  std::string_view file;      ///< Empty: not known.
  int line = 0;               ///< 0: not known.
  std::string_view function;  ///< As the source or the linker writes it.
  std::string_view frame;     ///< The linker's name of the function that it is inlined in.
};
[[nodiscard]] Place parse_place(std::string_view text) noexcept;

}  // namespace rave::isolation
