// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/ddsrt/log.h>

#include <mutex>
#include <string>
#include <vector>

namespace rave::bus {

/// Catches what Cyclone DDS would print: a library does not print. There is one such sink in a
/// process, so with several buses the one opened last has it. Owner: a bus; lines may come from any
/// thread.
class CycloneLog {
 public:
  CycloneLog();
  CycloneLog(const CycloneLog&) = delete;
  CycloneLog& operator=(const CycloneLog&) = delete;
  ~CycloneLog();

  /// The lines since the last call; of a flood the first kMost.
  [[nodiscard]] std::vector<std::string> take();

  static constexpr std::size_t kMost = 100;

 private:
  static void receive(void* self, const dds_log_data_t* data);

  std::mutex mutex_;
  std::vector<std::string> lines_;
};

}  // namespace rave::bus
