// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/wish_box.hpp"

#include "rave/bus/sequence.hpp"

namespace rave::bus {

Result<std::unique_ptr<WishBox>> WishBox::create(Bus& bus, BeginWish begin, LogSink* log) {
  if (!begin) return std::unique_ptr<WishBox>();
  RAVE_TRY_ASSIGN(auto wishes, Reader<Wish>::create(bus));
  RAVE_TRY_ASSIGN(auto answers, Writer<WishAnswer>::create(bus));
  return std::unique_ptr<WishBox>(new WishBox(std::move(wishes), std::move(answers), bus.writer(),
                                              WishBook(std::move(begin), log)));
}

void WishBox::serve() {
  const std::size_t heard = wishes_.take([this](const Wish& wish) {
    if (wish.target != self_) return;
    book_.hear({wish.writer, wish.number, wish.from, text_of(wish.text)}, WishBook::Clock::now());
  });
  // Fast path: most steps have no requests.
  if (heard == 0 && idle_) return;
  for (WishBook::Reply& reply : book_.take(WishBook::Clock::now())) {
    WishAnswer answer{};
    answer.target = reply.target;
    answer.number = reply.number;
    answer.taken = reply.taken;
    // The wire type requires non-const octets.
    answer.text._buffer = reinterpret_cast<std::uint8_t*>(reply.text.data());
    answer.text._length = static_cast<std::uint32_t>(reply.text.size());
    answer.text._maximum = answer.text._length;
    // A lost answer is sent again when the request is repeated.
    static_cast<void>(answers_.write(answer));
  }
  idle_ = book_.idle();
}

}  // namespace rave::bus
