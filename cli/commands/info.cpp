// SPDX-License-Identifier: Apache-2.0
#include "commands/info.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error_text.hpp"
#include "places.hpp"
#include "rave/record/record_summary.hpp"
#include "rave/report/table.hpp"

namespace rave::cli {
namespace {

std::string size_text(std::uint64_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3);
  if (bytes < 1'000'000'000) return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
  return fmt::format("{:.2f} GB", static_cast<double>(bytes) / 1e9);
}

std::string run_text(const record::RecordSummary& summary) {
  if (!summary.run) return "not written by RAVE\n";
  const record::RunInfo& run = *summary.run;
  const auto real = static_cast<std::size_t>(
      std::count_if(run.robots.begin(), run.robots.end(),
                    [](const record::RecordedRobot& robot) { return robot.kind == "real"; }));
  std::string text =
      fmt::format("{}, seed {}, begun {}\n{} robots: {} real, {} simulated\n", run.scenario,
                  run.seed, run.started, run.robots.size(), real, run.robots.size() - real);
  if (!summary.end) return text + "the run did not come to its end\n";
  text += fmt::format("{} steps of {} s", summary.end->steps, run.step_s);
  return text + (summary.end->hash ? fmt::format(", run hash {:016x}\n", *summary.end->hash)
                                   : ", live: no run hash\n");
}

}  // namespace

int info(const InfoCommand& options) {
  const auto summary = record::describe_record(record_file(options.file));
  if (!summary) return complain(summary.error());
  std::string text = run_text(*summary);
  text +=
      fmt::format("{} messages from {:.2f} to {:.2f} s, {} in {} chunks, {}\n", summary->messages,
                  summary->start_s, summary->end_s, size_text(summary->file_bytes), summary->chunks,
                  summary->whole ? "whole" : "cut: what is there can be read");
  for (const auto& [sensor, made_of] : summary->hybrids) {
    text += fmt::format("hybrid {}: {}; both parts and the result are recorded\n", sensor, made_of);
  }
  for (const std::string& damage : summary->damages) text += fmt::format("damaged: {}\n", damage);
  report::Table table;
  table.columns = {{"topic", report::Align::kLeft, false},
                   {"type", report::Align::kLeft, false},
                   {"messages", report::Align::kRight, false},
                   {"rate", report::Align::kRight, false}};
  for (const record::ChannelSummary& channel : summary->channels) {
    table.rows.push_back({channel.topic, channel.schema, fmt::format("{}", channel.messages),
                          fmt::format("{:.1f} Hz", channel.rate_hz)});
  }
  put(stdout, text + report::render_table(table));
  return summary->whole && summary->damages.empty() ? kGood : kNotGood;
}

}  // namespace rave::cli
