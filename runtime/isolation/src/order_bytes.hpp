// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout.hpp"
#include "rave/robot/program.hpp"

namespace rave::isolation {

/// Writes the orders of a decision for the child; `to` has space for kOrderBytes. An order that
/// does not fit is omitted, with all orders after it.
[[nodiscard]] SharedOrders write_orders(const DecideItem& item, std::byte* to) noexcept;

/// Reads the orders of a decision in the child. `items` is cleared and points into `from`.
void read_orders(const SharedOrders& head, const std::byte* from, std::vector<OrderItem>& items);

/// Collects the answers of the program in the shared memory until the host reads them.
class AnswerWriter {
 public:
  AnswerWriter(SharedAnswers* head, std::byte* bytes) noexcept : head_(head), bytes_(bytes) {
    service_.context = this;
    service_.say = [](void* context, std::uint32_t /*robot*/, const char* text, std::uint64_t size,
                      std::uint32_t done) {
      return static_cast<AnswerWriter*>(context)->say({text, size}, done);
    };
  }
  AnswerWriter(const AnswerWriter&) = delete;
  AnswerWriter& operator=(const AnswerWriter&) = delete;
  void begin() noexcept { *head_ = {}; }
  [[nodiscard]] const AnswerService* service() const noexcept { return &service_; }

 private:
  bool say(std::span<const char> text, std::uint32_t done) noexcept;
  AnswerService service_;
  SharedAnswers* head_;
  std::byte* bytes_;
};

/// Passes on the answers of a child. The memory is writable for the child, so nothing beyond its
/// limits is read.
void take_answers(const SharedAnswers& head, const std::byte* bytes, const DecideItem& item);

}  // namespace rave::isolation
