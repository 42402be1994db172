// SPDX-License-Identifier: Apache-2.0
#include "describe.hpp"

#include <cxxabi.h>
#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <memory>

#include "rave/base/word_table.hpp"

namespace rave::isolation {
namespace {

std::string readable_name(std::string_view name) {
  std::string text(name);
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> readable(
      abi::__cxa_demangle(text.c_str(), nullptr, nullptr, &status), &std::free);
  if (status == 0 && readable) text = readable.get();
  // Programs usually are in an anonymous namespace, whose name tells a reader nothing.
  constexpr std::string_view kAnonymous = "(anonymous namespace)::";
  for (std::size_t at; (at = text.find(kAnonymous)) != std::string::npos;) {
    text.erase(at, kAnonymous.size());
  }
  return text;
}

/// `Wander::` for a function in the function table of class Wander; see detail::program_ops.
std::string program_class(const std::string& frame) {
  constexpr std::string_view kTable = "program_ops<";
  std::size_t begin = frame.find(kTable);
  if (begin == std::string::npos) return {};
  begin += kTable.size();
  int open = 1;
  std::size_t end = begin;
  for (; end < frame.size(); ++end) {
    if (frame[end] == '<') ++open;
    if (frame[end] == '>' && --open == 0) break;
  }
  return frame.substr(begin, end - begin) + "::";
}

}  // namespace

std::string signal_name(int signal) {
  constexpr WordTable<int, 7> kNames = {{{"segmentation fault", SIGSEGV},
                                         {"bus error", SIGBUS},
                                         {"arithmetic fault", SIGFPE},
                                         {"illegal instruction", SIGILL},
                                         {"abort", SIGABRT},
                                         {"signal 9 (kill)", SIGKILL},
                                         {"signal 15 (terminate)", SIGTERM}}};
  const std::string_view name = kNames.of(signal);
  return name.empty() ? fmt::format("signal {}", signal) : std::string(name);
}

std::string short_function(std::string_view name, std::string_view frame) {
  std::string text = readable_name(name);
  // The parameters start at the first parenthesis that does not belong to `operator()`.
  std::size_t end = text.find('(');
  if (end != std::string::npos && text.substr(0, end).ends_with("operator")) {
    end = text.find('(', end + 1);
  }
  text = text.substr(0, end);
  return text == "decide" || text == "start" ? program_class(readable_name(frame)) + text : text;
}

std::string at_place(const Place& place) {
  if (place.file.empty()) return {};
  std::string text = fmt::format(" at {}", place.file);
  if (place.line > 0) text += fmt::format(":{}", place.line);
  if (!place.function.empty())
    text += fmt::format(" in {}", short_function(place.function, place.frame));
  return text;
}

std::string seconds_text(double seconds) {
  return seconds >= 1 ? fmt::format("{:.1f} s", seconds) : fmt::format("{:g} s", seconds);
}

}  // namespace rave::isolation
