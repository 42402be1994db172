// SPDX-License-Identifier: Apache-2.0
// Bytes as a script and as an expression: nothing crashes, hangs, or goes beyond its limits.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "rave/script/script.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using rave::script::Script;
  const std::string_view source(reinterpret_cast<const char*>(data), size);
  constexpr rave::script::Limits kLimits = {.instructions = 20'000, .bytes = 1U << 18U};
  const auto script = Script::load(source, "fuzz.lua", {}, kLimits);
  if (script) {
    static_cast<void>((*script)->call("on_step", {}));
    const auto bytes = write_value((*script)->memory());
    if (rave::script::read_value(bytes) != (*script)->memory()) std::abort();
    return 0;
  }
  if (script.error().message.empty()) std::abort();
  const auto empty = Script::load("", "fuzz.lua", {}, kLimits);
  const auto expression = (*empty)->compile(source, {"fuzz.yaml", 1, 1});
  if (expression) static_cast<void>((*empty)->evaluate(*expression));
  return 0;
}
