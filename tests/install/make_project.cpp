// SPDX-License-Identifier: Apache-2.0
// `rave new` without the command line. Usage: make_project KIND NAME TEMPLATES TARGET
#include <cstdio>

#include "new_project.hpp"

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: %s KIND NAME TEMPLATES TARGET\n", argv[0]);
    return 2;
  }
  const auto kind = rave::cli::parse_project_kind(argv[1]);
  const rave::Status made = kind ? rave::cli::create_project(*kind, argv[2], argv[3], argv[4])
                                 : rave::Status(tl::unexpected<rave::Error>(kind.error()));
  if (!made) std::fprintf(stderr, "%s\n", made.error().text().c_str());
  return made ? 0 : 1;
}
