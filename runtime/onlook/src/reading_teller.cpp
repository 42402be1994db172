// SPDX-License-Identifier: Apache-2.0
#include "rave/onlook/reading_teller.hpp"

#include "rave/bus/sequence.hpp"
#include "rave/onlook/command_row.hpp"
#include "rave/onlook/reading_rows.hpp"
#include "rave/onlook/sensor_parts.hpp"

namespace rave::onlook {

rave_wire_Reading* ReadingTeller::begin(const LookedAt& looked, std::uint8_t part,
                                        std::uint32_t sequence, std::size_t numbers) {
  const auto [told, fresh] = told_.try_emplace({looked.slot, looked.sensor, part}, 0);
  if (told->second == sequence) return nullptr;
  if (readings_.size() == rave_wire_kMaxReadings ||
      values_.size() + numbers > rave_wire_kMaxReadingValues) {
    ++left_out_;
    return nullptr;
  }
  told->second = sequence;
  rave_wire_Reading& reading = readings_.emplace_back();
  reading.robot = looked.slot;
  reading.sensor = looked.sensor;
  reading.part = part;
  return &reading;
}

void ReadingTeller::put_part(const LookedAt& looked, std::uint8_t part, ReadingKind kind,
                             const SampleHeader* header, const void* records) {
  if (header == nullptr || header->sequence == 0) return;
  const std::size_t numbers = std::size_t{header->count} * field_count(kind);
  rave_wire_Reading* const reading = begin(looked, part, header->sequence, numbers);
  if (reading == nullptr) return;
  reading->stamp_ns = header->stamp_ns;
  reading->fields = field_count(kind);
  reading->rows = add_rows(
      kind, header->count,
      {static_cast<const std::byte*>(records), header->count * record_size(kind)}, values_);
}

void ReadingTeller::put_commands(const sim::Engine& engine, const LookedAt& looked) {
  const auto row = command_row(engine, RobotId(looked.slot));
  if (!row) return;
  const auto step = static_cast<std::uint32_t>(engine.steps_done());
  rave_wire_Reading* const reading = begin(looked, 0, step, row->size());
  if (reading == nullptr) return;
  reading->stamp_ns = engine.time().ns;
  reading->fields = kCommandFields;
  reading->rows = 1;
  values_.insert(values_.end(), row->begin(), row->end());
}

void ReadingTeller::put(const sim::Engine& engine, const LookedAt& looked, bool parts) {
  if (looked.sensor == kCommandsOf) return put_commands(engine, looked);
  for_each_part(engine, RobotId(looked.slot), looked.sensor, parts,
                [&](std::uint8_t part, ReadingKind kind, const SampleHeader* header,
                    const void* records) { put_part(looked, part, kind, header, records); });
}

void ReadingTeller::tell(const sim::Engine& engine, const Asked& asked, probe::Probes& probes,
                         Clock::time_point now, int slower) {
  if (now < next_) return;
  next_ = now + kInterval * slower;
  if (now >= again_at_) {
    told_.clear();
    again_at_ = now + kAgain;
  }
  readings_.clear();
  values_.clear();
  left_out_ = 0;
  for (const LookedAt& looked : asked.sensors) put(engine, looked, asked.parts);
  probes.sample(engine);
  for (const auto& [key, sensor] : probes.all()) {
    if (!sensor) continue;
    put_part({key.first, key.second}, 0, sensor->info().kind, &sensor->header(), sensor->records());
  }
  if (readings_.empty() && left_out_ == 0) return;
  bus::Readings message{};
  message.host = host_;
  message.left_out = left_out_;
  bus::borrow(message.entries, readings_);
  bus::borrow(message.values, values_);
  // A monitor that is too slow misses some messages.
  static_cast<void>(writer_.write(message));
}

}  // namespace rave::onlook
