// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/config/fields.hpp"

// A struct with a field of every supported type, for the tests and the fuzz target.
namespace rave::sample {

enum class Role { kObserver, kCommander, kSuperUser };

constexpr auto enum_names(codec::EnumTag<Role>) {
  return std::array{codec::EnumName{Role::kObserver, "observer"},
                    codec::EnumName{Role::kCommander, "commander"},
                    codec::EnumName{Role::kSuperUser, "super_user"}};
}

struct Mount {
  std::array<double, 2> at_m{};
  double heading_deg = 0;
  bool operator==(const Mount&) const = default;
};

template <class V>
void describe(V& v, Mount& c) {
  v.required("at_m", c.at_m, {.doc = "Place on the body.", .unit = "m"});
  v.field("heading_deg", c.heading_deg, {.min = -180, .max = 180, .unit = "deg"});
}

struct Laser {
  double range_m = 8;
  double min_range_m = 0;
  int rays = 180;
  std::uint64_t seed = 7;
  std::int64_t offset = 0;
  bool enabled = true;
  std::string frame;
  codec::Located<std::string> driver;
  std::optional<double> fov_deg;
  double horizon_s = 0;
  std::vector<Mount> mounts;
  std::vector<std::vector<double>> rows;
  std::map<std::string, Mount> named;
  Role role = Role::kObserver;
  std::optional<Mount> spare;
  codec::RawNode params;

  bool operator==(const Laser& o) const {
    return range_m == o.range_m && min_range_m == o.min_range_m && rays == o.rays &&
           seed == o.seed && offset == o.offset && enabled == o.enabled && frame == o.frame &&
           driver == o.driver && fov_deg == o.fov_deg && horizon_s == o.horizon_s &&
           mounts == o.mounts && rows == o.rows && named == o.named && role == o.role &&
           spare == o.spare && params == o.params;
  }
};

template <class V>
void describe(V& v, Laser& c) {
  v.field("range_m", c.range_m,
          {.doc = "Farthest reading.", .min = 0, .exclusive_min = true, .unit = "m"});
  v.field("min_range_m", c.min_range_m, {.doc = "Nearest reading.", .min = 0, .unit = "m"});
  v.field("rays", c.rays, {.doc = "Beams in one sweep.", .min = 1, .max = 100000});
  v.field("seed", c.seed);
  v.field("offset", c.offset);
  v.field("enabled", c.enabled);
  v.required("frame", c.frame, {.doc = "The frame that it is mounted in.", .min_items = 1});
  v.field("driver", c.driver, {.doc = "The driver's name."});
  v.field("fov_deg", c.fov_deg, {.doc = "Opening angle.", .min = 0, .max = 360, .unit = "deg"});
  v.field("horizon_s", c.horizon_s, {.min = 0, .unit = "s"});
  v.field("mounts", c.mounts, {.doc = "Where copies of it sit.", .max_items = 4});
  v.field("rows", c.rows);
  v.field("named", c.named);
  v.field("role", c.role, {.doc = "Who may see it."});
  v.field("spare", c.spare);
  v.field("params", c.params, {.doc = "What the driver takes."});
}

inline void validate(const Laser& c, codec::CheckContext& check) {
  if (c.min_range_m >= c.range_m) {
    check.error("min_range_m", "`min_range_m`: found {}, expected less than `range_m` ({})",
                c.min_range_m, c.range_m);
  }
  if (c.rays % 2 == 1 && c.fov_deg == 360.0) {
    check.error("", "a full circle needs an even number of rays, found {}", c.rays);
  }
}

}  // namespace rave::sample
