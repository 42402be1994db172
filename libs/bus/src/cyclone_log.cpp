// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/cyclone_log.hpp"

#include <string_view>
#include <utility>

namespace rave::bus {

CycloneLog::CycloneLog() { dds_set_log_sink(&CycloneLog::receive, this); }

CycloneLog::~CycloneLog() { dds_set_log_sink(nullptr, nullptr); }

std::vector<std::string> CycloneLog::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(lines_, {});
}

void CycloneLog::receive(void* self, const dds_log_data_t* data) {
  auto& log = *static_cast<CycloneLog*>(self);
  std::string_view line(data->message, data->size);
  while (line.ends_with('\n')) line.remove_suffix(1);
  const std::lock_guard lock(log.mutex_);
  if (log.lines_.size() < kMost) log.lines_.emplace_back(line);
}

}  // namespace rave::bus
