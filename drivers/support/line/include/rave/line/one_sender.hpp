// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace rave::line {

/// Chooses one of several senders of what should be one stream, so that two robots are never taken
/// for one. The first counts until it is gone. `Key` names a sender. Reads no clock. Not
/// thread-safe.
template <class Key>
class OneSender {
 public:
  /// What is to be done with a message, and what to say of its sender.
  struct Verdict {
    bool counts = false;     ///< Whether the message is to be used.
    bool changed = false;    ///< It is the first of a sender that took the place of another.
    bool new_rival = false;  ///< It is the first that does not count of its sender.
  };

  /// Judges a message that arrived at `at_s`. It counts if it is from the present sender, or if
  /// that one has been silent for `patience_s`, or is to give way for a reason that the caller
  /// knows.
  Verdict take(const Key& sender, double at_s, double patience_s, bool gives_way = false) {
    if (present_ == sender) {
      ++heard_;
      last_s_ = at_s;
      return {true, false, false};
    }
    const bool known = std::find(others_.begin(), others_.end(), sender) != others_.end();
    if (present_ && !gives_way && at_s - last_s_ < patience_s) {
      remember(sender, known);
      return {false, false, !known};
    }
    const bool changed = present_.has_value();
    if (changed) remember(*present_, false);
    present_ = sender;
    heard_ = known ? 2 : 1;
    last_s_ = at_s;
    return {true, changed, false};
  }

  [[nodiscard]] const std::optional<Key>& present() const noexcept { return present_; }
  /// Whether the present sender has been heard only once, so that it may be one that names itself
  /// differently in each message.
  [[nodiscard]] bool heard_once() const noexcept { return heard_ == 1; }

 private:
  static constexpr std::size_t kMostOthers = 8;

  void remember(const Key& sender, bool known) {
    if (known) return;
    if (others_.size() == kMostOthers) others_.erase(others_.begin());
    others_.push_back(sender);
  }

  std::optional<Key> present_;
  std::uint64_t heard_ = 0;  // messages of the present sender
  double last_s_ = 0;
  std::vector<Key> others_;  // the last ones that did not count, or count no more
};

}  // namespace rave::line
