// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/bus.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/step_messages.hpp"

namespace rave::cli_test {

/// A process that fits in a run in lock-step, takes the slot of a host, and says what it likes.
class WrongHost {
 public:
  /// `apart`: the words that keep a test's run apart.
  [[nodiscard]] static Result<std::unique_ptr<WrongHost>> open(
      const bus::RunId& run, const std::vector<std::string>& apart, std::uint32_t host);

  /// Learns from the environment manager what fits, and says that it does; false until it is there.
  bool introduce();
  /// `epoch`: of the manager that it answers; 0: of none.
  Status say(const sim::HostReport& report, std::uint64_t epoch = 0);

 private:
  WrongHost(std::uint32_t host, std::unique_ptr<bus::Bus> bus, bus::Reader<bus::HostInfo> infos,
            bus::Writer<bus::HostInfo> own_info, bus::Writer<bus::HostReport> reports)
      : host_(host),
        bus_(std::move(bus)),
        infos_(std::move(infos)),
        own_info_(std::move(own_info)),
        reports_(std::move(reports)) {}

  std::uint32_t host_;
  std::unique_ptr<bus::Bus> bus_;
  bus::Reader<bus::HostInfo> infos_;
  bus::Writer<bus::HostInfo> own_info_;
  bus::Writer<bus::HostReport> reports_;
  lock_step::ReportMessage message_;
};

}  // namespace rave::cli_test
