// SPDX-License-Identifier: Apache-2.0
// What a request asks for, and what a form says: no path leads out of the root, and no field has a
// line of its own, whatever is sent.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include "rave/web/message.hpp"
#include "rave/web/rate_limit.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::string path;
  std::map<std::string, std::string> query;
  if (rave::web::parse_target(text, path, query)) {
    if (path.empty() || path.front() != '/') std::abort();
    if ((path + "/").find("/../") != std::string::npos) std::abort();
  }
  std::map<std::string, std::string> fields;
  if (rave::web::parse_form(text, fields)) {
    for (const auto& [name, value] : fields) {
      if ((name + value).find_first_of("\r\n") != std::string::npos) std::abort();
    }
  }
  static_cast<void>(rave::web::network_of(std::string(text)));
  rave::web::Request request;
  request.headers["cookie"] = std::string(text);
  static_cast<void>(request.cookie("rave_8080"));
  return 0;
}
