// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "rave/observe/run_observer.hpp"
#include "rave/onlook/teller.hpp"

namespace rave::runtime {

/// Shows one of several hosts to monitors on the bus of the run. It changes nothing of
/// the run, and waits for no process.
class BusFace final : public RunObserver {
 public:
  /// `obstacles`: no other process publishes them on the bus for this host. `catalogue`: where
  /// the drivers of probes are found; null: none. Errors: those of onlook::Teller::create().
  [[nodiscard]] static Result<std::unique_ptr<BusFace>> open(bus::Bus& bus, std::uint32_t host,
                                                             bool obstacles,
                                                             plugin::Catalogue* catalogue);

  Status run_begins(const RunView& run) override;
  void after_step(const StepView& step) override;
  void held(const sim::Engine& engine) override;

  /// Whether a monitor asks for the readings of robots.
  [[nodiscard]] bool robots_asked() const noexcept { return teller_->robots_asked(); }

 private:
  BusFace() = default;

  const BodyKinds* kinds_ = nullptr;
  std::unique_ptr<onlook::Teller> teller_;
};

}  // namespace rave::runtime
