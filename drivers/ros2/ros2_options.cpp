// SPDX-License-Identifier: Apache-2.0
#include "ros2/ros2_options.hpp"

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
  dds_network::read_network(params, options.network);
  options.network.nodes = form_of(params.text("nodes"));
  options.name_space = params.text("namespace");
  options.network.node_namespace = options.name_space;
  options.timing = line::read_timing(params);
  // Any topic in the namespace shows whether its name is valid.
  RAVE_TRY(ros2::whole_name(options.name_space, "topic"));
  return options;
}

}  // namespace rave::ros2_driver
