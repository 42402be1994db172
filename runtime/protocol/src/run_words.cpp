// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/run_words.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "rave/bus/sequence.hpp"

namespace rave::lock_step {

RunWord run_word(const bus::RunState& state, std::uint32_t host) {
  RunWord word{state.writer, state.phase, state.text, false};
  for (const auto& seen : bus::elements(state.hosts)) {
    if (seen.host == host && seen.phase == rave_wire_HOST_DROPPED) word.without_us = true;
  }
  return word;
}

void RunWords::welcome(std::uint64_t writer) {
  // A manager that was shut out stays out: its introduction cannot improve.
  if (fitting_.size() < kMostKnown && !strangers_.contains(writer)) fitting_.insert(writer);
}

void RunWords::shut_out(std::uint64_t writer) {
  fitting_.erase(writer);
  if (strangers_.size() < kMostKnown) strangers_.insert(writer);
  std::erase_if(said_, [writer](const RunWord& word) { return word.writer == writer; });
}

void RunWords::hear(RunWord word) {
  if (strangers_.contains(word.writer)) return;
  // The newest state of a sender replaces the one before, also among those that wait for an
  // introduction.
  std::erase_if(said_, [&word](const RunWord& old) { return old.writer == word.writer; });
  // Senders without introduction cannot displace the word of a known manager.
  if (said_.size() >= kMostKept && !fitting_.contains(word.writer)) return;
  said_.push_back(std::move(word));
}

std::vector<RunWord> RunWords::take() {
  const auto counts = [this](const RunWord& word) { return fitting_.contains(word.writer); };
  std::vector<RunWord> words;
  std::copy_if(said_.begin(), said_.end(), std::back_inserter(words), counts);
  std::erase_if(said_, counts);
  return words;
}

}  // namespace rave::lock_step
