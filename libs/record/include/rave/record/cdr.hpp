// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rave::record {

static_assert(std::endian::native == std::endian::little, "CDR is written little-endian");

template <class T>
concept CdrPrimitive = std::is_arithmetic_v<T>;

/// Writes the classic CDR encoding (OMG CORBA 3.0, 15.3; plain CDR of DDS-XTypes 1.3, 7.4.1),
/// little-endian with a four-byte encapsulation header, as in ROS 2 messages. A primitive is
/// aligned to its size, counted from behind the header; a string is its length including the final
/// zero, then the bytes; a sequence is its count, then the elements.
class CdrWriter {
 public:
  CdrWriter() { clear(); }

  /// Starts a new message; keeps the allocated memory.
  void clear() {
    bytes_.clear();
    bytes_.insert(bytes_.end(), {std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}});
  }
  template <CdrPrimitive T>
  void put(T value) {
    align(sizeof value);
    append(&value, sizeof value);
  }
  void put_string(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    append(text.data(), text.size());
    bytes_.push_back(std::byte{0});
  }
  void put_count(std::size_t count) { put(static_cast<std::uint32_t>(count)); }
  /// A sequence of primitives with its count.
  template <CdrPrimitive T>
  void put_sequence(std::span<const T> values) {
    put_count(values.size());
    if (values.empty()) return;
    align(sizeof(T));
    append(values.data(), values.size_bytes());
  }
  /// The number of bytes after the encapsulation header; alignment is relative to it.
  [[nodiscard]] std::size_t position() const noexcept { return bytes_.size() - 4; }
  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }

 private:
  void align(std::size_t size) {
    const std::size_t over = position() % size;
    if (over != 0) bytes_.insert(bytes_.end(), size - over, std::byte{0});
  }
  void append(const void* from, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  std::vector<std::byte> bytes_;
};

/// Reads what CdrWriter writes. After a read beyond the end, or if the header is not little-endian
/// plain CDR, ok() is false and all results are zero or empty; so read everything and check once.
/// Spans point into the message.
class CdrReader {
 public:
  explicit CdrReader(std::span<const std::byte> message) noexcept
      : body_(is_plain(message) ? message.subspan(4) : std::span<const std::byte>()),
        ok_(is_plain(message)) {}
  template <CdrPrimitive T>
  [[nodiscard]] T get() noexcept {
    T value{};
    align(sizeof value);
    const std::span<const std::byte> from = raw(sizeof value);
    if (!from.empty()) std::memcpy(&value, from.data(), sizeof value);
    return value;
  }
  [[nodiscard]] std::string get_string() {
    const auto size = get<std::uint32_t>();
    const std::span<const std::byte> text = raw(size);
    if (text.empty()) return {};
    return {reinterpret_cast<const char*>(text.data()), text.size() - 1};
  }
  template <CdrPrimitive T>
  [[nodiscard]] std::vector<T> get_sequence() {
    const std::uint64_t count = get<std::uint32_t>();
    if (count == 0) return {};
    align(sizeof(T));
    const std::span<const std::byte> from = raw(count * sizeof(T));
    std::vector<T> values(from.size() / sizeof(T));
    if (!from.empty()) std::memcpy(values.data(), from.data(), from.size());
    return values;
  }
  [[nodiscard]] std::span<const std::byte> get_bytes() noexcept {
    return raw(get<std::uint32_t>());
  }
  /// Elements whose memory layout is their CDR encoding: all members aligned to their size,
  /// sizeof(T) a multiple of 8. Precondition: the position is a multiple of 8.
  template <class T>
    requires(std::is_trivially_copyable_v<T> && sizeof(T) % 8 == 0)
  [[nodiscard]] std::vector<T> get_packed(std::uint64_t count) {
    const std::span<const std::byte> from = raw(count * sizeof(T));
    std::vector<T> values(from.size() / sizeof(T));
    if (!from.empty()) std::memcpy(values.data(), from.data(), from.size());
    return values;
  }
  /// A count of elements that take at least `least_bytes` each. If the message is too short for
  /// that many, returns 0 and ok() becomes false.
  [[nodiscard]] std::uint32_t get_count(std::uint64_t least_bytes) noexcept {
    const auto count = get<std::uint32_t>();
    if (ok_ && count * least_bytes > body_.size() - position_) ok_ = false;
    return ok_ ? count : 0;
  }
  [[nodiscard]] bool ok() const noexcept { return ok_; }
  /// Whether the whole message has been read.
  [[nodiscard]] bool at_end() const noexcept { return position_ == body_.size(); }

 private:
  [[nodiscard]] static bool is_plain(std::span<const std::byte> message) noexcept {
    return message.size() >= 4 && message[0] == std::byte{0} && message[1] == std::byte{1};
  }
  void align(std::size_t size) noexcept {
    const std::size_t over = position_ % size;
    if (over != 0) static_cast<void>(raw(size - over));
  }
  [[nodiscard]] std::span<const std::byte> raw(std::uint64_t size) noexcept {
    if (!ok_ || size > body_.size() - position_) {
      ok_ = false;
      return {};
    }
    const auto found = body_.subspan(position_, size);
    position_ += size;
    return found;
  }

  std::span<const std::byte> body_;
  std::size_t position_ = 0;
  bool ok_;
};

}  // namespace rave::record
