// SPDX-License-Identifier: Apache-2.0
#include "stream_losses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace rave::runtime {
namespace {

using Json = nlohmann::ordered_json;

// Recordings lose single readings. Only a loss of more than a twentieth is reported.
constexpr double kMostLost = 0.05;

/// The report comes from a driver: a value that is not a count yields none.
std::uint64_t count_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  const bool is_count = found != object.end() && found->is_number_unsigned();
  return is_count ? found->get<std::uint64_t>() : 0;
}

std::string loss_of(const RunResults& results, const InstrumentFacts& stream) {
  const Json report = Json::parse(stream.report, nullptr, false);
  if (!report.is_object() || !report.contains("dropped")) return {};
  const Json& dropped = report["dropped"];
  if (!dropped.is_object()) return {};
  const std::uint64_t count = count_of(dropped, "count");
  const std::uint64_t of = count_of(dropped, "of");
  const double share = of > 0 ? static_cast<double>(count) / static_cast<double>(of) : 0;
  if (!(share > kMostLost)) return {};
  const auto because = dropped.find("because");
  const bool said = because != dropped.end() && because->is_string() &&
                    !because->get_ref<const std::string&>().empty();
  return fmt::format("sensor `{}` of robot `{}` lost {} of {} readings ({:.1f} %){}", stream.name,
                     results.spec.robots[stream.robot].name, count, of, 100 * share,
                     said ? ": " + because->get<std::string>() : "");
}

/// The largest number of remarks of a driver that are passed on.
constexpr std::size_t kMostNotes = 16;

/// The remarks of a driver on what it plays. Sensors that play one log make the same ones.
void add_notes(const RunResults& results, const InstrumentFacts& stream,
               std::vector<std::string>& texts) {
  const Json report = Json::parse(stream.report, nullptr, false);
  if (!report.is_object()) return;
  const auto notes = report.find("notes");
  if (notes == report.end() || !notes->is_array()) return;
  std::size_t count = 0;
  for (const Json& note : *notes) {
    if (!note.is_string() || ++count > kMostNotes) continue;
    std::string text = fmt::format("robot `{}`: {}", results.spec.robots[stream.robot].name,
                                   note.get_ref<const std::string&>());
    if (std::ranges::find(texts, text) == texts.end()) texts.push_back(std::move(text));
  }
}

}  // namespace

std::vector<std::string> stream_losses(const RunResults& results) {
  std::vector<std::string> losses;
  for (const InstrumentFacts& stream : results.facts.streams) {
    if (std::string loss = loss_of(results, stream); !loss.empty()) {
      losses.push_back(std::move(loss));
    }
  }
  for (const InstrumentFacts& stream : results.facts.streams) add_notes(results, stream, losses);
  return losses;
}

}  // namespace rave::runtime
