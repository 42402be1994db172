// SPDX-License-Identifier: Apache-2.0
#include "answer_json.hpp"

#include <algorithm>
#include <concepts>
#include <type_traits>
#include <utility>

#include "rave/base/control_characters.hpp"
#include "rave/control/shadow_json.hpp"

namespace rave::control {
namespace {

using runtime::RunStatus;
using Changed = std::vector<std::pair<std::string, std::string>>;

template <class S, class T>
concept Is = std::same_as<std::remove_const_t<S>, T>;

// The members of a status that Writer and Reader handle alike, in one list for both. `must` is for
// a member that all processes write, `may` for one that is left out while it says nothing, and that
// older processes do not know.

void members(auto& object, Is<RunStatus::HandOver> auto& its) {
  object.must("under_way", its.under_way);
  object.must("made", its.made);
  object.must("refused", its.refused);
  object.must("last", its.last);
  object.must("x_m", its.x_m);
  object.must("y_m", its.y_m);
  object.must("yaw_rad", its.yaw_rad);
}

void members(auto& object, Is<RunStatus::Shadow::Reading> auto& its) {
  object.must("sensor", its.sensor);
  object.must("unit", its.unit);
  object.must("last", its.last);
  object.must("most", its.most);
}

void members(auto& object, Is<RunStatus::Shadow> auto& its) {
  object.must("running", its.running);
  object.must("since_s", its.since_s);
  object.must("m", its.m);
  object.must("rad", its.rad);
  object.must("most_m", its.most_m);
  object.must("most_rad", its.most_rad);
  object.must("readings", its.readings);
  object.may("offset", its.offset_W);
}

void members(auto& object, Is<RunStatus::Lateness> auto& its) {
  object.must("deadlines", its.deadlines);
  object.must("missed", its.missed);
  object.must("worst_s", its.worst_s);
  object.must("behind_s", its.behind_s);
  object.must("phase", its.phase);
}

void members(auto& object, Is<RunStatus::Robot> auto& its) {
  object.must("name", its.name);
  object.must("simulated", its.simulated);
  object.must("armed", its.armed);
  object.must("stopped", its.stopped);
  object.may("elsewhere", its.elsewhere);
  object.may("lacks", its.lacks);
  object.may("hand_over", its.hand_over);
  object.may("shadow", its.shadow);
  object.may("lease", its.lease);
  object.may("lease_page", its.lease_page);
  object.may("takes", its.takes);
  object.may("order", its.order);
  object.may("changed", its.changed);
}

void members(auto& object, Is<RunStatus> auto& its) {
  object.must("scenario", its.scenario);
  object.must("sim_s", its.sim_s);
  object.must("duration_s", its.duration_s);
  object.must("pace", its.pace);
  object.must("live", its.live);
  object.must("paused", its.paused);
  object.must("robots", its.robots);
  object.may("lateness", its.lateness);
  object.may("run", its.run);
  object.may("waits_for", its.waits_for);
}

class Writer {
 public:
  template <class T>
  void must(const char* key, const T& value) {
    json_[key] = json_of(value);
  }
  template <class T>
  void may(const char* key, const T& value) {
    if (value != T{}) must(key, value);
  }

  template <class T>
  static Json json_of(const T& value) {
    if constexpr (requires(Writer writer) { members(writer, value); }) {
      Writer writer;
      members(writer, value);
      return std::move(writer.json_);
    } else {
      return value;
    }
  }
  template <class T>
  static Json json_of(const std::optional<T>& value) {
    return json_of(*value);
  }
  template <class T>
  static Json json_of(const std::vector<T>& list) {
    Json json = Json::array();
    for (const T& item : list) json.push_back(json_of(item));
    return json;
  }
  static Json json_of(const Changed& changed) {
    Json json = Json::object();
    for (const auto& [key, value] : changed) json[key] = value;
    return json;
  }
  static Json json_of(const Pose2& X) { return {X.x, X.y, X.yaw}; }

 private:
  Json json_ = Json::object();
};

/// After the first member that is missing or has the wrong type, nothing more is read.
class Reader {
 public:
  explicit Reader(const Json& json) : json_(json), good_(json.is_object()) {}

  template <class T>
  void must(const char* key, T& value) {
    good_ = good_ && json_.contains(key) && read(json_.at(key), value);
  }
  template <class T>
  void may(const char* key, T& value) {
    if (good_ && json_.contains(key)) must(key, value);
  }
  [[nodiscard]] bool good() const noexcept { return good_; }

 private:
  template <class T>
  static bool read(const Json& json, T& value) {
    if constexpr (requires(Reader reader) { members(reader, value); }) {
      Reader reader(json);
      members(reader, value);
      return reader.good();
    } else if constexpr (std::unsigned_integral<T> && !std::same_as<T, bool>) {
      if (!json.is_number_unsigned()) return false;
      const auto whole = json.get<std::uint64_t>();
      value = static_cast<T>(whole);
      return std::in_range<T>(whole);
    } else {
      const bool fits = std::same_as<T, bool> ? json.is_boolean() : json.is_number();
      if (fits) value = json.get<T>();
      return fits;
    }
  }
  static bool read(const Json& json, std::string& value) {
    if (!json.is_string()) return false;
    value = plain_text(json.get<std::string>());
    return true;
  }
  template <class T>
  static bool read(const Json& json, std::optional<T>& value) {
    value = T{};
    return read(json, *value);
  }
  template <class T>
  static bool read(const Json& json, std::vector<T>& list) {
    return json.is_array() && std::ranges::all_of(json, [&list](const Json& item) {
             return read(item, list.emplace_back());
           });
  }
  static bool read(const Json& json, Changed& changed) {
    if (!json.is_object()) return false;
    for (const auto& [key, value] : json.items()) {
      if (!read(value, changed.emplace_back(plain_text(key), "").second)) return false;
    }
    return true;
  }
  static bool read(const Json& json, Pose2& X) {
    return json.is_array() && json.size() == 3 && read(json[0], X.x) && read(json[1], X.y) &&
           read(json[2], X.yaw);
  }

  const Json& json_;
  bool good_;
};

}  // namespace

Json answer_json(const Answer& answer) {
  Json json = {{"good", answer.good}, {"text", answer.text}};
  if (!answer.status.scenario.empty()) json["status"] = Writer::json_of(answer.status);
  return json;
}

bool read_answer(const Json& json, Answer& answer) {
  Reader object(json);
  object.must("good", answer.good);
  object.must("text", answer.text);
  object.may("status", answer.status);
  return object.good();
}

std::string plain_text(std::string_view text) {
  std::string result;
  while (true) {
    const std::size_t end = text.find('\n');
    result += without_control_characters(text.substr(0, end), " ");
    if (end == std::string_view::npos) return result;
    result += '\n';
    text.remove_prefix(end + 1);
  }
}

}  // namespace rave::control

namespace rave::runtime {

nlohmann::ordered_json shadow_json(const RunStatus::Shadow& shadow) {
  return control::Writer::json_of(shadow);
}

}  // namespace rave::runtime
