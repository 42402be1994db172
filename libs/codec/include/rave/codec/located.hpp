// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "rave/base/error.hpp"

namespace rave::codec {

/// A value of a file with the place where it was read, for errors found later (an unknown driver,
/// two robots of one name). May be the type of a field. Comparison ignores the place.
template <class T>
struct Located {
  T value{};
  /// The place of the value; without a file if it is a default or was set by code.
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

}  // namespace rave::codec
