// SPDX-License-Identifier: Apache-2.0
#include "help.hpp"

#include <string_view>

namespace rave::cli {

std::string Help::make_option_name(const CLI::Option* option, bool is_positional) const {
  return is_positional ? option->get_type_name()
                       : CLI::Formatter::make_option_name(option, is_positional);
}

std::string Help::make_option_opts(const CLI::Option* option) const {
  if (option->get_positional()) return option->get_required() ? " REQUIRED" : "";
  std::string text = CLI::Formatter::make_option_opts(option);
  // CLI11 writes of an option that may be repeated as if it took several values at once.
  constexpr std::string_view kMore = " ...";
  const std::size_t more = text.find(kMore);
  if (more != std::string::npos && !option->get_allow_extra_args()) text.erase(more, kMore.size());
  return text;
}

std::string Help::make_option_usage(const CLI::Option* option) const {
  std::string text = option->get_type_name();
  const bool many = option->get_expected_max() >= CLI::detail::expected_max_vector_size;
  if (many && text.find("...") == std::string::npos) text += "...";
  return option->get_required() ? text : "[" + text + "]";
}

}  // namespace rave::cli
