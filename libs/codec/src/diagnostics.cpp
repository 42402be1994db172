// SPDX-License-Identifier: Apache-2.0
#include "rave/codec/diagnostics.hpp"

#include <algorithm>
#include <utility>

#include "rave/base/check.hpp"

namespace rave::codec {

void Diagnostics::add(Error error) {
  // A file that many entries name is read for each of them.
  const auto is_same = [&](const Error& other) {
    return other.where.text() == error.where.text() && other.message == error.message;
  };
  if (!error.where.file.empty() && std::ranges::any_of(errors_, is_same)) return;
  if (errors_.size() < kMaxErrors) errors_.push_back(std::move(error));
}

// By line, because a reader goes through the file from the top; stable, since the first of two
// errors at one place is the cause.
void Diagnostics::sort() {
  std::stable_sort(errors_.begin(), errors_.end(), [](const Error& a, const Error& b) {
    return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
  });
}

Error Diagnostics::joined(std::size_t shown) const {
  RAVE_CHECK(!errors_.empty());
  Error all = errors_.front();
  const std::size_t count = std::min(errors_.size(), std::max<std::size_t>(shown, 1));
  for (std::size_t i = 1; i < count; ++i) all.message += "\n" + errors_[i].text();
  if (errors_.size() > count) {
    all.message += fmt::format("\nand {}{} more", errors_.size() == kMaxErrors ? "at least " : "",
                               errors_.size() - count);
  }
  return all;
}

}  // namespace rave::codec
