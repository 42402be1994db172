// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Includes all headers about polygons.
#include "rave/math/convex_polygon.hpp"
#include "rave/math/decompose.hpp"
#include "rave/math/separation.hpp"
#include "rave/math/time_of_impact.hpp"
