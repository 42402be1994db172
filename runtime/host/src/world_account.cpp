// SPDX-License-Identifier: Apache-2.0
#include "world_account.hpp"

#include <algorithm>
#include <cstddef>
#include <variant>

#include "rave/host/host_part.hpp"

namespace rave::runtime {
namespace {

/// Who has more to tell keeps the latest: no host shall carry the contacts of a whole day.
constexpr std::size_t kMostEvents = 100'000;

/// Whether the scenario changes this body so in this step; otherwise only requests do.
bool is_scheduled(const sim::EngineSpec& spec, std::uint64_t step,
                  const sim::ResizedRobot& resized) {
  return std::ranges::any_of(spec.changes, [&](const sim::ScheduledChange& scheduled) {
    if (scheduled.step != step || scheduled.robot != resized.robot) return false;
    if (scheduled.changes.empty()) return false;
    const sim::ParameterChange& last = scheduled.changes.back();
    const double* const scale = std::get_if<double>(&last.value);
    return last.part == sim::ParameterChange::Part::kBody && scale != nullptr &&
           *scale == resized.scale;
  });
}

}  // namespace

WorldAccount::WorldAccount(const config::ExpandedScenario& scenario, const sim::EngineSpec& spec)
    : scenario_(scenario), spec_(spec) {}

void WorldAccount::begin_at(std::uint64_t step) {
  begun_ = true;
  told_ = {};
  told_.first_step = step;
  scales_.clear();
  const auto& check = scenario_.scenario.checks.capture;
  if (check) capture_.emplace(*check, scenario_);
}

void WorldAccount::note(std::span<const sim::Event> events) {
  if (told_.events.size() + events.size() > kMostEvents) {
    told_.events.clear();
    told_.first_step = told_.next_step;
  }
  told_.events.insert(told_.events.end(), events.begin(), events.end());
}

void WorldAccount::take(const sim::WorldStep& world, const sim::AuthorityState& authority) {
  if (!begun_ || world.step != told_.next_step + 1) begin_at(world.step);
  told_.next_step = world.step;
  if (world.step > told_.first_step) note(authority.done);
  // The step after the last world is not computed.
  if (world.last) return;
  take_sizes(world);
  if (!world.obstacles.empty()) note(obstacle_events(world));
}

void WorldAccount::take_sizes(const sim::WorldStep& world) {
  for (const sim::ResizedRobot& resized : world.resized) {
    double& scale = scales_.try_emplace(resized.robot.value(), 1.0).first->second;
    const bool by_hand = !is_scheduled(spec_, world.step, resized);
    const sim::Event changed = sim::resized_event(world.step, resized, scale, by_hand);
    note({&changed, 1});
    scale = resized.scale;
  }
}

void WorldAccount::after_step(sim::Engine& engine) {
  if (!capture_) return;
  capture_->after_step(engine);
  looked_at_ = engine.steps_done() - 1;
  note(capture_->events());
}

WorldFacts WorldAccount::facts() const {
  WorldFacts facts = told_;
  // The authority may never have finished the step that was the last one here.
  std::erase_if(facts.events,
                [&facts](const sim::Event& event) { return event.step >= facts.next_step; });
  if (!capture_) return facts;
  CaptureWatch seen = *capture_;
  if (looked_at_ == facts.next_step) seen.forget_last_look();
  facts.capture = seen.facts();
  return facts;
}

}  // namespace rave::runtime
