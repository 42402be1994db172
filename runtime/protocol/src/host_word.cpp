// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/host_word.hpp"

#include <array>

#include "rave/base/control_characters.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::lock_step {

Result<HostWord> HostWord::create(bus::Bus& bus, std::uint32_t host, std::string name) {
  RAVE_TRY_ASSIGN(auto writer, bus::Writer<bus::HostRun>::create(bus));
  return HostWord(std::move(writer), host, std::move(name));
}

void HostWord::describe(std::string scenario, std::uint64_t steps, double step_s) {
  scenario_ = std::move(scenario);
  steps_ = steps;
  step_s_ = step_s;
}

void HostWord::measure(std::uint64_t step, Clock::time_point now) {
  const auto passed = now - measured_at_;
  if (passed < kMeasure) return;
  const bool known = measured_at_ != Clock::time_point() && step >= measured_step_;
  const double passed_s = std::chrono::duration<double>(passed).count();
  speed_ = known ? static_cast<double>(step - measured_step_) * step_s_ / passed_s : 0;
  measured_at_ = now;
  measured_step_ = step;
}

void HostWord::tell(const Facts& facts) {
  const auto now = Clock::now();
  if (now < next_ || step_s_ <= 0) return;
  next_ = now + kInterval;
  measure(facts.step, now);
  if (writer_.readers() > 0) write(facts);
}

void HostWord::tell_end(bool good, std::uint64_t step, std::string_view text) {
  if (step_s_ <= 0) return;
  speed_ = 0;
  Facts facts{good ? rave_wire_RUN_ENDED : rave_wire_RUN_FAILED, step, text};
  facts.manager_here = true;
  write(facts);
}

void HostWord::write(const Facts& facts) {
  bus::HostRun message{};
  bus::put_text(message.scenario, scenario_);
  message.phase = facts.phase;
  message.step = facts.step;
  message.steps = steps_;
  message.step_s = step_s_;
  message.speed = speed_;
  bus::put_text(message.text, without_control_characters(facts.text, " "));
  std::array<rave_wire_HostSight, 2> seen{};
  seen[0].host = host_;
  bus::put_text(seen[0].name, name_);
  seen[0].phase = rave_wire_HOST_RUNS;
  seen[0].step = facts.step;
  seen[0].bound_s = -1;
  seen[1].host = rave_wire_kNone;
  bus::put_text(seen[1].name, "environment manager");
  seen[1].phase = facts.manager_here ? rave_wire_HOST_RUNS : rave_wire_HOST_LOST;
  seen[1].bound_s = -1;
  bus::borrow(message.hosts, seen);
  if (!facts.managed) message.hosts._length = 1;
  // A monitor that is too slow misses some messages.
  static_cast<void>(writer_.write(message));
}

}  // namespace rave::lock_step
