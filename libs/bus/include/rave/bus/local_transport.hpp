// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "rave/base/descriptor.hpp"
#include "rave/bus/run_id.hpp"
#include "rave/bus/topics.hpp"

/// The local transport: datagrams between processes of one machine, beside DDS. For small samples
/// of topics whose readers tolerate loss, duplicates and reordering. Thread: that of the bus.
namespace rave::bus {

/// Longer samples use DDS.
inline constexpr std::size_t kMostLocalBytes = 60'000;
/// In front of the sample: a magic word, the version, the topic number.
inline constexpr std::size_t kLocalHeaderBytes = 8;
/// In the place of a writer id: a process that is lost, whose ends DDS still counts.
inline constexpr std::uint64_t kGoneProcess = ~std::uint64_t{0};

/// An address in the abstract Unix namespace (no file). It belongs to a network namespace, as
/// loopback does. A value.
struct LocalAddress {
  sockaddr_un name{};
  socklen_t size = 0;

  LocalAddress() = default;
  /// `topic` 0: the socket that a process sends from.
  LocalAddress(const RunId& run, std::uint64_t writer, std::uint8_t topic);
  [[nodiscard]] bool operator==(const LocalAddress& other) const noexcept;
};

/// A non-blocking Unix datagram socket. Owns its descriptor.
class LocalSocket {
 public:
  /// Empty if the system refuses, or if the address is in use.
  [[nodiscard]] static std::optional<LocalSocket> open(const LocalAddress& address);
  [[nodiscard]] int descriptor() const noexcept { return descriptor_.get(); }

 private:
  explicit LocalSocket(int descriptor) : descriptor_(descriptor) {}
  Descriptor descriptor_;
};

/// Decodes datagrams into samples. Reuses the memory of the sample.
class LocalDecoder {
 public:
  explicit LocalDecoder(const TopicSpec& topic);
  LocalDecoder(const LocalDecoder&) = delete;
  LocalDecoder& operator=(const LocalDecoder&) = delete;
  ~LocalDecoder();

  /// The decoded sample, valid until the next call; null if the bytes are not a sample of this
  /// topic. `datagram` must be aligned to 8 bytes; it is modified.
  [[nodiscard]] const void* decode(std::span<std::byte> datagram);

 private:
  const dds_topic_descriptor_t* type_;
  std::uint8_t topic_;
  void* sample_;
};

/// Sends the samples of one writer by the local transport.
class LocalSender {
 public:
  LocalSender(const TopicSpec& topic, const RunId& run, int socket);
  LocalSender(const LocalSender&) = delete;
  LocalSender& operator=(const LocalSender&) = delete;
  ~LocalSender();

  /// Sets the processes of the matched readers, by writer id; 0: not a process of this run;
  /// kGoneProcess: a lost one, which gets nothing.
  void meet(std::vector<std::uint64_t> writers);
  /// The number of matched readers.
  [[nodiscard]] std::size_t readers() const noexcept { return writers_.size(); }
  /// Whether the readers must be counted again. Counting costs as much as sending, so it is done
  /// every 5 to 10 ms only. A reader that appears in between requests missed samples later than
  /// that.
  [[nodiscard]] bool due() const noexcept;
  /// The readers were counted and are still those of meet().
  void counted() noexcept;
  /// Sends to all readers. Returns false if the sample must (also) go through DDS; some readers may
  /// already have it.
  [[nodiscard]] bool send(const void* sample);

 private:
  [[nodiscard]] std::span<const unsigned char> encode(const void* sample);

  const dds_topic_descriptor_t* type_;
  std::uint8_t topic_;
  RunId run_;
  int socket_;
  std::vector<std::uint64_t> writers_;
  std::vector<LocalAddress> addresses_;
  bool near_ = false;  ///< All readers are on this machine, as far as known.
  std::int64_t counted_ms_ = INT64_MIN / 2;
  unsigned not_tried_ = 0;
  unsigned char* buffer_ = nullptr;
  std::uint32_t capacity_ = 0;
};

/// Receives the datagrams of one reader, and decides when to look at its DDS samples too: that
/// costs as much as the whole local transport.
class LocalReceiver {
 public:
  LocalReceiver(const TopicSpec& topic, const RunId& run, LocalSocket socket);

  /// Sets the processes of the matched writers, by writer id; 0: not a process of this run;
  /// kGoneProcess: a lost one.
  void meet(const std::vector<std::uint64_t>& writers);
  [[nodiscard]] int descriptor() const noexcept { return socket_.descriptor(); }

  /// Reads a datagram ahead if there is one, after a wait. It is kept for receive(): reading costs
  /// less than asking the system whether one is there.
  [[nodiscard]] bool fetch() noexcept;
  /// Notes that DDS may have samples.
  void note_dds() noexcept { look_ = true; }
  /// Begins a take. Returns how many datagrams it may read, at most `most`. It is one if a datagram
  /// ended the wait and there is one sender: a further read that finds nothing would cost as much
  /// as this one, and the next wait notices later datagrams anyway.
  [[nodiscard]] std::size_t begin_take(std::size_t most) noexcept;
  /// Whether this take may leave out the readers of DDS. True only if it received a datagram
  /// (`got`) after a wait that a datagram ended and in which DDS had nothing. The next wait notices
  /// later samples.
  [[nodiscard]] bool leaves_dds(bool got) noexcept;
  /// True once per take: whether the take may look up the writers again. Datagrams of unknown
  /// senders cause no further look-ups.
  [[nodiscard]] bool may_meet() noexcept { return std::exchange(may_meet_, false); }

  struct Datagram {
    std::span<std::byte> bytes;
    std::uint64_t writer = 0;  ///< The sender; 0: none of the matched writers.
  };
  /// The next datagram, valid until the next receive() or fetch(); empty if there is none.
  [[nodiscard]] std::optional<Datagram> receive();
  /// The sender of the last datagram, looked up again, for use after meet().
  [[nodiscard]] std::uint64_t sender() const;
  [[nodiscard]] LocalDecoder& decoder() noexcept { return decoder_; }

 private:
  struct Known {
    std::uint64_t writer;
    LocalAddress address;
  };
  /// Reads a datagram into the buffer; its size, or empty if there is none.
  [[nodiscard]] std::optional<std::size_t> read() noexcept;

  RunId run_;
  LocalSocket socket_;
  LocalDecoder decoder_;
  std::vector<std::uint64_t> writers_;
  std::vector<Known> known_;
  std::vector<Known> leaving_;  ///< No longer matched; still known until the queue was empty once.
  LocalAddress from_;
  std::unique_ptr<std::uint64_t[]> buffer_;
  /// Size of the datagram in the buffer that receive() has not returned yet.
  std::optional<std::size_t> held_;
  bool woken_ = false;       ///< A datagram ended a wait since the last take.
  bool after_wait_ = false;  ///< The current take is the first after such a wait.
  bool look_ = false;
  bool may_meet_ = true;
};

}  // namespace rave::bus
