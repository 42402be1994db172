// SPDX-License-Identifier: Apache-2.0
#include "rave/doctor/letter.hpp"

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

/// Reads fields of an object; remembers if one was not as it must be.
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
  /// Text ends up on terminals.
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

Json json_of(const About& about) {
  return {{"machine", about.machine},
          {"version", about.version},
          {"interface_stamp", about.interface_stamp},
          {"domain", about.domain},
          {"multicast", about.multicast},
          {"authority", about.authority},
          {"participant", about.participant},
          {"discovery_port", about.discovery_port},
          {"data_port", about.data_port},
          {"hears_multicast", about.hears_multicast}};
}

bool read_about(const Json& json, About& about) {
  Fields fields(json);
  fields.read("machine", about.machine);
  fields.read("version", about.version);
  fields.read("interface_stamp", about.interface_stamp);
  fields.read("domain", about.domain);
  fields.read("multicast", about.multicast);
  fields.read("authority", about.authority);
  fields.read("participant", about.participant);
  fields.read("discovery_port", about.discovery_port);
  fields.read("data_port", about.data_port);
  fields.read("hears_multicast", about.hears_multicast);
  return fields.good();
}

}  // namespace

std::string write_letter(const Letter& letter, std::size_t least) {
  Json json = {{"rave_doctor", 1},
               {"kind", kKinds[static_cast<std::size_t>(letter.kind)]},
               {"number", letter.number},
               {"want", letter.want},
               {"size", letter.size},
               {"by_multicast", letter.by_multicast},
               {"sent_ns", letter.sent_ns},
               {"asked_ns", letter.asked_ns},
               {"received_ns", letter.received_ns}};
  if (letter.kind == Letter::Kind::kAnswer) json["about"] = json_of(letter.about);
  std::string bytes = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  bytes.resize(std::max(bytes.size(), std::min(least, kLargestLetter)), ' ');
  return bytes;
}

Result<Letter> parse_letter(std::string_view bytes) {
  const auto refused = [](std::string_view why) {
    return fail(ErrorCode::kParse, "this is no letter of a doctor: {}", why);
  };
  // Nothing of ours is nested deeper, and a parser that recurses must not be led down.
  if (std::ranges::count(bytes, '{') > 2 || bytes.find('[') != std::string_view::npos) {
    return refused("it is nested");
  }
  const Json json = Json::parse(bytes, nullptr, false);
  if (json.is_discarded()) return refused("it is not JSON");
  Fields fields(json);
  std::uint32_t layout = 0;
  std::string kind;
  Letter letter;
  fields.read("rave_doctor", layout);
  fields.read("kind", kind);
  fields.read("number", letter.number);
  fields.read("want", letter.want);
  fields.read("size", letter.size);
  fields.read("by_multicast", letter.by_multicast);
  fields.read("sent_ns", letter.sent_ns);
  fields.read("asked_ns", letter.asked_ns);
  fields.read("received_ns", letter.received_ns);
  if (!fields.good()) return refused("a field is missing or of another type");
  if (layout != 1) return refused("it is of another version");
  const auto found = std::ranges::find(kKinds, kind);
  if (found == kKinds.end()) return refused("its kind is not known");
  letter.kind = static_cast<Letter::Kind>(found - kKinds.begin());
  if (letter.kind != Letter::Kind::kAnswer) return letter;
  const Json* const about = fields.find("about");
  if (about == nullptr || !read_about(*about, letter.about)) return refused("it says too little");
  return letter;
}

}  // namespace rave::doctor
