// SPDX-License-Identifier: Apache-2.0
#include "commands/version.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "error_text.hpp"
#include "rave/assemble/build.hpp"

namespace rave::cli {
namespace {

#if defined(__clang__)
constexpr std::string_view kCompiler = __VERSION__;
#else
constexpr std::string_view kCompiler = "g++ " __VERSION__;
#endif

std::string_view sanitizer_name(std::uint32_t sanitizer) noexcept {
  constexpr std::array<std::string_view, 3> kNames = {"none", "address", "thread"};
  return sanitizer < kNames.size() ? kNames[sanitizer] : "unknown";
}

}  // namespace

int version() {
  const plugin::Stamp stamp = runtime::host_stamp();
  put(stdout, fmt::format("rave {}\n"
                          "robot interface    {:016x}\n"
                          "virtual interface  {:016x}\n"
                          "compiler           {} (C++ ABI {})\n"
                          "build type         {}\n"
                          "sanitizer          {}\n",
                          RAVE_VERSION, stamp.robot_interface, stamp.virtual_interface, kCompiler,
                          stamp.compiler_abi, RAVE_BUILD_TYPE, sanitizer_name(stamp.sanitizer)));
  return kGood;
}

}  // namespace rave::cli
