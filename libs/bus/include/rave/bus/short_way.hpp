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

#include "rave/bus/run_id.hpp"
#include "rave/bus/topics.hpp"

/// The short way of small samples between processes of one machine: datagrams from socket to
/// socket, beside DDS. For topics whose readers cope with loss, repetition and overtaking. Thread
/// of all of it: that of the bus.
namespace rave::bus {

/// Longer samples are left to DDS.
inline constexpr std::size_t kMostShortBytes = 60'000;
/// In front of the sample: a word, the version, the topic.
inline constexpr std::size_t kShortHeaderBytes = 8;

/// A socket's address in the machine's names that are no files; they belong to a network namespace,
/// as loopback does. A value.
struct ShortAddress {
  sockaddr_un name{};
  socklen_t size = 0;

  ShortAddress() = default;
  /// `topic` 0: the socket that a process sends from.
  ShortAddress(const RunId& run, std::uint64_t writer, std::uint8_t topic);
  [[nodiscard]] bool operator==(const ShortAddress& other) const noexcept;
};

/// A socket that never waits. Owner of its descriptor.
class ShortSocket {
 public:
  /// None if the system gives none, or somebody has the address.
  [[nodiscard]] static std::optional<ShortSocket> open(const ShortAddress& address);
  ShortSocket(ShortSocket&& other) noexcept;
  ShortSocket& operator=(ShortSocket&&) = delete;
  ~ShortSocket();
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

 private:
  explicit ShortSocket(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

/// Makes samples of datagrams. Their memory is kept from one to the next.
class ShortDecoder {
 public:
  explicit ShortDecoder(const TopicSpec& topic);
  ShortDecoder(const ShortDecoder&) = delete;
  ShortDecoder& operator=(const ShortDecoder&) = delete;
  ~ShortDecoder();

  /// The sample, until the next call; null if the bytes are none of this topic. They are aligned to
  /// 8 and written to.
  [[nodiscard]] const void* decode(std::span<std::byte> datagram);

 private:
  const dds_topic_descriptor_t* type_;
  std::uint8_t topic_;
  void* sample_;
};

/// Sends the samples of one writer.
class ShortSender {
 public:
  ShortSender(const TopicSpec& topic, const RunId& run, int socket);
  ShortSender(const ShortSender&) = delete;
  ShortSender& operator=(const ShortSender&) = delete;
  ~ShortSender();

  /// The processes of the readers at the other end, by writer id; 0: no process of this run.
  void meet(std::vector<std::uint64_t> writers);
  /// How many these are.
  [[nodiscard]] std::size_t readers() const noexcept { return writers_.size(); }
  /// Whether it is time to count the readers again. That costs as much as sending, so it is done
  /// each 5 to 10 ms: who comes meanwhile and is to have something asks for it later than that.
  [[nodiscard]] bool due() const noexcept;
  /// They have been counted, and are those of meet().
  void counted() noexcept;
  /// Whether all of them got the sample. If not, it is for DDS; some may have got it.
  [[nodiscard]] bool send(const void* sample);

 private:
  [[nodiscard]] std::span<const unsigned char> encode(const void* sample);

  const dds_topic_descriptor_t* type_;
  std::uint8_t topic_;
  RunId run_;
  int socket_;
  std::vector<std::uint64_t> writers_;
  std::vector<ShortAddress> addresses_;
  bool near_ = false;  ///< All are processes of this machine, as far as is known.
  std::int64_t counted_ms_ = INT64_MIN / 2;
  unsigned not_tried_ = 0;
  unsigned char* buffer_ = nullptr;
  std::uint32_t capacity_ = 0;
};

/// Takes the datagrams for one reader, and says when its samples of DDS must be looked at too: that
/// costs as much as all of the short way.
class ShortReceiver {
 public:
  ShortReceiver(const TopicSpec& topic, const RunId& run, ShortSocket socket);

  /// The processes of the writers at the other end, by writer id; 0: no process of this run.
  void meet(const std::vector<std::uint64_t>& writers);
  [[nodiscard]] int descriptor() const noexcept { return socket_.descriptor(); }

  /// Whether there is a datagram, which then has ended a wait. It is held for receive(): to ask
  /// the system for it costs less than to ask whether there is one.
  [[nodiscard]] bool fetch() noexcept;
  /// There may be something in DDS.
  void note_dds() noexcept { look_ = true; }
  /// How many datagrams the take that begins may look at, at most as many as told: one, if a wait
  /// was ended by it and there is one who sends. To see that there is no other would cost as much
  /// as this one, and the next wait sees it anyway.
  [[nodiscard]] std::size_t begin_take(std::size_t most) noexcept;
  /// Whether that take need not look at DDS; `got`: it has got a sample by the short way. Only
  /// after a wait that was ended by this sample and found nothing in DDS: the next one finds it.
  [[nodiscard]] bool leaves_dds(bool got) noexcept;
  /// Once in a take: whether it may look who the writers are. Strangers make no more work.
  [[nodiscard]] bool may_meet() noexcept { return std::exchange(may_meet_, false); }

  struct Datagram {
    std::span<std::byte> bytes;
    std::uint64_t writer = 0;  ///< Who sent it; 0: none of the writers at the other end.
  };
  /// The next one, until the next receive() or fetch(); none if there is none.
  [[nodiscard]] std::optional<Datagram> receive();
  /// Who sent the last one, when that is asked again after meet().
  [[nodiscard]] std::uint64_t sender() const;
  [[nodiscard]] ShortDecoder& decoder() noexcept { return decoder_; }

 private:
  struct Known {
    std::uint64_t writer;
    ShortAddress address;
  };
  /// Its size; none if there is none.
  [[nodiscard]] std::optional<std::size_t> read() noexcept;

  RunId run_;
  ShortSocket socket_;
  ShortDecoder decoder_;
  std::vector<std::uint64_t> writers_;
  std::vector<Known> known_;
  std::vector<Known> leaving_;  ///< No longer at the other end, until the queue has been empty.
  ShortAddress from_;
  std::unique_ptr<std::uint64_t[]> buffer_;
  std::optional<std::size_t> held_;  ///< Bytes of what is in the buffer and was not received yet.
  bool woken_ = false;               ///< Since the last take.
  bool after_wait_ = false;          ///< The take that goes on is the first after such a wait.
  bool look_ = false;
  bool may_meet_ = true;
};

}  // namespace rave::bus
