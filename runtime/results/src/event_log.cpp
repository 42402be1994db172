// SPDX-License-Identifier: Apache-2.0
#include "rave/results/event_log.hpp"

#include <fmt/format.h>

#include "rave/observe/event_words.hpp"
#include "rave/observe/run_observer.hpp"

namespace rave::runtime {
namespace {

LogLevel level_of(sim::EventKind kind) {
  switch (kind) {
    case sim::EventKind::kProgramFailed:
    case sim::EventKind::kDriverFailed:
    case sim::EventKind::kChangeRefused:
    case sim::EventKind::kHandOverRefused:
      return LogLevel::kError;
    case sim::EventKind::kReleased:
    case sim::EventKind::kArmed:
    case sim::EventKind::kChanged:
    case sim::EventKind::kCaptured:
    case sim::EventKind::kObstacleAdded:
    case sim::EventKind::kObstacleMoved:
    case sim::EventKind::kObstacleRemoved:
    case sim::EventKind::kHandedOver:
    case sim::EventKind::kShadowReset:
    case sim::EventKind::kOrdered:
    case sim::EventKind::kSaid:
    case sim::EventKind::kPlaced:
    case sim::EventKind::kLease:
    case sim::EventKind::kScenario:
      return LogLevel::kInfo;
    // Also a kind of event that is added later is a warning, so it is not overlooked.
    default:
      return LogLevel::kWarning;
  }
}

}  // namespace

void tell_events(const sim::Engine& engine, std::span<const sim::Event> events, LogSink* log,
                 std::vector<sim::Event>& all) {
  const sim::EngineSpec& spec = engine.spec();
  for (const sim::Event& event : events) {
    all.push_back(event);
    // Contacts are frequent in a crowd and stay out of the log; the other events should be seen at
    // once.
    if (log == nullptr || event.kind == sim::EventKind::kContact) continue;
    const std::string who =
        fmt::format("{}{}", event.robot.valid() ? "robot " : "", subject_of(spec, event));
    log->write(level_of(event.kind), who,
               fmt::format("{:.2f} s: {}: {}", engine.time().seconds(), to_string(event.kind),
                           event.text));
  }
}

std::string events_log(const sim::EngineSpec& spec, const BodyKinds& kinds,
                       const std::vector<sim::Event>& events) {
  std::string text;
  for (const sim::Event& event : events) {
    text += fmt::format("{:10.3f} s  {:<16} {:<14} {}\n",
                        static_cast<double>(event.step) * spec.step.seconds(),
                        subject_of(spec, event), to_string(event.kind), words_of(kinds, event));
  }
  return text;
}

}  // namespace rave::runtime
