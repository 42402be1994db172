// SPDX-License-Identifier: Apache-2.0
#include "probe_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "rave/base/control_characters.hpp"

namespace rave::gui_server {
namespace {

constexpr double kFarthestMount_m = 100;
constexpr std::size_t kMostParameters = 64;
constexpr std::size_t kMostInList = 64;
constexpr std::size_t kLongestProbeName = 64;
constexpr std::size_t kLongestProbeText = 256;

bool is_plain_name(std::string_view name) {
  return !name.empty() && name.size() <= kLongestProbeName &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '-' || c == '_';
         });
}

Result<std::string> plain_name(Members& members, const char* member) {
  RAVE_TRY_ASSIGN(std::string name, members.word(member));
  if (is_plain_name(name)) return name;
  return fail(ErrorCode::kParse, "`{}`: expected letters, digits, - and _", member);
}

bool is_finite(const PageJson& value) {
  return value.is_number() && std::isfinite(value.get<double>());
}

/// A value as a file has it on one line.
Result<std::string> value_text(const std::string& name, const PageJson& value) {
  if (value.is_boolean() || is_finite(value)) return value.dump();
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    if (text.size() <= kLongestProbeText && !has_control_characters(text)) return value.dump();
  }
  const bool list = value.is_array() && value.size() <= kMostInList &&
                    std::all_of(value.begin(), value.end(), is_finite);
  if (list) return value.dump();
  return fail(ErrorCode::kParse,
              "`params.{}`: expected a number, true, false, a short text or a list of numbers",
              name);
}

Status take_params(const PageJson& params, ProbeRequest& request) {
  if (!params.is_object() || params.size() > kMostParameters) {
    return fail(ErrorCode::kParse, "`params`: expected an object");
  }
  for (const auto& [name, value] : params.items()) {
    if (!is_plain_name(name)) return fail(ErrorCode::kParse, "`params`: expected plain names");
    RAVE_TRY_ASSIGN(std::string text, value_text(name, value));
    request.params.emplace_back(name, std::move(text));
  }
  return {};
}

Result<ProbeRequest> request_of(const PageJson& json) {
  if (!json.is_object()) return fail(ErrorCode::kParse, "`probes`: expected objects");
  Members members(json);
  ProbeRequest request;
  RAVE_TRY_ASSIGN(request.slot, members.index("slot"));
  RAVE_TRY_ASSIGN(request.name, plain_name(members, "name"));
  RAVE_TRY_ASSIGN(request.driver, plain_name(members, "driver"));
  RAVE_TRY_ASSIGN(const PageJson* const mount, members.array("mount", 3));
  const bool whole = mount->size() == 3 && std::all_of(mount->begin(), mount->end(), is_finite);
  if (!whole) {
    return fail(ErrorCode::kParse, "`mount`: expected x, y in metres and yaw in radians");
  }
  request.X_RS = {(*mount)[0].get<double>(), (*mount)[1].get<double>(), (*mount)[2].get<double>()};
  RAVE_TRY_ASSIGN(request.z_m, members.number("z"));
  const bool near = std::abs(request.X_RS.x) <= kFarthestMount_m &&
                    std::abs(request.X_RS.y) <= kFarthestMount_m &&
                    std::abs(request.z_m) <= kFarthestMount_m;
  if (!near || std::abs(request.X_RS.yaw) > 2 * std::numbers::pi) {
    return fail(ErrorCode::kParse, "`mount`: expected at most {} m and one turn", kFarthestMount_m);
  }
  RAVE_TRY_ASSIGN(const PageJson* const params, members.any("params"));
  RAVE_TRY(take_params(*params, request));
  RAVE_TRY(members.finish());
  return request;
}

}  // namespace

Result<LookProbesMessage> look_probes_of(Members& members) {
  LookProbesMessage look;
  RAVE_TRY_ASSIGN(look.request, members.index("request"));
  RAVE_TRY_ASSIGN(const PageJson* const probes, members.array("probes", kMostProbes));
  for (const PageJson& probe : *probes) {
    RAVE_TRY_ASSIGN(ProbeRequest request, request_of(probe));
    look.probes.push_back(std::move(request));
  }
  return look;
}

}  // namespace rave::gui_server
