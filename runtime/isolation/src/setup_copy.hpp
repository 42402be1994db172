// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/robot/program.hpp"

namespace rave::isolation {

/// Which plug-in and program a child must run.
struct Order {
  std::string plugin;
  std::string program;
  std::int64_t parent = 0;  ///< Process id of the host.
};

/// Order and setup as bytes, without `setup.host`.
[[nodiscard]] std::string encode_setup(const Order& order, const ProgramSetup& setup);

/// New parameters and the radius of the body as bytes.
[[nodiscard]] std::string encode_update(std::span<const ParamValue> params, double radius_m);

/// A setup decoded from bytes, which owns all data that it points to.
class SetupCopy {
 public:
  /// Errors: kParse.
  [[nodiscard]] static Result<std::unique_ptr<SetupCopy>> decode(std::string_view bytes);
  SetupCopy(const SetupCopy&) = delete;
  SetupCopy& operator=(const SetupCopy&) = delete;

  [[nodiscard]] const Order& order() const noexcept { return order_; }
  /// Points into this object.
  [[nodiscard]] const ProgramSetup& setup() const noexcept { return setup_; }
  /// Copies new parameters and radius into the setup. Errors: kParse; then nothing has changed.
  Status update(std::string_view bytes);
  /// Undoes the last update.
  void revert();
  void set_host(const HostServices& host) noexcept { setup_.host = host; }

 private:
  SetupCopy() = default;
  class Reader;
  Order order_;
  ProgramSetup setup_;
  std::vector<SensorInfo> sensors_;
  std::vector<ControllerInfo> controllers_;
  void use(std::vector<ParamValue> params, double radius_m);
  std::vector<CommunicatorInfo> communicators_;
  std::vector<const char*> robot_names_;
  std::vector<ParamValue> params_;
  std::vector<ParamValue> params_before_;
  double radius_before_m_ = 0;
  std::deque<std::string> texts_;
  std::deque<std::vector<double>> lists_;
};

}  // namespace rave::isolation
