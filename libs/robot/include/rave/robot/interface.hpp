// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"
#include "rave/plugin/params.hpp"

namespace rave {

/// The basis of all driver interfaces: plain structs and function pointers. The templates beside
/// each interface make its function table from the author's class. They catch exceptions of the
/// class, so none crosses the plug-in boundary.

/// The message of a failure, written by a plug-in and read by the host.
struct ErrorText {
  char text[512] = {};
  std::uint32_t slot = 0;  ///< Index of the instance that failed, for calls with several.
  std::uint32_t reserved = 0;

  void set(std::string_view message) noexcept {
    const std::size_t size = message.size() < sizeof text ? message.size() : sizeof text - 1;
    std::memcpy(text, message.data(), size);
    text[size] = '\0';
  }
};

/// Services of the host for a driver or program. Valid as long as the instance lives. `log` may be
/// called from any thread.
struct HostServices {
  void* context = nullptr;
  void (*log)(void* context, LogLevel level, const char* text, std::uint64_t size) = nullptr;

  void write(LogLevel level, std::string_view text) const noexcept {
    if (log != nullptr) log(context, level, text.data(), text.size());
  }
};

/// The robot that an instance belongs to; fixed when the run starts. Pointers are valid as long as
/// the instance.
struct RobotInfo {
  const char* name = "";
  const char* team = "";
  std::uint32_t id = 0;  ///< RobotId.
  std::uint32_t reserved = 0;
  /// Radius of the smallest disc about the robot's origin that contains its body.
  double radius_m = 0;
  std::uint64_t seed = 0;  ///< Seed of the run.
};

/// Passes new values of all parameters to a running instance. Returns 0, or 1 with `error` set; the
/// old values then remain.
using UpdateFunction = int (*)(void* instance, const ParamValue* params, std::uint64_t count,
                               ErrorText* error);

/// Size, constructor and destructor of instances. They live in memory of the host, so that those of
/// many robots are contiguous.
struct InstanceOps {
  std::uint64_t size = 0;
  std::uint64_t alignment = 0;
  /// Constructs an instance at `where`; returns 0, or 1 with `error` set.
  int (*construct)(void* where, ErrorText* error) = nullptr;
  void (*destroy)(void* instance) = nullptr;
};

/// The answer to a change of parameters by a class without parameters_changed().
inline constexpr char kTakesNoParameters[] =
    "it takes no new parameters during a run: its class does not override parameters_changed()";

namespace detail {

/// Runs `body`, which returns a Status or nothing. A failure or an exception is written to `error`.
/// Returns 0 or 1.
template <class Body>
int guarded(ErrorText* error, Body&& body) noexcept {
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Body>>) {
      body();
      return 0;
    } else {
      const Status status = body();
      if (status) return 0;
      error->set(status.error().text());
    }
  } catch (const std::exception& e) {
    error->set(std::string("threw an exception: ") + e.what());
  } catch (...) {
    error->set("threw something that is not a std::exception");
  }
  return 1;
}

/// Runs `body` for the i-th of several instances. Its failure also sets `failed[i]`.
template <class Body>
void guarded_slot(std::size_t i, std::uint8_t* failed, ErrorText* error, Body&& body) noexcept {
  if (guarded(error, body) == 0) return;
  failed[i] = 1;
  error->slot = static_cast<std::uint32_t>(i);
}

/// Calls close() and ignores failures and exceptions.
template <class T>
void close_quietly(void* instance) noexcept {
  ErrorText ignored;
  guarded(&ignored, [&] { static_cast<T*>(instance)->close(); });
}

/// Calls `take` with the text of an instance's report(); not at all if report() throws.
template <class T>
void hand_over_report(void* instance, void* context,
                      void (*take)(void* context, const char* text, std::uint64_t size)) noexcept {
  ErrorText ignored;
  guarded(&ignored, [&] {
    const std::string text = static_cast<T*>(instance)->report();
    take(context, text.data(), text.size());
  });
}

template <class T>
constexpr InstanceOps instance_ops() noexcept {
  InstanceOps ops;
  ops.size = sizeof(T);
  ops.alignment = alignof(T);
  ops.construct = [](void* where, ErrorText* error) {
    return guarded(error, [&] { ::new (where) T(); });
  };
  ops.destroy = [](void* instance) { static_cast<T*>(instance)->~T(); };
  return ops;
}

template <class T>
constexpr UpdateFunction update_function() noexcept {
  return [](void* instance, const ParamValue* params, std::uint64_t count, ErrorText* error) {
    return guarded(error, [&] {
      return static_cast<T*>(instance)->parameters_changed(Params(std::span(params, count)));
    });
  };
}

/// The i-th of the instances of one class that are `stride` bytes apart.
template <class T>
T& instance_at(void* first, std::uint64_t stride, std::size_t i) noexcept {
  return *std::launder(reinterpret_cast<T*>(static_cast<std::byte*>(first) + stride * i));
}

}  // namespace detail
}  // namespace rave
