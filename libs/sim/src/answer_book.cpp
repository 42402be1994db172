// SPDX-License-Identifier: Apache-2.0
// What programs say to people, limited per decision and per second.
#include "answer_book.hpp"

#include <algorithm>
#include <exception>

#include "rave/base/control_characters.hpp"

namespace rave::sim {

// Programs decide on many threads; the book collects what they say, and take() puts it in order.
bool AnswerBook::say(std::uint32_t robot, std::string_view text, bool done) {
  if (text.empty() || text.size() > kMostOrderText) return false;
  try {
    std::string plain = without_control_characters(text, " ");
    const std::lock_guard lock(mutex_);
    if (in_decision_[robot] >= kMostInDecision) return false;
    ++in_decision_[robot];
    answers_.push_back({robot, std::move(plain), done});
  } catch (const std::exception&) {
    return false;  // no memory: the program gets false and continues
  }
  any_.store(true, std::memory_order_release);
  return true;
}

std::vector<AnswerBook::Answer> AnswerBook::take(std::int64_t second) {
  std::vector<Answer> answers;
  {
    const std::lock_guard lock(mutex_);
    answers.swap(answers_);
    in_decision_.clear();
    any_.store(false, std::memory_order_release);
  }
  // Which thread was first is chance.
  std::stable_sort(answers.begin(), answers.end(),
                   [](const Answer& a, const Answer& b) { return a.robot < b.robot; });
  // A program that talks without end would fill log and recording. `done` still counts.
  for (Answer& answer : answers) {
    Spoken& spoken = spoken_[answer.robot];
    if (spoken.second != second) spoken = {second, 0};
    if (++spoken.count > kMostInSecond) answer.text.clear();
  }
  return answers;
}

void AnswerBook::clear() {
  const std::lock_guard lock(mutex_);
  answers_.clear();
  in_decision_.clear();
  spoken_.clear();
  any_.store(false, std::memory_order_release);
}

}  // namespace rave::sim
