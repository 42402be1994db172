// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rave {

/// A value of nlohmann/json in one line. Names and texts come from files and other processes: bytes
/// that are no UTF-8 are replaced, where dump() would throw.
template <class Json>
[[nodiscard]] std::string json_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace rave
