// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "kinds.hpp"
#include "observer.hpp"

namespace rave::robot_host {

/// Counts what the rays of virtual range sensors met, for real and for simulated robots apart.
class HitCounter final : public Observer {
 public:
  explicit HitCounter(const BodyKinds& kinds) : kinds_(&kinds) {}

  void after_step(sim::Engine& engine) override;

  /// By who looks (`real`, `simulated`) and what was met (a word of BodyKinds, or `nothing`).
  [[nodiscard]] std::map<std::string, std::map<std::string, std::uint64_t>> counts() const;

 private:
  const BodyKinds* kinds_;
  std::map<std::pair<std::string_view, std::string_view>, std::uint64_t> counts_;
};

}  // namespace rave::robot_host
