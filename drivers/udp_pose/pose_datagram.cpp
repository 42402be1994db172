// SPDX-License-Identifier: Apache-2.0
#include "udp_pose/pose_datagram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "rave/math/scalar.hpp"

namespace rave::udp_pose {
namespace {

using Json = nlohmann::json;

constexpr double kFarthest_m = 1e6;
constexpr double kLatest_s = 1e10;  // Unix time until the year 2286
constexpr double kMostYaw_rad = 1e4;
constexpr double kMostVariance = 1e6;
constexpr std::size_t kLongestName = 64;
constexpr std::array<std::string_view, 7> kKeys{"body", "t", "x", "y", "yaw", "cov", "seq"};

/// Detects duplicate keys, of which the parser would silently keep one.
class Guard {
 public:
  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::key && depth == 1) {
      const auto& key = parsed.get_ref<const std::string&>();
      for (std::size_t i = 0; i < kKeys.size(); ++i) {
        if (key != kKeys[i]) continue;
        if (seen_[i] && twice_.empty()) twice_ = key;
        seen_[i] = true;
      }
    }
    return true;
  }
  [[nodiscard]] const std::string& twice() const noexcept { return twice_; }

 private:
  std::array<bool, kKeys.size()> seen_{};
  std::string twice_;
};

Result<double> number_of(const Json& value, std::string_view name, double most) {
  if (!value.is_number()) return fail(ErrorCode::kParse, "`{}` is not a number", name);
  const double number = value.get<double>();
  if (!std::isfinite(number) || std::abs(number) > most) {
    return fail(ErrorCode::kParse, "`{}` is beyond {}", name, most);
  }
  return number;
}

Result<double> number_at(const Json& object, const char* name, double most) {
  const auto found = object.find(name);
  if (found == object.end()) return fail(ErrorCode::kParse, "`{}` is missing", name);
  return number_of(*found, name, most);
}

Status read_variance(const Json& object, PoseDatagram& datagram) {
  const auto found = object.find("cov");
  if (found == object.end()) return {};
  if (!found->is_array() || found->size() != 3) {
    return fail(ErrorCode::kParse, "`cov` is not a list of three numbers");
  }
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    RAVE_TRY_ASSIGN(values[i], number_of((*found)[i], "cov", kMostVariance));
    if (values[i] < 0) return fail(ErrorCode::kParse, "`cov` is negative");
  }
  datagram.variance = {values[0], values[1], values[2]};
  return {};
}

Status read_names(const Json& object, PoseDatagram& datagram) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      // An unknown key may be a misspelt `cov` or `seq`, which would be ignored silently.
      return fail(ErrorCode::kParse, "unknown key; expected body, t, x, y, yaw, cov and seq");
    }
  }
  const auto body = object.find("body");
  if (body == object.end()) return fail(ErrorCode::kParse, "`body` is missing");
  if (!body->is_string()) return fail(ErrorCode::kParse, "`body` is not a string");
  datagram.body = body->get_ref<const std::string&>();
  if (datagram.body.empty() || datagram.body.size() > kLongestName) {
    return fail(ErrorCode::kParse, "`body` must have 1 to {} bytes", kLongestName);
  }
  const auto seq = object.find("seq");
  if (seq == object.end()) return {};
  const bool fits = seq->is_number_unsigned() && seq->get<std::uint64_t>() <= INT64_MAX;
  if (!fits) return fail(ErrorCode::kParse, "`seq` is not a whole number from 0");
  datagram.seq = seq->get<std::int64_t>();
  return {};
}

}  // namespace

Result<PoseDatagram> parse_datagram(std::string_view bytes) {
  if (bytes.size() > kMaxDatagram) {
    return fail(ErrorCode::kParse, "longer than {} bytes", kMaxDatagram);
  }
  Guard guard;
  // Parsed without exceptions: anybody who reaches the port can send garbage at any rate.
  const Json object = Json::parse(
      bytes.begin(), bytes.end(),
      [&guard](int depth, Json::parse_event_t event, Json& parsed) {
        return guard(depth, event, parsed);
      },
      false);
  if (object.is_discarded()) return fail(ErrorCode::kParse, "not JSON");
  if (!object.is_object()) return fail(ErrorCode::kParse, "not a JSON object");
  if (!guard.twice().empty()) return fail(ErrorCode::kParse, "duplicate key `{}`", guard.twice());
  PoseDatagram datagram;
  RAVE_TRY(read_names(object, datagram));
  RAVE_TRY_ASSIGN(datagram.t_s, number_at(object, "t", kLatest_s));
  RAVE_TRY_ASSIGN(datagram.x_m, number_at(object, "x", kFarthest_m));
  RAVE_TRY_ASSIGN(datagram.y_m, number_at(object, "y", kFarthest_m));
  RAVE_TRY_ASSIGN(const double yaw_rad, number_at(object, "yaw", kMostYaw_rad));
  // Some programs count headings on beyond a turn.
  datagram.yaw_rad = wrap_angle(yaw_rad);
  RAVE_TRY(read_variance(object, datagram));
  return datagram;
}

}  // namespace rave::udp_pose
