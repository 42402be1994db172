// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/codec/nodes.hpp"
#include "rave/math/finite.hpp"
#include "rave/request/request.hpp"

// The descriptions of requests.
namespace rave::request {

/// No world is as large, and no robot as fast; larger numbers are mistakes.
inline constexpr double kFarthest_m = 1e6;
inline constexpr double kFastest = 100;

constexpr codec::FieldOptions speed(std::string_view doc, double least = -kFastest) {
  return {.doc = doc, .min = least, .max = kFastest};
}
constexpr codec::FieldOptions text_of(std::string_view doc, std::size_t most,
                                      std::size_t least = 1) {
  return {.doc = doc, .min_items = least, .max_items = most};
}
constexpr codec::FieldOptions place(std::string_view doc) {
  return {.doc = doc, .min = -kFarthest_m, .max = kFarthest_m, .unit = "m"};
}
constexpr codec::FieldOptions heading(std::string_view doc) {
  return {.doc = doc, .min = -7, .max = 7, .unit = "rad"};
}

}  // namespace rave::request

/// A point is a list of x and y.
template <>
struct rave::codec::Codec<rave::Vec2> {
  using Pair = std::array<double, 2>;
  static void read(const ReadContext& context, const RawNode& node, Vec2& value) {
    Pair pair{};
    Codec<Pair>::read(context, node, pair);
    value = {pair[0], pair[1]};
  }
  static RawNode write(const Vec2& value) { return Codec<Pair>::write({value.x, value.y}); }
  static RawNode schema(const FieldOptions& options) { return Codec<Pair>::schema(options); }
  static std::string expectation(const FieldOptions& options) {
    return Codec<Pair>::expectation(options);
  }
};

namespace rave::request {

template <class V>
void describe(V&, Stop&) {}
template <class V>
void describe(V&, Release&) {}
template <class V>
void describe(V&, Arm&) {}
template <class V>
void describe(V&, ResetShadow&) {}
template <class V>
void describe(V&, Cancel&) {}
template <class V>
void describe(V&, ListObstacles&) {}

template <class V>
void describe(V& v, Set& c) {
  v.required("key", c.key, text_of("Parameter, such as `program.max_speed_mps`.", 256));
  v.required("value", c.value, text_of("Value as in a file.", 4096));
}
template <class V>
void describe(V& v, HandOver& c) {
  v.required("to", c.to, text_of("`real`, `simulated`, `first` or `twin`.", 16));
}
template <class V>
void describe(V& v, Take& c) {
  v.field("force", c.force, {.doc = "Takes it over from another person."});
  v.field("drives", c.drives, {.doc = "Refused also while the stick of this page is held."});
}
template <class V>
void describe(V& v, Give& c) {
  v.field("to", c.to, text_of("New holder; empty: none.", kMostOrderAuthor, 0));
}
template <class V>
void describe(V& v, Pedals& c) {
  v.field("steering", c.steering, {.doc = "Right -1 to left 1.", .min = -1, .max = 1});
  v.field("throttle", c.throttle, {.doc = "Share of full throttle.", .min = 0, .max = 1});
  v.field("brake", c.brake, {.doc = "Share of full brake.", .min = 0, .max = 1});
  v.field("gear", c.gear, {.doc = "1, 0 or -1 for reverse.", .min = -1, .max = 1});
}
inline void validate(const Pedals& c, codec::CheckContext& check) {
  if (!c.is_valid()) check.error("gear", "expected -1, 0 or 1");
}
template <class V>
void describe(V& v, Drive& c) {
  v.required("v", c.v_mps, speed("Forward, m/s."));
  v.required("w", c.w_radps, speed("Counter-clockwise, rad/s."));
  v.field("vy", c.vy_mps, speed("To the left, m/s."));
  v.field("pedals", c.pedals, {.doc = "For cars, instead of the velocity."});
}
template <class V>
void describe(V& v, Goal& c) {
  v.required("point", c.p_W, place("Point in the world, x and y."));
  v.field("yaw", c.yaw_rad, heading("Heading there; null: any."));
  v.field("speed", c.speed_mps, speed("Largest speed, m/s; 0: the robot decides.", 0));
}
template <class V>
void describe(V& v, Path& c) {
  v.required("points", c.points_W, place("Points in the world, each x and y."));
  v.field("speed", c.speed_mps, speed("Largest speed, m/s; 0: the robot decides.", 0));
}
inline void validate(const Path& c, codec::CheckContext& check) {
  const Status size = check_path_size(c.points_W.size());
  if (!size) check.error("points", "{}", size.error().message);
}
template <class V>
void describe(V& v, Text& c) {
  v.required("text", c.text, text_of("Text for the program.", kMostOrderText));
}
template <class V>
void describe(V& v, Place& c) {
  v.required("point", c.p_W, place("Point in the world, x and y."));
  v.field("yaw", c.yaw_rad, heading("Heading; null: as before."));
}
template <class V>
void describe(V& v, Chat& c) {
  v.required("number", c.number, {.doc = "Number at its server.", .min = 1});
  v.required("role", c.role, text_of("Role of the sender.", 16));
  v.field("to", c.to, {.doc = "Kind of receiver."});
  v.field("name", c.name, text_of("Name of the receiver; none for all.", kMostChatName, 0));
  v.required("text", c.text, text_of("Text.", kMostOrderText));
}
inline void validate(const Chat& c, codec::CheckContext& check) {
  if (c.name.empty() != (c.to == Addressee::kAll)) {
    check.error("name", "expected the name of the receiver, except for all");
  }
  if (c.role != "observer" && c.role != "commander" && c.role != "super_user") {
    check.error("role", "expected observer, commander or super_user");
  }
}

/// What all requests have beside their action.
struct Sender {
  std::string robot{};
  std::string by{};
  bool overrides = false;
  std::uint64_t page = 0;
};
template <class V>
void describe(V& v, Sender& c) {
  v.field("robot", c.robot, text_of("Robot; empty: all.", 4096, 0));
  v.field("by", c.by, text_of("Person; empty: the terminal.", kMostOrderAuthor, 0));
  v.field("overrides", c.overrides, {.doc = "The person is a super-user."});
  v.field("page", c.page, {.doc = "Page of the person.", .min = 1});
}

}  // namespace rave::request
