// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/web/message.hpp"

namespace rave::web {

/// The files of a folder, read once and kept in memory, also compressed. Requests never read the
/// disk, so no path can lead out of the folder.
class StaticFiles {
 public:
  /// Reads all files below `folder`, 64 MiB at most. Errors: kNotFound, kIo.
  [[nodiscard]] static Result<StaticFiles> load(const std::filesystem::path& folder);

  /// Serves a file; `/` is `/index.html`. Files below `/assets/` have a hash in their names, so
  /// browsers may cache them without limit.
  [[nodiscard]] Response serve(const Request& request) const;

 private:
  struct File {
    std::string type;
    std::string tag;
    std::shared_ptr<const std::string> plain;
    std::shared_ptr<const std::string> gzip;  ///< Null: compression does not make it smaller.
  };
  std::map<std::string, File, std::less<>> files_;
};

}  // namespace rave::web
