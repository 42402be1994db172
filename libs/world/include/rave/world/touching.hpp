// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/math/separation.hpp"
#include "rave/math/time_of_impact.hpp"
#include "rave/world/body.hpp"

namespace rave::world {

/// Signed separation of two shapes at their poses; see rave/math/separation.hpp. Infinite for
/// shapes whose height ranges do not overlap.
[[nodiscard]] Separation separation(const Shape& a, const Pose2& X_WA, const Shape& b,
                                    const Pose2& X_WB) noexcept;

/// The least separation over all pairs of shapes of two bodies.
[[nodiscard]] Separation separation(const Body& a, const Pose2& X_WA, const Body& b,
                                    const Pose2& X_WB) noexcept;

/// The part of its motion that body `a` can make from X_WA until it comes within `limits.skin_m` of
/// body `b` at X_WB, over all pairs of their shapes. For polygons and discs alike: if they start
/// nearer than the skin, only motions that do not bring them nearer are free, and no motion passes
/// through a body; see rave/math/time_of_impact.hpp.
[[nodiscard]] Impact time_of_impact(const Body& a, const Pose2& X_WA, const Motion2& motion_W,
                                    const Body& b, const Pose2& X_WB,
                                    const ImpactLimits& limits = {}) noexcept;

}  // namespace rave::world
