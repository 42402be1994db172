// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::plugin {

/// The contents of the section `.rave_stamp` of every plug-in. The host reads it from the file
/// before it loads the plug-in, so that a plug-in for another interface is never executed. Plain
/// bytes.
struct Stamp {
  static constexpr std::uint64_t kMagic = 0x31504d5453455652ULL;  // "RVESTMP1", little endian

  std::uint64_t magic = kMagic;
  /// Hash of the layout of all types in rave/robot that cross the interface; see interface_hash.hpp
  /// there.
  std::uint64_t robot_interface = 0;
  /// Hash of the layout of the virtual-driver interface in rave/sim; 0 if not used.
  std::uint64_t virtual_interface = 0;
  /// The C++ ABI of the compiler (`__GXX_ABI_VERSION`).
  std::uint32_t compiler_abi = 0;
  /// `alignof(std::max_align_t)` and the vector alignment that the flags imply.
  std::uint32_t alignment = 0;
  /// 0 none, 1 address, 2 thread; plug-in and host must use the same.
  std::uint32_t sanitizer = 0;
  std::uint32_t reserved = 0;
  /// Names of the drivers, separated by blanks, so that a host loads only the files it needs.
  char provides[216] = {};
};
static_assert(sizeof(Stamp) == 256);

namespace detail {
constexpr std::uint32_t sanitizer_of_this_build() noexcept {
#if defined(__SANITIZE_ADDRESS__)
  return 1;
#elif defined(__SANITIZE_THREAD__)
  return 2;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
  return 1;
#elif __has_feature(thread_sanitizer)
  return 2;
#else
  return 0;
#endif
#else
  return 0;
#endif
}
}  // namespace detail

/// The stamp of the calling translation unit. `provides` lists the names of its drivers, separated
/// by blanks, in at most 215 characters.
constexpr Stamp make_stamp(std::uint64_t robot_interface, std::uint64_t virtual_interface,
                           std::string_view provides) noexcept {
  Stamp stamp;
  for (std::size_t i = 0; i < provides.size() && i + 1 < sizeof stamp.provides; ++i) {
    stamp.provides[i] = provides[i];
  }
  stamp.robot_interface = robot_interface;
  stamp.virtual_interface = virtual_interface;
  stamp.compiler_abi = __GXX_ABI_VERSION;
  stamp.alignment = alignof(std::max_align_t);
  stamp.sanitizer = detail::sanitizer_of_this_build();
  return stamp;
}

/// Reads the stamp of a shared library without loading it. Errors: kNotFound, kIo, kParse (not a
/// 64-bit ELF file, damaged), kIncompatible (no stamp, another processor). The messages do not name
/// the file; the caller adds it.
[[nodiscard]] Result<Stamp> read_stamp(const std::filesystem::path& path);

/// Reads the stamp from the bytes of a file; target of the fuzz test.
[[nodiscard]] Result<Stamp> parse_stamp(std::string_view bytes);

/// The driver names that a stamp lists, in its order.
[[nodiscard]] std::vector<std::string> parse_provides(const Stamp& stamp);

/// Checks that a plug-in with stamp `plugin` can run in a host with stamp `host`. Error
/// kIncompatible lists all differences and what to do about each.
[[nodiscard]] Status check_stamp(const Stamp& plugin, const Stamp& host);

}  // namespace rave::plugin
