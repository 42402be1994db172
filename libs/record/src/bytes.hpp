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
#include <type_traits>
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

  template <class T>
    requires std::is_integral_v<T>
  void put(T value) {
    raw(std::as_bytes(std::span(&value, 1)));
  }
  void raw(ByteSpan bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }
  void string(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    raw(as_bytes(text));
  }
  void map(const std::map<std::string, std::string>& entries) {
    const std::size_t at = begin_size32();
    for (const auto& [key, value] : entries) {
      string(key);
      string(value);
    }
    end_size32(at);
  }
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
  [[nodiscard]] std::string string() {
    const ByteSpan text = raw(get<std::uint32_t>());
    return {reinterpret_cast<const char*>(text.data()), text.size()};
  }
  [[nodiscard]] std::map<std::string, std::string> map() {
    ByteReader entries(raw(get<std::uint32_t>()));
    std::map<std::string, std::string> found;
    while (entries.ok() && entries.rest() > 0) {
      std::string key = entries.string();
      found[std::move(key)] = entries.string();
    }
    ok_ = ok_ && entries.ok();
    return found;
  }
  [[nodiscard]] bool ok() const noexcept { return ok_; }
  [[nodiscard]] std::size_t rest() const noexcept { return bytes_.size() - position_; }
  [[nodiscard]] std::size_t position() const noexcept { return position_; }

 private:
  ByteSpan bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace rave::record
