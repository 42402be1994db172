// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "rave/base/result.hpp"
#include "rave/gui_server/source.hpp"

namespace rave::gui_server {

/// What a page asks about runs as such.
struct ConductMessage {
  enum class Do : std::uint8_t {
    kStart,    ///< Start a scenario.
    kEnd,      ///< End the run; a second time, kill it.
    kRestart,  ///< End the run, and start the same scenario again.
    kOpen,     ///< Show a recording in all pages.
    kClose,    ///< Show the start page in all pages instead of a recording.
  };
  Do what = Do::kStart;
  std::uint32_t request = 0;
  std::string name;  ///< kStart: of the scenario; kOpen: of the folder of the run.
  std::optional<std::uint32_t> seed = std::nullopt;  ///< kStart, kRestart; empty: as before.
  friend bool operator==(const ConductMessage&, const ConductMessage&) = default;
};

/// Starts and ends runs for pages, and tells what there is to start. Any thread; the server owns
/// one together with the command that made it.
class Conductor {
 public:
  Conductor() = default;
  Conductor(const Conductor&) = delete;
  Conductor& operator=(const Conductor&) = delete;
  virtual ~Conductor() = default;

  /// Changes with the text below.
  [[nodiscard]] virtual std::uint64_t revision() const = 0;
  /// The message `conduct`. `whole`: for a person who may start and end runs; others learn which
  /// run there is and how it does.
  [[nodiscard]] virtual std::string text(bool whole) = 0;
  /// Begins what is asked and returns at once with a sentence; what becomes of it is in text().
  /// Errors: kNotFound (no such scenario or recording), kState (another run is in progress, or
  /// none).
  [[nodiscard]] virtual Result<std::string> take(const ConductMessage& message) = 0;
};

/// What pages are shown while there is no run.
[[nodiscard]] std::shared_ptr<Source> no_run();

}  // namespace rave::gui_server
