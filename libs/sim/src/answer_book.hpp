// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "rave/robot/order.hpp"

namespace rave::sim {

/// What programs say to people. say() may be called from all threads of a phase, for one robot from
/// one at a time; the rest belongs to the thread of the engine. Costs nothing while no program
/// speaks.
class AnswerBook {
 public:
  static constexpr std::uint32_t kMostInDecision = 4;
  static constexpr std::uint32_t kMostInSecond = 10;

  struct Answer {
    std::uint32_t robot = 0;
    std::string text;
    bool done = false;  ///< With the current order.
  };

  AnswerBook() {
    service_.context = this;
    service_.say = [](void* context, std::uint32_t robot, const char* text, std::uint64_t size,
                      std::uint32_t done) {
      return static_cast<AnswerBook*>(context)->say(robot, {text, size}, done != 0);
    };
  }
  AnswerBook(const AnswerBook&) = delete;
  AnswerBook& operator=(const AnswerBook&) = delete;

  [[nodiscard]] const AnswerService* service() const noexcept { return &service_; }
  [[nodiscard]] bool any() const noexcept { return any_.load(std::memory_order_acquire); }
  /// What was said since the last call, by robot, and of one robot in its order; of one that says
  /// more than kMostInSecond in a second of the run, what is beyond has no text.
  [[nodiscard]] std::vector<Answer> take(std::int64_t second);
  void clear();

 private:
  struct Spoken {
    std::int64_t second = -1;
    std::uint32_t count = 0;
  };
  bool say(std::uint32_t robot, std::string_view text, bool done);

  AnswerService service_;
  std::atomic<bool> any_{false};
  std::mutex mutex_;
  std::vector<Answer> answers_;
  std::map<std::uint32_t, std::uint32_t> in_decision_;
  std::map<std::uint32_t, Spoken> spoken_;
};

}  // namespace rave::sim
