// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::config {

/// All that is wrong with one input, in the order in which it was found. Owned by whoever reads;
/// not for use by two threads at once.
class Diagnostics {
 public:
  /// More errors than this are not kept, so that a hostile file cannot fill the memory.
  static constexpr std::size_t kMaxErrors = 1000;
  /// How many errors `joined` shows unless told otherwise.
  static constexpr std::size_t kMaxShown = 20;

  void add(Error error);
  [[nodiscard]] bool ok() const noexcept { return errors_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return errors_.size(); }
  [[nodiscard]] std::span<const Error> errors() const noexcept { return errors_; }

  /// Puts the errors in the order of their lines and columns; those of one place stay in order.
  void sort();

  /// One Error that shows up to `shown` errors, one per line, each with its own
  /// file:line:column, and says how many more there are. Precondition: not ok().
  [[nodiscard]] Error joined(std::size_t shown = kMaxShown) const;

 private:
  std::vector<Error> errors_;
};

}  // namespace rave::config
