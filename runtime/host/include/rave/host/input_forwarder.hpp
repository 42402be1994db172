// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "rave/base/result.hpp"
#include "rave/control/order_words.hpp"
#include "rave/control/run_control.hpp"

namespace rave::runtime {

/// Passes on what people ask of robots that run here, where another process numbers the inputs of
/// the run. Belongs to the thread of the run.
class InputForwarder {
 public:
  virtual ~InputForwarder() = default;

  /// What it passes on: stops, releases, arming and orders.
  [[nodiscard]] static bool is_for(const request::Action& action) noexcept {
    return request::is_hold(action) || request::is_order(action);
  }
  /// Checks a request as far as this process knows, and passes it on. Returns a description of what
  /// will be done. Errors: those of the run.
  virtual Result<std::string> give(const request::Request& request) = 0;
  /// The last request that was passed on since the last call; none if there was nothing to do.
  [[nodiscard]] virtual std::optional<std::uint64_t> take_given() = 0;
  /// Whether a user drives the robot; counts requests that are not done yet.
  [[nodiscard]] virtual bool is_driven(const std::string& robot) const = 0;
  /// Answers `asked` when the request `given` is done or refused; `text` is the description.
  virtual void await(std::uint64_t given, RunControl::Asked asked, std::string text) = 0;
};

}  // namespace rave::runtime
