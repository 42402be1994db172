// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Everything about polygons in one include.
#include "rave/math/convex_polygon.hpp"
#include "rave/math/decompose.hpp"
#include "rave/math/separation.hpp"
#include "rave/math/time_of_impact.hpp"
