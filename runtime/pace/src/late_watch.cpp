// SPDX-License-Identifier: Apache-2.0
#include "rave/pace/late_watch.hpp"

#include "rave/sim/guard.hpp"

namespace rave::runtime {
namespace {

/// From this delay on the log reports late steps; shorter delays are common.
constexpr auto kNews = std::chrono::milliseconds(500);
/// The largest age of the status that others see.
constexpr auto kStatusInterval = std::chrono::milliseconds(100);

double seconds(Lateness::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

LateWatch::LateWatch(Clock::duration period, LogSink& log, RunControl* control)
    : period_(period), log_(log), control_(control), lateness_(period) {}

Duration LateWatch::age() const noexcept {
  return {
      std::chrono::duration_cast<std::chrono::nanoseconds>(lateness_.age(Clock::now())).count()};
}

void LateWatch::look(const sim::EngineSpec& spec, std::span<const sim::Event> events,
                     Duration world_age) {
  for (const sim::Event& event : events) {
    const bool lost = event.kind == sim::EventKind::kGuardStopped &&
                      event.detail == static_cast<std::uint32_t>(sim::GuardLimit::kWorldLost);
    if (!lost || spec.types[spec.robots[event.robot.value()].type].simulated) continue;
    // The guard stopped the robot for lack of a fresh world. That is the fault of this process only
    // if its own steps are at least as late as the world is old.
    const bool ours = lateness_.behind(Clock::now()) >= std::chrono::nanoseconds(world_age.ns);
    if (ours) lateness_.stopped();
  }
}

void LateWatch::step_done() {
  if (period_ <= Clock::duration::zero()) return;
  const auto now = Clock::now();
  // Read before done(), which moves on to the next deadline.
  last_ = lateness_.behind(now);
  behind_ = !lateness_.done(now);
  tell_change(last_);
  if (control_ == nullptr || now < next_status_) return;
  next_status_ = now + kStatusInterval;
  control_->refresh([this](RunStatus& shown) { shown.lateness = status(); });
}

void LateWatch::tell_change(Clock::duration late) {
  // Two thresholds, so that steps near the limit do not fill the log: reported above half a second,
  // and in time again without any delay.
  if (!told_ && late > kNews) {
    told_ = true;
    log_.warn("run", "steps are {:.2f} s late; most of the time is spent in `{}`", seconds(late),
              lateness_.busiest());
  } else if (told_ && !behind_) {
    told_ = false;
    log_.info("run", "steps are in time again");
  }
}

void LateWatch::end(Clock::time_point last) {
  lateness_.end(last, Clock::now());
  if (facts().missed == 0) return;
  log_.info("run", "deadlines of steps: {}", lateness_text(facts()));
}

std::optional<RunStatus::Lateness> LateWatch::status() const {
  if (period_ <= Clock::duration::zero()) return std::nullopt;
  const LatenessFacts& known = facts();
  return RunStatus::Lateness{known.deadlines, known.missed,
                             static_cast<double>(known.worst_ns) * 1e-9, seconds(last_),
                             std::string(known.worst_phase())};
}

std::vector<std::string> lateness_problems(const LatenessFacts& facts, double most_pct) {
  std::vector<std::string> problems;
  if (facts.missed_pct() > most_pct) {
    problems.push_back(fmt::format("more than {:g} % of the deadlines were missed: {}", most_pct,
                                   lateness_text(facts)));
  }
  if (facts.stops > 0) {
    problems.push_back(fmt::format(
        "real robots were stopped {}x because of late steps; the latest step was {:.2f} s late",
        facts.stops, static_cast<double>(facts.worst_ns) * 1e-9));
  }
  return problems;
}

}  // namespace rave::runtime
