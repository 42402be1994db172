// SPDX-License-Identifier: Apache-2.0
// Built once per fault; the good driver in it shows that one fault refuses the whole file.
#include <array>
#include <stdexcept>

#include "rave/robot/plugin_entry.hpp"

namespace {

constexpr int kOps = 0;
[[maybe_unused]] constexpr std::array<const char*, 2> kModes{"fast", "slow"};

constexpr rave::ParamSpec kGood = rave::number_param("gain", "", 1, 0, 2, "A gain.");
#if defined(FAULT_RANGE)
constexpr std::array kParams{kGood, rave::number_param("range_m", "m", 1, 3, 2, "A range.")};
#elif defined(FAULT_DEFAULT)
constexpr std::array kParams{kGood, rave::integer_param("count", 7, 1, 5, "A count.")};
#elif defined(FAULT_CHOICE)
constexpr std::array kParams{kGood, rave::choice_param("mode", "fats", kModes, "A mode.")};
#elif defined(FAULT_PARAM_TWICE)
constexpr std::array kParams{kGood, kGood};
#else
constexpr std::array kParams{kGood};
#endif

}  // namespace

#if defined(FAULT_UNREGISTERED)
RAVE_PLUGIN(TEST_NAME " ghost")
#else
RAVE_PLUGIN(TEST_NAME)
#endif
{
  const rave::Description good{
      .name = TEST_NAME, .version = "1.0", .summary = "A driver.", .params = kParams};
  [[maybe_unused]] rave::DriverInfo info = good.info(rave::DriverKind::kSensor, 0);
#if defined(FAULT_EMPTY_NAME)
  info.name = "";
#elif defined(FAULT_NO_SUMMARY)
  info.summary = "";
#elif defined(FAULT_THROWS)
  throw std::runtime_error("no device");
#endif
#if defined(FAULT_NULL_OPS)
  registry.add(info, nullptr);
#elif !defined(FAULT_NOTHING)
  registry.add(info, &kOps);
#endif
#if defined(FAULT_TWICE)
  registry.add(info, &kOps);
#elif defined(FAULT_UNLISTED)
  info.name = "stowaway";
  registry.add(info, &kOps);
#endif
}
