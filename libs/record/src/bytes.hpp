// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace rave::record {

static_assert(std::endian::native == std::endian::little, "MCAP and CDR are written little-endian");

using Bytes = std::vector<std::byte>;
using ByteSpan = std::span<const std::byte>;

[[nodiscard]] inline ByteSpan as_bytes(std::string_view text) noexcept {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// Appends MCAP's basic types (specification, section "Serialization") to a buffer.
class ByteWriter {
 public:
  explicit ByteWriter(Bytes& out) noexcept : out_(out) {}

  /// Appends integers, texts and pairs of them, which are a map.
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }

  void raw(ByteSpan bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }
  [[nodiscard]] std::size_t begin_size32() {
    put(std::uint32_t{0});
    return out_.size();
  }
  void end_size32(std::size_t at) {
    const auto size = static_cast<std::uint32_t>(out_.size() - at);
    std::memcpy(out_.data() + at - sizeof size, &size, sizeof size);
  }
  [[nodiscard]] std::size_t begin_record(std::uint8_t opcode) {
    put(opcode);
    put(std::uint64_t{0});
    return out_.size();
  }
  void end_record(std::size_t at) {
    const std::uint64_t size = out_.size() - at;
    std::memcpy(out_.data() + at - sizeof size, &size, sizeof size);
  }
  [[nodiscard]] std::size_t size() const noexcept { return out_.size(); }

 private:
  template <class T>
    requires std::is_integral_v<T>
  void put(T value) {
    raw(std::as_bytes(std::span(&value, 1)));
  }
  void put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    raw(as_bytes(text));
  }
  /// A map has its size in bytes, not in elements.
  template <class Pairs>
    requires requires(Pairs pairs) { pairs.begin()->second; }
  void put(const Pairs& pairs) {
    const std::size_t at = begin_size32();
    for (const auto& [key, value] : pairs) (*this)(key, value);
    end_size32(at);
  }

  Bytes& out_;
};

/// Reads the same types. After a read beyond the end, ok() is false and all results are zero or
/// empty, so a record can be read completely and checked once.
class ByteReader {
 public:
  explicit ByteReader(ByteSpan bytes) noexcept : bytes_(bytes) {}

  template <class T>
    requires std::is_integral_v<T>
  [[nodiscard]] T get() noexcept {
    T value{};
    const ByteSpan from = raw(sizeof value);
    if (!from.empty()) std::memcpy(&value, from.data(), sizeof value);
    return value;
  }
  [[nodiscard]] ByteSpan raw(std::uint64_t size) noexcept {
    if (!ok_ || size > bytes_.size() - position_) {
      ok_ = false;
      return {};
    }
    const ByteSpan found = bytes_.subspan(position_, size);
    position_ += size;
    return found;
  }
  /// Reads what the same call of a ByteWriter has written.
  template <class... T>
  void operator()(T&... values) {
    (take(values), ...);
  }
  /// Reads and ignores values of these types.
  template <class... T>
  void skip() {
    std::tuple<T...> ignored;
    std::apply(*this, ignored);
  }
  [[nodiscard]] bool ok() const noexcept { return ok_; }
  [[nodiscard]] std::size_t rest() const noexcept { return bytes_.size() - position_; }
  [[nodiscard]] std::size_t position() const noexcept { return position_; }

 private:
  template <class T>
    requires std::is_integral_v<T>
  void take(T& value) noexcept {
    value = get<T>();
  }
  void take(std::string& value) {
    const ByteSpan text = raw(get<std::uint32_t>());
    value.assign(reinterpret_cast<const char*>(text.data()), text.size());
  }
  template <class Key, class Value>
  void take(std::map<Key, Value>& pairs) {
    take_pairs<Key, Value>(
        [&](Key& key, Value& value) { pairs[std::move(key)] = std::move(value); });
  }
  template <class Key, class Value>
  void take(std::vector<std::pair<Key, Value>>& pairs) {
    take_pairs<Key, Value>([&](Key& key, Value& value) { pairs.emplace_back(key, value); });
  }
  template <class Key, class Value, class Add>
  void take_pairs(Add add) {
    ByteReader pairs(raw(get<std::uint32_t>()));
    while (pairs.ok() && pairs.rest() > 0) {
      Key key{};
      Value value{};
      pairs(key, value);
      add(key, value);
    }
    ok_ = ok_ && pairs.ok();
  }

  ByteSpan bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace rave::record
