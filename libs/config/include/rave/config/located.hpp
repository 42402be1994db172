// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "rave/base/error.hpp"

namespace rave::config {

/// A value of a file together with the place it was read from, for checks that come later (an
/// unknown driver, two robots of one name). Usable as the type of a field. Two are equal if their
/// values are; the place does not count.
template <class T>
struct Located {
  T value{};
  /// Of the value; without a file if the value is a default or was set by code.
  SourceLocation where;

  Located() = default;
  // Implicit on purpose: a default is written `Located<int> n = 3;`.
  Located(T v) : value(std::move(v)) {}  // NOLINT(google-explicit-constructor)
  Located(T v, SourceLocation w) : value(std::move(v)), where(std::move(w)) {}

  [[nodiscard]] const T& operator*() const noexcept { return value; }
  [[nodiscard]] T& operator*() noexcept { return value; }
  [[nodiscard]] const T* operator->() const noexcept { return &value; }
  [[nodiscard]] T* operator->() noexcept { return &value; }
  friend bool operator==(const Located& a, const Located& b) { return a.value == b.value; }
};

}  // namespace rave::config
