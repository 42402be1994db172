// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/wish_book.hpp"
#include "rave/bus/writer.hpp"

namespace rave::bus {

/// Hears what others ask of this process on the bus (topic rave/wish), and answers (rave/answer).
/// Must be gone before its bus; thread: that of the bus.
class WishBox {
 public:
  /// `log` is not owned and may be null. Null if nothing can be begun. Errors: those of
  /// Writer::create().
  [[nodiscard]] static Result<std::unique_ptr<WishBox>> create(Bus& bus, BeginWish begin,
                                                               LogSink* log);

  /// Wakes whoever waits when a wish comes.
  [[nodiscard]] Status wake(WaitSet& waits) const { return waits.add(wishes_); }
  /// Begins what has come, and answers what is done. Waits for nobody.
  void serve();

 private:
  WishBox(Reader<Wish> wishes, Writer<WishAnswer> answers, std::uint64_t self, WishBook book)
      : wishes_(std::move(wishes)),
        answers_(std::move(answers)),
        self_(self),
        book_(std::move(book)) {}

  Reader<Wish> wishes_;
  Writer<WishAnswer> answers_;
  std::uint64_t self_;  ///< The writer of this process.
  WishBook book_;
  bool idle_ = true;  ///< Nothing is to be done until the next wish.
};

}  // namespace rave::bus
