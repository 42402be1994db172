// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <string>
#include <utility>
#include <vector>

#include "live/run_port.hpp"

namespace rave::gui_server::testing {

/// A port to no run: it holds nothing, knows no robots, and refuses what it is asked. Tests
/// override what they look at.
class FakePort : public RunPort {
 public:
  [[nodiscard]] RunHold held() const override { return {}; }
  void hold(const TransportMessage& /*transport*/) override {}
  [[nodiscard]] std::string why_not_held() const override { return ""; }
  [[nodiscard]] std::vector<runtime::RunStatus::Robot> robots() const override { return {}; }
  [[nodiscard]] Result<std::future<Result<std::string>>> post(
      request::Request /*request*/) override {
    return fail(ErrorCode::kState, "no run");
  }
};

}  // namespace rave::gui_server::testing
