// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "rave/plugin/stamp.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using rave::plugin::Stamp;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto stamp = rave::plugin::parse_stamp(bytes);
  if (!stamp) {
    if (stamp.error().message.empty()) std::abort();
    return 0;
  }
  if (stamp->magic != Stamp::kMagic) std::abort();
  for (const std::string& name : rave::plugin::parse_provides(*stamp)) {
    if (name.empty() || name.size() > sizeof stamp->provides) std::abort();
  }
  // Every stamp suits itself, whatever it says.
  if (!rave::plugin::check_stamp(*stamp, *stamp)) std::abort();
  return 0;
}
