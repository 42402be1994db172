// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace rave::cli {

/// Help in the words that a person types: `ROBOT X Y [YAW]`, not `robot pose(2x)`.
class Help final : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_option_name(const CLI::Option* option,
                                             bool is_positional) const override;
  [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override;
  [[nodiscard]] std::string make_option_usage(const CLI::Option* option) const override;
};

}  // namespace rave::cli
