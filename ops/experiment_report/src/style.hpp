// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave::experiment {

/// The style sheet of the page: light and dark, narrow windows, print.
extern const char* const kPageStyle;

}  // namespace rave::experiment
