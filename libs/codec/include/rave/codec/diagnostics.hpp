// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::codec {

/// All errors of one input, in the order in which they were found. Owned by the reading function;
/// not thread-safe.
class Diagnostics {
 public:
  /// Later errors are dropped, so that a malicious file cannot exhaust the memory.
  static constexpr std::size_t kMaxErrors = 1000;
  /// The default number of errors that `joined` shows.
  static constexpr std::size_t kMaxShown = 20;

  void add(Error error);
  /// Adds an error in the content of the file, with the code kParse.
  void add(SourceLocation where, std::string message) {
    add(Error{ErrorCode::kParse, std::move(message), std::move(where)});
  }
  [[nodiscard]] bool ok() const noexcept { return errors_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return errors_.size(); }
  [[nodiscard]] std::span<const Error> errors() const noexcept { return errors_; }

  /// Sorts the errors by line and column; stable.
  void sort();

  /// One Error that lists up to `shown` errors, one per line, each with its file:line:column, and
  /// the number of further ones. Precondition: not ok().
  [[nodiscard]] Error joined(std::size_t shown = kMaxShown) const;
  /// The value if there are no errors, otherwise all errors, sorted and joined.
  template <class T>
  [[nodiscard]] Result<T> value_or_errors(T value) {
    if (ok()) return value;
    sort();
    return tl::unexpected<Error>(joined());
  }

 private:
  std::vector<Error> errors_;
};

}  // namespace rave::codec
