// SPDX-License-Identifier: Apache-2.0
#include "process_usage.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <string>

#include "rave/base/file.hpp"

namespace rave::watch {
namespace {

constexpr std::size_t kLongest = 4096;

/// The n-th word of a line, from 0, as a number.
std::optional<double> number_in(std::string_view text, std::size_t index) {
  for (; index > 0; --index) {
    const std::size_t space = text.find(' ');
    if (space == std::string_view::npos) return std::nullopt;
    text.remove_prefix(space + 1);
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && value >= 0 ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<ProcessUsage> parse_usage(std::string_view stat, std::string_view statm,
                                        double ticks_per_s, double page_bytes) {
  // The name of the program, in brackets, may have spaces and brackets of its own.
  const std::size_t name_end = stat.rfind(") ");
  if (name_end == std::string_view::npos) return std::nullopt;
  const std::string_view rest = stat.substr(name_end + 2);
  // Behind the name come the state and further fields; utime is number 14 of proc(5), the twelfth
  // here, and stime follows it. Both are in clock ticks.
  constexpr std::size_t kUser = 11;
  const auto user = number_in(rest, kUser);
  const auto system = number_in(rest, kUser + 1);
  const auto pages = number_in(statm, 1);
  if (!user || !system || !pages) return std::nullopt;
  return ProcessUsage{(*user + *system) / ticks_per_s, *pages * page_bytes * 1e-6};
}

std::optional<ProcessUsage> usage_of(std::uint32_t process) {
  const std::string folder = fmt::format("/proc/{}/", process);
  const auto stat = read_file(folder + "stat", kLongest);
  const auto statm = read_file(folder + "statm", kLongest);
  if (!stat || !statm) return std::nullopt;
  return parse_usage(*stat, *statm, static_cast<double>(::sysconf(_SC_CLK_TCK)),
                     static_cast<double>(::sysconf(_SC_PAGESIZE)));
}

}  // namespace rave::watch
