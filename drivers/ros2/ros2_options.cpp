// SPDX-License-Identifier: Apache-2.0
#include "ros2/ros2_options.hpp"

#include "rave/math/scalar.hpp"
#include "rave/ros2/names.hpp"

namespace rave::ros2_driver {
namespace {

ros2::NodeForm form_of(std::string_view word) {
  if (word == "humble") return ros2::NodeForm::kHumble;
  return word == "iron" ? ros2::NodeForm::kIron : ros2::NodeForm::kNone;
}

}  // namespace

Result<DeviceOptions> read_options(const Params& params, const char* robot) {
  DeviceOptions options;
  options.network.name = "rave/" + std::string(robot).substr(0, 50);
  options.network.domain = static_cast<std::uint32_t>(params.integer("domain"));
  options.network.interface = params.text("interface");
  options.network.peers = dds_network::split_peers(params.text("peers"));
  options.network.multicast = dds_network::multicast_of(params.text("multicast"));
  options.network.nodes = form_of(params.text("nodes"));
  options.name_space = params.text("namespace");
  options.network.node_namespace = options.name_space;
  options.latency_s = params.number("latency_s");
  options.start_timeout_s = params.number("start_timeout_s");
  options.lost_after_s = params.number("lost_after_s");
  // Any topic in it shows whether the namespace is one.
  RAVE_TRY(ros2::whole_name(options.name_space, "topic"));
  return options;
}

Doubt read_doubt(const Params& params) {
  const double position_m = params.number("position_sigma_m");
  const double heading_rad = deg_to_rad(params.number("heading_sigma_deg"));
  return {position_m * position_m, heading_rad * heading_rad};
}

}  // namespace rave::ros2_driver
