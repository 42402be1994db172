// SPDX-License-Identifier: Apache-2.0
#include "rave/doctor/probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "rave/base/control_characters.hpp"

namespace rave::doctor {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 4> kKinds = {"ask", "answer", "call", "shout"};
constexpr std::size_t kLongestText = 256;

/// Reads fields of an object and remembers whether one was missing or wrong. Probes come from any
/// machine that reaches the port. Each field must be there and of the right type, or the whole
/// probe is refused.
class Fields {
 public:
  explicit Fields(const Json& json) : json_(json), good_(json.is_object()) {}

  template <class Number>
  void read(const char* key, Number& number) {
    const Json* const value = find(key);
    if (value == nullptr) return;
    bool fits = false;
    if constexpr (std::is_signed_v<Number>) {
      // Differences of times must not overflow.
      constexpr double kMost = 4e18;
      fits = value->is_number_integer() && std::fabs(value->get<double>()) <= kMost;
    } else {
      fits = value->is_number_unsigned() &&
             value->get<std::uint64_t>() <= std::numeric_limits<Number>::max();
    }
    good_ = good_ && fits;
    if (fits) number = value->get<Number>();
  }
  void read(const char* key, bool& truth) {
    const Json* const value = find(key);
    good_ = good_ && value != nullptr && value->is_boolean();
    if (good_) truth = value->get<bool>();
  }
  /// Refuses control characters, because the text is shown on terminals.
  void read(const char* key, std::string& text) {
    const Json* const value = find(key);
    good_ = good_ && value != nullptr && value->is_string();
    if (!good_) return;
    text = value->get<std::string>();
    good_ = text.size() <= kLongestText && !has_control_characters(text);
  }
  [[nodiscard]] const Json* find(const char* key) {
    const auto found = good_ ? json_.find(key) : json_.end();
    if (good_ && found != json_.end()) return &*found;
    good_ = false;
    return nullptr;
  }
  [[nodiscard]] bool good() const noexcept { return good_; }

 private:
  const Json& json_;
  bool good_;
};

/// Calls `visit(name, field)` for each field of an About; `about` may be const.
template <class Any, class Visit>
void visit_about(Any& about, const Visit& visit) {
  visit("machine", about.machine);
  visit("version", about.version);
  visit("interface_stamp", about.interface_stamp);
  visit("domain", about.domain);
  visit("multicast", about.multicast);
  visit("authority", about.authority);
  visit("participant", about.participant);
  visit("discovery_port", about.discovery_port);
  visit("data_port", about.data_port);
  visit("hears_multicast", about.hears_multicast);
}

/// The same for the numbers of a Probe.
template <class Any, class Visit>
void visit_probe(Any& probe, const Visit& visit) {
  visit("number", probe.number);
  visit("want", probe.want);
  visit("size", probe.size);
  visit("by_multicast", probe.by_multicast);
  visit("sent_ns", probe.sent_ns);
  visit("asked_ns", probe.asked_ns);
  visit("received_ns", probe.received_ns);
}

}  // namespace

std::string write_probe(const Probe& probe, std::size_t least) {
  Json json = {{"rave_doctor", 1}, {"kind", kKinds[static_cast<std::size_t>(probe.kind)]}};
  visit_probe(probe, [&](const char* name, const auto& field) { json[name] = field; });
  if (probe.kind == Probe::Kind::kAnswer) {
    Json& about = json["about"];
    visit_about(probe.about, [&](const char* name, const auto& field) { about[name] = field; });
  }
  // ASCII only, so that no terminal or log has to guess the encoding.
  std::string bytes = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  // Blanks behind JSON mean nothing, so a probe can have any size.
  bytes.resize(std::max(bytes.size(), std::min(least, kLargestProbe)), ' ');
  return bytes;
}

Result<Probe> parse_probe(std::string_view bytes) {
  const auto refused = [](std::string_view why) {
    return fail(ErrorCode::kParse, "this is not a message of a doctor: {}", why);
  };
  // Probes are not nested deeper, and deep nesting would exhaust the stack of the recursive parser.
  if (std::ranges::count(bytes, '{') > 2 || bytes.find('[') != std::string_view::npos) {
    return refused("it is nested");
  }
  const Json json = Json::parse(bytes, nullptr, false);
  if (json.is_discarded()) return refused("it is not JSON");
  Fields fields(json);
  std::uint32_t layout = 0;
  std::string kind;
  Probe probe;
  fields.read("rave_doctor", layout);
  fields.read("kind", kind);
  visit_probe(probe, [&](const char* name, auto& field) { fields.read(name, field); });
  if (!fields.good()) return refused("a field is missing or of another type");
  if (layout != 1) return refused("its version differs");
  const auto found = std::ranges::find(kKinds, kind);
  if (found == kKinds.end()) return refused("its kind is unknown");
  probe.kind = static_cast<Probe::Kind>(found - kKinds.begin());
  if (probe.kind != Probe::Kind::kAnswer) return probe;
  const Json* const about = fields.find("about");
  if (about == nullptr) return refused("members are missing or invalid");
  Fields about_fields(*about);
  visit_about(probe.about, [&](const char* name, auto& field) { about_fields.read(name, field); });
  if (!about_fields.good()) return refused("members are missing or invalid");
  return probe;
}

}  // namespace rave::doctor
