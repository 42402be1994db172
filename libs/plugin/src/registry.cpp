// SPDX-License-Identifier: Apache-2.0
#include "rave/plugin/registry.hpp"

#include "rave/base/word_table.hpp"

namespace rave {
namespace {

constexpr WordTable<DriverKind, 10> kKinds = {{
    {"sensor", DriverKind::kSensor},
    {"virtual sensor", DriverKind::kVirtualSensor},
    {"hybrid sensor", DriverKind::kHybridSensor},
    {"actuator", DriverKind::kActuator},
    {"virtual actuator", DriverKind::kVirtualActuator},
    {"controller", DriverKind::kController},
    {"communicator", DriverKind::kCommunicator},
    {"transmitter", DriverKind::kTransmitter},
    {"program", DriverKind::kProgram},
    {"device", DriverKind::kDevice},
}};

constexpr WordTable<DriverClock, 3> kClocks = {{
    {"stepped", DriverClock::kStepped},
    {"live", DriverClock::kLive},
    {"stepped or live", DriverClock::kEither},
}};

constexpr WordTable<SampleTiming, 3> kTimings = {{
    {"at the pace of the device", SampleTiming::kUnknown},
    {"periodic", SampleTiming::kPeriodic},
    {"when something happens", SampleTiming::kEvents},
}};

}  // namespace

std::string_view to_string(DriverKind kind) noexcept { return kKinds.of(kind, "unknown"); }

std::string_view to_string(DriverClock clock) noexcept { return kClocks.of(clock, "unknown"); }

std::string_view to_string(SampleTiming timing) noexcept { return kTimings.of(timing, "unknown"); }

}  // namespace rave
