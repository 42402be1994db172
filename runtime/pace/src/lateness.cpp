// SPDX-License-Identifier: Apache-2.0
#include "rave/pace/lateness.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rave::runtime {
// The time between two deadlines is divided among the parts that used it: each call of did() and
// worked() books the time since the last booking. Times are collected until a step is on time. A
// missed deadline is blamed on the part with the most, so a backlog of many steps is blamed on what
// caused it and not on what runs when it is noticed.
namespace {

constexpr std::array<std::string_view, 5> kParts = {"machine", "requests", "exchange", "record",
                                                    "observers"};

std::int64_t ns_of(Lateness::Clock::duration duration) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
}

std::string_view name_of(std::size_t part) noexcept {
  return part < sim::kPhases ? to_string(static_cast<sim::Phase>(part))
                             : kParts[part - sim::kPhases];
}

}  // namespace

std::string_view LatenessFacts::worst_phase() const noexcept {
  const auto most = std::ranges::max_element(blame, {}, [](const auto& one) { return one.second; });
  return most == blame.end() ? std::string_view() : std::string_view(most->first);
}

LatenessFacts& LatenessFacts::operator+=(const LatenessFacts& other) {
  deadlines += other.deadlines;
  missed += other.missed;
  worst_ns = std::max(worst_ns, other.worst_ns);
  stops += other.stops;
  for (const auto& [phase, count] : other.blame) blame[phase] += count;
  return *this;
}

bool is_late_phase(std::string_view name) noexcept {
  for (std::size_t part = 0; part < sim::kPhases + kParts.size(); ++part) {
    if (name == name_of(part)) return true;
  }
  return false;
}

std::string lateness_text(const LatenessFacts& facts) {
  if (facts.missed == 0 && facts.stops == 0) return fmt::format("all {} met", facts.deadlines);
  std::string text =
      fmt::format("{} of {} missed ({:.1f} %), by up to {:.3f} s", facts.missed, facts.deadlines,
                  facts.missed_pct(), static_cast<double>(facts.worst_ns) * 1e-9);
  std::string_view between = ": ";
  for (const auto& [phase, count] : facts.blame) {
    text += fmt::format("{}{} {}", between, phase, count);
    between = ", ";
  }
  if (facts.stops > 0) text += fmt::format("; real robots were stopped {}x", facts.stops);
  return text;
}

void Lateness::woke(Clock::time_point due, Clock::time_point now) noexcept {
  // Idle time is not attributed to any part.
  since_ = std::max(since_, due);
  due_ = due;
  did(Part::kMachine, now);
}

void Lateness::did(Part part, Clock::time_point now) noexcept {
  // Time before the first step belongs to no step.
  if (due_ == Clock::time_point{}) since_ = now;
  spent_ns_[sim::kPhases + static_cast<std::size_t>(part)] +=
      std::max<std::int64_t>(0, ns_of(now - since_));
  since_ = std::max(since_, now);
}

void Lateness::worked(const sim::PhaseTimes& total, Clock::time_point now) noexcept {
  std::int64_t sum_ns = 0;
  for (std::size_t p = 0; p < sim::kPhases; ++p) {
    // The engine gives sums since the start.
    const std::int64_t took_ns = total.ns[p] - worked_.ns[p];
    spent_ns_[p] += took_ns;
    sum_ns += took_ns;
  }
  // An observer inside the engine has been counted separately; its time is also contained in the
  // next ingest and is subtracted there.
  const std::int64_t twice_ns = sum_ns - std::max<std::int64_t>(0, ns_of(now - since_));
  if (twice_ns > 0) spent_ns_[static_cast<std::size_t>(sim::Phase::kIngest)] -= twice_ns;
  worked_ = total;
  since_ = std::max(since_, now);
}

bool Lateness::done(Clock::time_point now) {
  if (period_ <= Clock::duration::zero()) return true;
  ++facts_.deadlines;
  const Clock::duration late = behind(now);
  // On a grid: a late step does not move the deadlines after it.
  due_ += period_;
  if (late > Clock::duration::zero()) {
    miss(1, late);
    return false;
  }
  spent_ns_.fill(0);
  return true;
}

void Lateness::end(Clock::time_point last, Clock::time_point now) {
  if (period_ <= Clock::duration::zero() || due_ == Clock::time_point{}) return;
  // Steps that were due and never made count as missed when the run ends, but not those after its
  // last one.
  const auto until = std::min(now, last + period_);
  if (until <= due_ + period_) return;
  // The first of the missed deadlines is the longest overdue.
  // One tick less, because a step whose deadline is exactly now is not late yet.
  const auto count = static_cast<std::uint64_t>((until - due_ - Clock::duration(1)) / period_);
  facts_.deadlines += count;
  if (count > 0) miss(count, until - (due_ + period_));
}

Lateness::Clock::duration Lateness::age(Clock::time_point now) const noexcept {
  const bool counts = period_ > Clock::duration::zero() && due_ != Clock::time_point{};
  return counts ? std::max(Clock::duration::zero(), now - due_) : Clock::duration::zero();
}

Lateness::Clock::duration Lateness::behind(Clock::time_point now) const noexcept {
  return std::max(Clock::duration::zero(), age(now) - period_);
}

std::string_view Lateness::busiest() const noexcept {
  const auto most = std::max_element(spent_ns_.begin(), spent_ns_.end());
  return name_of(static_cast<std::size_t>(most - spent_ns_.begin()));
}

void Lateness::miss(std::uint64_t count, Clock::duration by) {
  facts_.missed += count;
  facts_.worst_ns = std::max(facts_.worst_ns, ns_of(by));
  facts_.blame[std::string(busiest())] += count;
}

}  // namespace rave::runtime
