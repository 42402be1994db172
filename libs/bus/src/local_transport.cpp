// SPDX-License-Identifier: Apache-2.0
// Datagrams of Unix sockets for the two small messages of lock-step. DDS does discovery and carries
// what is large, remote or refused here. See docs/explanation/local-transport.md.
#include "rave/bus/local_transport.hpp"

#include <dds/ddsi/ddsi_cdrstream.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

namespace rave::bus {
namespace {

/// First bytes of each datagram; the last is the version of the layout.
constexpr std::array<unsigned char, 7> kMark = {'r', 'a', 'v', 'e', 's', 'w', 1};
constexpr std::uint32_t kXcdr1 = 1;
/// After a sample that was too large, or for which some readers had no room, this many samples are
/// sent by DDS at once: the next ones would probably fail too.
constexpr unsigned kNotTried = 63;
/// Larger than the longest sample, to detect longer ones.
constexpr std::size_t kBufferBytes = kMostLocalBytes + sizeof(std::uint64_t);
static_assert(kMostLocalBytes % sizeof(std::uint64_t) == 0 &&
              kMark.size() + 1 == kLocalHeaderBytes);
/// Lock-step repeats a request after 20 ms at the earliest.
constexpr std::int64_t kCountAfter_ms = 5;

/// The cheapest clock; its resolution is 1 to 10 ms.
std::int64_t coarse_ms() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
  return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
}

}  // namespace

// A name in the abstract namespace of Linux: no file is left behind, and the kernel refuses a
// second process that wants the same address. It is derived from run, process and topic, so nothing
// has to be exchanged.
LocalAddress::LocalAddress(const RunId& run, std::uint64_t writer, std::uint8_t topic) {
  name.sun_family = AF_UNIX;
  // The first byte is 0: the abstract namespace.
  const auto end = fmt::format_to_n(name.sun_path + 1, sizeof name.sun_path - 1,
                                    "rave/{}/{:016x}/{}", run.text(), writer, topic);
  size = static_cast<socklen_t>(end.out - reinterpret_cast<char*>(&name));
}

bool LocalAddress::operator==(const LocalAddress& other) const noexcept {
  return size == other.size && std::memcmp(&name, &other.name, size) == 0;
}

std::optional<LocalSocket> LocalSocket::open(const LocalAddress& address) {
  // Non-blocking: a reader that is slow must never stop the sender.
  const int descriptor = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return std::nullopt;
  LocalSocket socket(descriptor);
  // Unread datagrams count against the sender's buffer; the system may grant less.
  constexpr int kRoom = 4 << 20;
  static_cast<void>(::setsockopt(descriptor, SOL_SOCKET, SO_SNDBUF, &kRoom, sizeof kRoom));
  if (::bind(descriptor, reinterpret_cast<const sockaddr*>(&address.name), address.size) != 0) {
    return std::nullopt;
  }
  return socket;
}

LocalDecoder::LocalDecoder(const TopicSpec& topic)
    : type_(topic.type), topic_(topic.local_transport), sample_(dds_alloc(topic.type->m_size)) {
  std::memset(sample_, 0, type_->m_size);
}

LocalDecoder::~LocalDecoder() { dds_sample_free(sample_, type_, DDS_FREE_ALL); }

const void* LocalDecoder::decode(std::span<std::byte> datagram) {
  if (datagram.size() < kLocalHeaderBytes || datagram.size() > kMostLocalBytes) return nullptr;
  // Any process of the machine may send to this address.
  if (std::memcmp(datagram.data(), kMark.data(), kMark.size()) != 0 ||
      datagram[kMark.size()] != std::byte{topic_}) {
    return nullptr;
  }
  const auto cdr = datagram.subspan(kLocalHeaderBytes);
  const auto size = static_cast<std::uint32_t>(cdr.size());
  std::uint32_t end = 0;
  // Like a reader of Cyclone DDS: data that does not match the type is not read.
  if (dds_stream_normalize_data(reinterpret_cast<char*>(cdr.data()), &end, size, false, kXcdr1,
                                type_->m_ops) == nullptr) {
    return nullptr;
  }
  // Do not finish the stream: Cyclone DDS would free memory that it does not own.
  dds_istream_t stream;
  dds_istream_init(&stream, size, cdr.data(), kXcdr1);
  dds_stream_read(&stream, static_cast<char*>(sample_), type_->m_ops);
  return sample_;
}

LocalSender::LocalSender(const TopicSpec& topic, const RunId& run, int socket)
    : type_(topic.type), topic_(topic.local_transport), run_(run), socket_(socket) {}

LocalSender::~LocalSender() { dds_free(buffer_); }

void LocalSender::meet(std::vector<std::uint64_t> writers) {
  if (writers == writers_) return;
  writers_ = std::move(writers);
  addresses_.clear();
  auto sorted = writers_;
  // DDS counts a process that was killed for some time.
  std::erase(sorted, kGoneProcess);
  for (const std::uint64_t writer : sorted) addresses_.emplace_back(run_, writer, topic_);
  std::ranges::sort(sorted);
  // If a process has two readers, only one of them has the socket.
  // An id of 0 is a reader that did not announce its process: it has no socket.
  near_ =
      !sorted.empty() && sorted.front() != 0 && std::ranges::adjacent_find(sorted) == sorted.end();
}

bool LocalSender::due() const noexcept { return coarse_ms() - counted_ms_ >= kCountAfter_ms; }

void LocalSender::counted() noexcept { counted_ms_ = coarse_ms(); }

std::span<const unsigned char> LocalSender::encode(const void* sample) {
  dds_ostream_t stream;
  if (buffer_ == nullptr) {
    dds_ostream_init(&stream, 1024, kXcdr1);
  } else {
    // The buffer of the last sample is used again; Cyclone DDS makes it longer where needed.
    stream = {buffer_, capacity_, 0, kXcdr1};
  }
  std::ranges::copy(kMark, stream.m_buffer);
  stream.m_buffer[kMark.size()] = topic_;
  // The header length is a multiple of the strictest alignment.
  stream.m_index = kLocalHeaderBytes;
  const bool good = dds_stream_write(&stream, static_cast<const char*>(sample), type_->m_ops);
  // Cyclone DDS has freed the buffer on failure.
  buffer_ = good ? stream.m_buffer : nullptr;
  capacity_ = good ? stream.m_size : 0;
  if (!good) return {};
  return {buffer_, stream.m_index};
}

bool LocalSender::send(const void* sample) {
  if (!near_) return false;
  if (not_tried_ > 0) {
    --not_tried_;
    return false;
  }
  const auto bytes = encode(sample);
  if (bytes.empty()) return false;
  if (bytes.size() > kMostLocalBytes) {
    not_tried_ = kNotTried;
    return false;
  }
  // All or none: if one reader cannot be reached, DDS sends to all of them, and those who have the
  // datagram get the sample twice. Messages of lock-step have step numbers, so that does no harm.
  for (const LocalAddress& to : addresses_) {
    if (::sendto(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                 reinterpret_cast<const sockaddr*>(&to.name), to.size) >= 0) {
      continue;
    }
    const bool no_room = errno == EAGAIN || errno == ENOBUFS;
    if (errno == EMSGSIZE || (no_room && addresses_.size() > 1)) {
      not_tried_ = kNotTried;
    } else if (!no_room && errno != EINTR) {
      near_ = false;  // on another machine, or gone
    }
    return false;
  }
  return true;
}

LocalReceiver::LocalReceiver(const TopicSpec& topic, const RunId& run, LocalSocket socket)
    : run_(run),
      socket_(std::move(socket)),
      decoder_(topic),
      buffer_(std::make_unique<std::uint64_t[]>(kBufferBytes / sizeof(std::uint64_t))) {}

void LocalReceiver::meet(const std::vector<std::uint64_t>& writers) {
  if (writers == writers_) return;
  writers_ = writers;
  std::vector<Known> known;
  for (const std::uint64_t writer : writers_) {
    if (writer != 0 && writer != kGoneProcess)
      known.push_back({writer, LocalAddress(run_, writer, 0)});
  }
  // Last datagrams of a writer that left may still be queued, and count as with DDS.
  leaving_.clear();
  for (const Known& before : known_) {
    if (std::ranges::find(known, before.writer, &Known::writer) == known.end()) {
      leaving_.push_back(before);
    }
  }
  known_ = std::move(known);
}

// After waiting for one writer there is most likely one datagram; asking for more would cost a
// system call that only says that there is none.
std::size_t LocalReceiver::begin_take(std::size_t most) noexcept {
  may_meet_ = true;
  after_wait_ = std::exchange(woken_, false);
  return after_wait_ && writers_.size() <= 1 ? std::min<std::size_t>(most, 1) : most;
}

// Nor is DDS asked in that case: an empty dds_take costs about as much as the datagram.
bool LocalReceiver::leaves_dds(bool got) noexcept {
  if (got && after_wait_ && !look_) return true;
  look_ = false;
  return false;
}

std::optional<std::size_t> LocalReceiver::read() noexcept {
  from_.size = sizeof from_.name;
  const auto got = ::recvfrom(socket_.descriptor(), buffer_.get(), kBufferBytes, MSG_DONTWAIT,
                              reinterpret_cast<sockaddr*>(&from_.name), &from_.size);
  if (got < 0) return std::nullopt;
  return static_cast<std::size_t>(got);
}

bool LocalReceiver::fetch() noexcept {
  if (!held_) held_ = read();
  if (held_) woken_ = true;
  return held_.has_value();
}

std::optional<LocalReceiver::Datagram> LocalReceiver::receive() {
  auto got = std::exchange(held_, std::nullopt);
  if (!got) got = read();
  if (!got) {
    leaving_.clear();
    return std::nullopt;
  }
  return Datagram{{reinterpret_cast<std::byte*>(buffer_.get()), *got}, sender()};
}

std::uint64_t LocalReceiver::sender() const {
  for (const std::vector<Known>* const some : {&known_, &leaving_}) {
    const auto found = std::ranges::find(*some, from_, &Known::address);
    if (found != some->end()) return found->writer;
  }
  return 0;
}

}  // namespace rave::bus
