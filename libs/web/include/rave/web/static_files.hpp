// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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

  /// Serves a file; `/` is `/index.html`. With gzip, if Accept-Encoding permits it. Status 304
  /// without a body if If-None-Match names what would be sent. Files below `/assets/` have a hash
  /// in their names, so browsers may cache them without limit, except for HTML, whose names do not
  /// change. Any thread.
  [[nodiscard]] Response serve(const Request& request) const;

 private:
  struct File {
    std::string type;
    std::uint64_t hash = 0;
    std::shared_ptr<const std::string> plain;
    std::shared_ptr<const std::string> gzip;  ///< Null: compression does not make it smaller.
  };
  std::map<std::string, File, std::less<>> files_;
};

}  // namespace rave::web
