// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/wish_book.hpp"
#include "rave/bus/writer.hpp"

namespace rave::bus {

/// Receives the requests to this process from the bus (topic rave/wish) and sends the answers
/// (rave/answer). Destroy it before its bus; thread: that of the bus.
class WishBox {
 public:
  /// `log` is not owned and may be null. Returns null if `begin` is empty. Errors: those of
  /// Writer::create().
  [[nodiscard]] static Result<std::unique_ptr<WishBox>> create(Bus& bus, BeginWish begin,
                                                               LogSink* log);

  /// Makes `waits` wake up when a request arrives.
  [[nodiscard]] Status wake(WaitSet& waits) const { return waits.add(wishes_); }
  /// Begins the received requests and sends the available answers. Does not block.
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
  bool idle_ = true;  ///< Nothing to do until the next request.
};

}  // namespace rave::bus
