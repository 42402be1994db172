// SPDX-License-Identifier: Apache-2.0
// Whatever a Foxglove client says is a request of the protocol or an error, within the limits.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "foxglove/foxglove_message.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::gui_server;
  const auto message =
      parse_foxglove_message(std::string_view(reinterpret_cast<const char*>(data), size));
  if (!message) {
    if (message.error().message.empty()) std::abort();
    return 0;
  }
  const auto* const subscribe = std::get_if<FoxgloveSubscribe>(&*message);
  if (subscribe != nullptr && subscribe->subscriptions.size() > kMostSubscriptions) std::abort();
  const auto* const refused = std::get_if<FoxgloveRefused>(&*message);
  if (refused != nullptr && refused->op.empty()) std::abort();
  return 0;
}
