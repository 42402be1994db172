// SPDX-License-Identifier: Apache-2.0
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "rave/plugin/stamp.hpp"

namespace {

/// The stamp of a file with these bytes, of which only parts are read.
rave::Result<rave::plugin::Stamp> stamp_of_file(std::string_view bytes) {
  static const int file = ::memfd_create("stamp", 0);
  const auto size = static_cast<::off_t>(bytes.size());
  if (::ftruncate(file, size) != 0 || ::pwrite(file, bytes.data(), bytes.size(), 0) != size) {
    std::abort();
  }
  return rave::plugin::read_stamp("/proc/self/fd/" + std::to_string(file));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using rave::plugin::Stamp;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto stamp = rave::plugin::parse_stamp(bytes);
  const auto of_file = stamp_of_file(bytes);
  if (stamp.has_value() != of_file.has_value()) std::abort();
  if (!stamp) {
    if (stamp.error().message != of_file.error().message) std::abort();
    if (stamp.error().message.empty()) std::abort();
    return 0;
  }
  if (std::memcmp(&*stamp, &*of_file, sizeof(Stamp)) != 0) std::abort();
  if (stamp->magic != Stamp::kMagic) std::abort();
  for (const std::string& name : rave::plugin::parse_provides(*stamp)) {
    if (name.empty() || name.size() > sizeof stamp->provides) std::abort();
  }
  // Every stamp suits itself, whatever it says.
  if (!rave::plugin::check_stamp(*stamp, *stamp)) std::abort();
  return 0;
}
