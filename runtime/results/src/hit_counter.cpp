// SPDX-License-Identifier: Apache-2.0
#include "rave/results/hit_counter.hpp"

namespace rave::runtime {
namespace {

constexpr std::string_view kNothing = "nothing";

}  // namespace

void HitCounter::after_step(const StepView& view) {
  const sim::Engine& engine = view.engine;
  const sim::EngineSpec& spec = engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    if (!engine.is_local(RobotId(r))) continue;
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
      const sim::SensorSample sample = engine.sensor(RobotId(r), s);
      // `bodies` belongs to the newest scan, which latency may still withhold from the program.
      const std::uint64_t step = engine.steps_done() - 1;
      const sim::SensorSpec& sensor = type.sensors[s];
      const bool due =
          step >= sensor.phase_steps && (step - sensor.phase_steps) % sensor.period_steps == 0;
      if (sample.bodies.empty() || !due || !engine.snapshot().robot(RobotId(r)).present) continue;
      Counters& counters = type.simulated ? simulated_ : real_;
      for (const std::uint32_t body : sample.bodies) {
        ++*count_of(counters, body == BodyId::kNone ? kNothing : kinds_->word(body));
      }
    }
  }
}

/// Called for each ray of each robot, and there are few words, so they are compared by address
/// instead of by text.
std::uint64_t* HitCounter::count_of(Counters& counters, std::string_view what) {
  for (const auto& [word, count] : counters.known) {
    if (word == what.data()) return count;
  }
  std::uint64_t* const count = &counts_[{counters.who, what}];
  counters.known.emplace_back(what.data(), count);
  return count;
}

std::map<std::string, std::map<std::string, std::uint64_t>> HitCounter::counts() const {
  std::map<std::string, std::map<std::string, std::uint64_t>> result;
  for (const auto& [key, count] : counts_) {
    result[std::string(key.first)][std::string(key.second)] = count;
  }
  return result;
}

}  // namespace rave::runtime
