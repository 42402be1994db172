// SPDX-License-Identifier: Apache-2.0
// Opens bytes as a record and reads all that is in it.
#include <cstddef>
#include <cstdint>
#include <span>

#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_messages.hpp"
#include "rave/record/run_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::record;
  McapReaderOptions options;
  options.max_chunk_bytes = 1 << 16;
  const auto reader =
      McapReader::open_memory(std::as_bytes(std::span(data, size)), "fuzz", options);
  if (!reader) return 0;
  // Many indexes of one chunk are allowed; a bound on the work is not the reader's to set.
  if (reader->chunks().size() > 100) return 0;
  MessageCursor cursor = reader->messages();
  for (int i = 0; i < 2000; ++i) {
    const auto message = cursor.next();
    if (!message) continue;
    if (!*message) break;
    const auto bytes = (*message)->bytes;
    static_cast<void>(decode_run(bytes));
    static_cast<void>(decode_end(bytes));
    static_cast<void>(decode_poses(bytes));
    static_cast<void>(decode_percepts(bytes));
    static_cast<void>(decode_commands(bytes));
    static_cast<void>(decode_input(bytes));
    static_cast<void>(decode_chat(bytes));
    static_cast<void>(decode_shadow(bytes));
    static_cast<void>(decode_variances(bytes));
    static_cast<void>(decode_actuators(bytes));
    static_cast<void>(decode_hash(bytes));
    static_cast<void>(decode_radio(bytes));
    static_cast<void>(decode_event(bytes));
    static_cast<void>(decode_console(bytes));
  }
  for (const auto& attachment : reader->attachments()) {
    static_cast<void>(reader->read_attachment(attachment));
  }
  for (const auto& metadata : reader->metadata())
    static_cast<void>(reader->read_metadata(metadata));
  static_cast<void>(reader->check());
  if (const auto run = read_run_info(*reader)) {
    for (const RecordedSensor& sensor : run->sensors) {
      static_cast<void>(read_samples(*reader, sensor.robot, sensor.sensor, PerceptPart::kResult));
    }
  }
  return 0;
}
