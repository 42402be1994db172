// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace rave::bus {

/// A view of the elements of a wire sequence.
template <class Sequence>
[[nodiscard]] auto elements(const Sequence& sequence) noexcept {
  using Element = std::remove_pointer_t<decltype(sequence._buffer)>;
  return std::span<const Element>(sequence._buffer, sequence._length);
}

/// Makes a wire sequence refer to memory of the caller, without a copy. The memory must outlive the
/// use of the sample. At most 2^32 - 1 elements.
template <class Sequence, class Container>
void borrow(Sequence& sequence, Container& container) noexcept {
  sequence._buffer = std::data(container);
  sequence._length = static_cast<std::uint32_t>(std::size(container));
  sequence._maximum = sequence._length;
  sequence._release = false;
}

/// A sequence of octets as text, valid as long as the sample.
template <class Sequence>
[[nodiscard]] std::string_view text_of(const Sequence& octets) noexcept {
  static_assert(sizeof(*octets._buffer) == 1);
  if (octets._length == 0) return {};
  return {reinterpret_cast<const char*>(octets._buffer), octets._length};
}

/// Makes a wire sequence of octets refer to text of the caller, without a copy. The text must
/// outlive the use of the sample, which does not change it.
template <class Sequence>
void borrow_text(Sequence& sequence, std::string_view text) noexcept {
  // The wire type requires non-const octets.
  sequence._buffer = reinterpret_cast<std::uint8_t*>(const_cast<char*>(text.data()));
  sequence._length = static_cast<std::uint32_t>(text.size());
  sequence._maximum = sequence._length;
  sequence._release = false;
}

/// Copies text into a bounded wire string. Text that does not fit is cut at a character boundary.
/// Returns whether all of it fitted.
template <std::size_t kSize>
bool put_text(char (&field)[kSize], std::string_view text) noexcept {
  std::size_t size = std::min(text.size(), kSize - 1);
  while (size < text.size() && size > 0 && (static_cast<unsigned char>(text[size]) & 0xC0U) == 0x80)
    --size;
  std::copy_n(text.data(), size, field);
  std::fill(field + size, field + kSize, '\0');
  return size == text.size();
}

}  // namespace rave::bus
