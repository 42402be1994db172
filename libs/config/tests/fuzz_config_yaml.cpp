// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <cstdlib>

#include "sample_config.hpp"

namespace {

using rave::codec::Diagnostics;

/// Whatever can be read can be written, and what is written reads back as the same.
void check_tree(std::string_view text) {
  Diagnostics diagnostics;
  const auto tree = rave::config::parse_yaml(text, "fuzz", diagnostics);
  if (!tree || !diagnostics.ok()) return;
  const auto again = rave::config::parse_yaml(rave::codec::to_yaml(*tree), "again", diagnostics);
  if (!again || !diagnostics.ok() || !(*again == *tree)) std::abort();
  (void)rave::codec::to_json(*tree);
}

void check_struct(std::string_view text) {
  const auto value = rave::config::read_text<rave::sample::Laser>(text, "fuzz");
  if (!value) {
    if (value.error().where.file != "fuzz" || value.error().message.empty()) std::abort();
    return;
  }
  const auto again =
      rave::config::read_text<rave::sample::Laser>(rave::config::write_text(*value), "again");
  if (!again || !(*again == *value)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check_tree(text);
  check_struct(text);
  return 0;
}
