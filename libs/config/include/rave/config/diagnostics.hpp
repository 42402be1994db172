// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::config {

/// All errors of one input, in the order in which they were found. Owned by the reading function;
/// not thread-safe.
class Diagnostics {
 public:
  /// Later errors are dropped, so that a malicious file cannot exhaust the memory.
  static constexpr std::size_t kMaxErrors = 1000;
  /// The default number of errors that `joined` shows.
  static constexpr std::size_t kMaxShown = 20;

  void add(Error error);
  [[nodiscard]] bool ok() const noexcept { return errors_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return errors_.size(); }
  [[nodiscard]] std::span<const Error> errors() const noexcept { return errors_; }

  /// Sorts the errors by line and column; stable.
  void sort();

  /// One Error that lists up to `shown` errors, one per line, each with its file:line:column, and
  /// the number of further ones. Precondition: not ok().
  [[nodiscard]] Error joined(std::size_t shown = kMaxShown) const;

 private:
  std::vector<Error> errors_;
};

}  // namespace rave::config
