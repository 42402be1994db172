// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "rave/record/run_messages.hpp"

namespace rave::record {

[[nodiscard]] inline bool same(const RunEvent& a, const RunEvent& b) {
  return a.robot == b.robot && a.kind == b.kind && a.text == b.text && a.values == b.values;
}
[[nodiscard]] inline bool same(const RunInput& a, const RunInput& b) { return a == b; }
[[nodiscard]] inline bool same(const ConsoleLine& a, const ConsoleLine& b) {
  return a.level == b.level && a.source == b.source && a.text == b.text;
}

/// Removes duplicates between parts at one time: an item that several parts have is kept once, but
/// an item that one part has twice is kept twice.
template <class Item>
class Once {
 public:
  void add(const void* part, Item item) {
    if (part != part_) {
      part_ = part;
      taken_.assign(items_.size(), false);
    }
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      if (taken_[i] || !same(items_[i], item)) continue;
      taken_[i] = true;
      return;
    }
    items_.push_back(std::move(item));
  }
  [[nodiscard]] std::vector<Item>& items() noexcept { return items_; }

 private:
  const void* part_ = nullptr;
  std::vector<Item> items_;
  std::vector<bool> taken_;  ///< By item of earlier parts: this part has it too.
};

}  // namespace rave::record
