// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/request_box.hpp"

#include "rave/bus/sequence.hpp"

namespace rave::bus {

Result<std::unique_ptr<RequestBox>> RequestBox::create(Bus& bus, BeginRequest begin, LogSink* log) {
  if (!begin) return std::unique_ptr<RequestBox>();
  std::unique_ptr<RequestBox> box(new RequestBox(bus.writer(), RequestBook(std::move(begin), log)));
  RAVE_TRY(open_all(bus, box->requests_, box->answers_));
  return box;
}

void RequestBox::serve() {
  const std::size_t heard = requests_.take([this](const Request& request) {
    if (request.target != self_) return;
    book_.hear({request.writer, request.number, request.from, text_of(request.text)},
               RequestBook::Clock::now());
  });
  // Fast path: most steps have no requests.
  if (heard == 0 && idle_) return;
  for (const RequestBook::Reply& reply : book_.take(RequestBook::Clock::now())) {
    RequestAnswer answer{};
    answer.target = reply.target;
    answer.number = reply.number;
    answer.taken = reply.taken;
    borrow_text(answer.text, reply.text);
    // A lost answer is sent again when the request is repeated.
    static_cast<void>(answers_.write(answer));
  }
  idle_ = book_.idle();
}

}  // namespace rave::bus
