// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "rave/assemble/build.hpp"
#include "rave/probe/probe_block.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // Without a driver everything but its parameters is read.
  static rave::plugin::Catalogue catalogue(rave::runtime::host_stamp());
  static_cast<void>(
      rave::probe::read_block({reinterpret_cast<const char*>(data), size}, catalogue));
  return 0;
}
