// SPDX-License-Identifier: Apache-2.0
// Validation of what monitors ask for, and of what they receive.
#include <algorithm>

#include "rave/bus/validate.hpp"
#include "sample_checks.hpp"

namespace rave::bus {
namespace {

constexpr std::uint8_t kParts = 3;
/// More values than any kind of reading has.
constexpr std::uint32_t kMostFields = 64;

Status check_reading(std::size_t index, const rave_wire_Reading& reading) {
  RAVE_TRY(check_id(fmt::format("entries[{}].robot", index), reading.robot));
  if (reading.part >= kParts) {
    return invalid("entries[{}].part is {}, above 2", index, reading.part);
  }
  if (reading.fields > kMostFields) {
    return invalid("entries[{}].fields is {}, more than {}", index, reading.fields, kMostFields);
  }
  return check_time(fmt::format("entries[{}].stamp_ns", index), reading.stamp_ns);
}

}  // namespace

Status validate(const Look& sample) {
  RAVE_TRY(check_writer(sample));
  for (const rave_wire_LookedAt& looked : elements(sample.sensors)) {
    RAVE_TRY(check_id("sensors.robot", looked.robot));
  }
  for (const std::uint32_t robot : elements(sample.maps)) RAVE_TRY(check_id("maps", robot));
  for (const rave_wire_Probe& probe : elements(sample.probes)) {
    RAVE_TRY(check_id("probes.robot", probe.robot));
    if ((probe.number & 0x8000'0000U) == 0) {
      return invalid("probes.number is {}, which is a sensor's", probe.number);
    }
    RAVE_TRY(check_label("probes.block", probe.block, true));
  }
  return {};
}

Status validate(const Readings& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_id("host", sample.host));
  const auto readings = elements(sample.entries);
  std::uint64_t numbers = 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    RAVE_TRY(check_reading(i, readings[i]));
    numbers += std::uint64_t{readings[i].rows} * readings[i].fields;
  }
  if (numbers == sample.values._length) return {};
  return invalid("values has {} entries for readings of {}", sample.values._length, numbers);
}

Status validate(const RunEvents& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_id("host", sample.host));
  for (const rave_wire_RunEvent& event : elements(sample.events)) {
    RAVE_TRY(check_time("events.time_ns", event.time_ns));
    RAVE_TRY(check_label("events.text", event.text, false));
  }
  return {};
}

}  // namespace rave::bus
