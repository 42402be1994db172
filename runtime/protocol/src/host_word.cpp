// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/host_word.hpp"

#include <array>
#include <span>

#include "rave/base/control_characters.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/protocol/run_state.hpp"

namespace rave::lock_step {

void HostWord::describe(std::string scenario, std::uint64_t steps, double step_s) {
  scenario_ = std::move(scenario);
  steps_ = steps;
  step_s_ = step_s;
}

void HostWord::place_manager(std::string machine, std::string folder) {
  manager_machine_ = std::move(machine);
  manager_folder_ = std::move(folder);
}

void HostWord::measure(std::uint64_t step, Clock::time_point now) {
  const auto passed = now - measured_at_;
  if (passed < kMeasure) return;
  // Steps may go back if the host rejoins a run, and the first call has no interval yet: the speed
  // is then unknown, not negative.
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
  // The speed is measured before, so that a monitor that appears later receives it at once.
  if (writer_.readers() > 0) write(facts);
}

void HostWord::tell_end(bool good, std::uint64_t step, std::string_view text) {
  if (step_s_ <= 0) return;
  speed_ = 0;
  Facts facts{good ? rave_wire_RUN_ENDED : rave_wire_RUN_FAILED, step, text};
  // At the end the manager may have gone already, which is no loss.
  facts.manager_here = true;
  write(facts);
}

void HostWord::write(const Facts& facts) {
  const std::string text = without_control_characters(facts.text, " ");
  std::array seen{process_sight(host_, name_, rave_wire_HOST_RUNS, facts.step),
                  process_sight(rave_wire_kNone, "environment manager",
                                facts.manager_here ? rave_wire_HOST_RUNS : rave_wire_HOST_LOST, 0)};
  bus::put_text(seen[1].machine, manager_machine_);
  bus::put_text(seen[1].folder, manager_folder_);
  bus::HostRun message{};
  fill(message, {scenario_, facts.phase, facts.step, steps_, step_s_, speed_, text},
       std::span(seen).first(facts.managed ? 2 : 1));
  // A monitor that is too slow misses some messages.
  static_cast<void>(writer_.write(message));
}

}  // namespace rave::lock_step
