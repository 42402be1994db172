// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include "rave/base/result.hpp"
#include "rave/plugin/param_set.hpp"
#include "rave/robot/interface.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave::sim {

/// Runs a function of a plug-in that returns 0 or sets an ErrorText.
template <class Call>
Status called(Call&& call) {
  ErrorText error;
  if (call(&error) == 0) return {};
  return fail(ErrorCode::kPlugin, "{}", error.text);
}

/// The data for starting a driver or program, with its parameters and the services of its host.
template <class Setup>
Setup setup_with(const plugin::ParamSet& params, HostServices host = {}) {
  Setup setup;
  setup.host = host;
  setup.params = params.values().data();
  setup.param_count = params.values().size();
  return setup;
}

/// Takes the sample that `item` asks for. Its count is no more than the capacity afterwards.
inline Status sample_one(const VirtualSensorOps& ops, const void* instance, const WorldView& world,
                         const SampleItem& item) {
  std::uint8_t failed = 0;
  ErrorText error;
  ops.sample(instance, &world, &item, 1, &failed, &error);
  item.header->count = std::min(item.header->count, item.capacity);
  if (failed == 0) return {};
  return fail(ErrorCode::kPlugin, "{}", error.text);
}

/// What a driver reports of itself: a JSON object.
template <class Ops>
std::string report_of(const Ops& ops, void* instance) {
  std::string text;
  ops.report(instance, &text, [](void* context, const char* part, std::uint64_t size) {
    static_cast<std::string*>(context)->append(part, size);
  });
  return text;
}

}  // namespace rave::sim
