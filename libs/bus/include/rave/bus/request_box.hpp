// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "rave/bus/reader.hpp"
#include "rave/bus/request_book.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"

namespace rave::bus {

/// Receives the requests to this process from the bus (topic rave/request) and sends the answers
/// (rave/answer). Destroy it before its bus; thread: that of the bus.
class RequestBox {
 public:
  /// `log` is not owned and may be null. Returns null if `begin` is empty. Errors: those of
  /// Writer::create().
  [[nodiscard]] static Result<std::unique_ptr<RequestBox>> create(Bus& bus, BeginRequest begin,
                                                                  LogSink* log);

  /// Makes `waits` wake up when a request arrives.
  [[nodiscard]] Status wake(WaitSet& waits) const { return waits.add(requests_); }
  /// Begins the received requests and sends the available answers. Does not block.
  void serve();

 private:
  RequestBox(std::uint64_t self, RequestBook book) : self_(self), book_(std::move(book)) {}

  Reader<Request> requests_;
  Writer<RequestAnswer> answers_;
  std::uint64_t self_;  ///< The writer of this process.
  RequestBook book_;
  bool idle_ = true;  ///< Nothing to do until the next request.
};

}  // namespace rave::bus
