// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "rave/base/error.hpp"

namespace rave {

/// The value of a fallible call, or an Error. Every public function that can fail returns a Result
/// or Status; no exception crosses a library boundary. The compiler refuses a call that drops the
/// result; to drop it on purpose, write `static_cast<void>(...)` and the reason.
template <class T>
class [[nodiscard]] Result : public tl::expected<T, Error> {
 public:
  using tl::expected<T, Error>::expected;
};

/// A fallible call without a value.
using Status = Result<void>;

/// Makes a failed Result: `return fail(ErrorCode::kIo, "cannot open {}", p);`
template <class... Args>
[[nodiscard]] tl::unexpected<Error> fail(ErrorCode code, fmt::format_string<Args...> format,
                                         Args&&... args) {
  return tl::unexpected<Error>(
      Error{code, fmt::format(format, std::forward<Args>(args)...), SourceLocation{}});
}

/// Like fail(), with a place in the user's file.
template <class... Args>
[[nodiscard]] tl::unexpected<Error> fail_at(SourceLocation where, ErrorCode code,
                                            fmt::format_string<Args...> format, Args&&... args) {
  return tl::unexpected<Error>(
      Error{code, fmt::format(format, std::forward<Args>(args)...), std::move(where)});
}

}  // namespace rave

/// Returns the error of `expr` from the calling function if `expr` failed.
#define RAVE_TRY(expr)                                                             \
  do {                                                                             \
    if (auto rave_try_status_ = (expr); !rave_try_status_) {                       \
      return ::tl::unexpected<::rave::Error>(std::move(rave_try_status_).error()); \
    }                                                                              \
  } while (false)

#define RAVE_TRY_CONCAT_INNER_(a, b) a##b
#define RAVE_TRY_CONCAT_(a, b) RAVE_TRY_CONCAT_INNER_(a, b)
#define RAVE_TRY_ASSIGN_IMPL_(temporary, target, expr)                    \
  auto temporary = (expr);                                                \
  if (!temporary) {                                                       \
    return ::tl::unexpected<::rave::Error>(std::move(temporary).error()); \
  }                                                                       \
  target = *std::move(temporary)

/// `RAVE_TRY_ASSIGN(const auto file, open(path));` declares the target with the value of `expr`, or
/// returns its error from the calling function.
#define RAVE_TRY_ASSIGN(target, expr) \
  RAVE_TRY_ASSIGN_IMPL_(RAVE_TRY_CONCAT_(rave_try_result_, __LINE__), target, expr)
