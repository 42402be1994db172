// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/time.hpp"

namespace rave {

/// Judges the samples of one queue before they count. The queue calls it for one sample at a time,
/// with its lock held, on the thread of the driver.
class SampleGate {
 public:
  enum class Verdict {
    kPass,
    kRefuse,  ///< The sample counts for nothing.
    kAnew,    ///< It passes, but it does not continue those before.
  };

  SampleGate() = default;
  SampleGate(const SampleGate&) = delete;
  SampleGate& operator=(const SampleGate&) = delete;
  virtual ~SampleGate() = default;

  /// `record`: the first of the sample.
  [[nodiscard]] virtual Verdict judge(SimTime stamp, const void* record) = 0;
  /// For people: what was wrong with the last sample that did not pass, or why what follows is
  /// something new.
  [[nodiscard]] virtual std::string reason() const = 0;
  /// As before the first sample.
  virtual void reset() noexcept = 0;
};

}  // namespace rave
