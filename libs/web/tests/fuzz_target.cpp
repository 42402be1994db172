// SPDX-License-Identifier: Apache-2.0
// What a request asks for: no path leads out of the root, whatever is sent.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include "rave/web/message.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::string path;
  std::map<std::string, std::string> query;
  if (rave::web::parse_target(text, path, query)) {
    if (path.empty() || path.front() != '/') std::abort();
    if ((path + "/").find("/../") != std::string::npos) std::abort();
  }
  rave::web::Request request;
  request.headers["cookie"] = std::string(text);
  static_cast<void>(request.cookie("rave_8080"));
  return 0;
}
