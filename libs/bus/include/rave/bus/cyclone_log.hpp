// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/ddsrt/log.h>

#include <mutex>
#include <string>
#include <vector>

namespace rave::bus {

/// Collects the log lines of Cyclone DDS instead of printing them. Cyclone DDS has one sink per
/// process, so with several buses the one opened last receives them. Owner: a bus; lines may arrive
/// from any thread.
class CycloneLog {
 public:
  CycloneLog();
  CycloneLog(const CycloneLog&) = delete;
  CycloneLog& operator=(const CycloneLog&) = delete;
  ~CycloneLog();

  /// The lines since the last call, at most kMost; later ones are dropped.
  [[nodiscard]] std::vector<std::string> take();

  static constexpr std::size_t kMost = 100;

 private:
  static void receive(void* self, const dds_log_data_t* data);

  std::mutex mutex_;
  std::vector<std::string> lines_;
};

}  // namespace rave::bus
