// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rave/observe/kinds.hpp"
#include "rave/observe/run_observer.hpp"

namespace rave::runtime {

/// Counts the kinds of bodies that the rays of virtual range sensors hit, separately for real and
/// simulated robots.
class HitCounter final : public RunObserver {
 public:
  explicit HitCounter(const BodyKinds& kinds) : kinds_(&kinds) {}

  void after_step(const StepView& step) override;

  /// Counts by the kind of the sensing robot (`real`, `simulated`) and of the body that was hit (a
  /// word of BodyKinds, or `nothing`).
  [[nodiscard]] std::map<std::string, std::map<std::string, std::uint64_t>> counts() const;

 private:
  /// The counters for one kind of robots, found by the address of the word.
  struct Counters {
    std::string_view who;
    std::vector<std::pair<const char*, std::uint64_t*>> known{};
  };
  std::uint64_t* count_of(Counters& counters, std::string_view what);

  const BodyKinds* kinds_;
  std::map<std::pair<std::string_view, std::string_view>, std::uint64_t> counts_;
  Counters real_{"real"};
  Counters simulated_{"simulated"};
};

}  // namespace rave::runtime
