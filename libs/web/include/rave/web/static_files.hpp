// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/web/message.hpp"

namespace rave::web {

/// The files of a folder, read once and kept in memory with a compressed form. Nothing else of the
/// disk can be asked for, so no path leads out of the folder.
class StaticFiles {
 public:
  /// Reads all files below `folder`, 64 MiB at most. Errors: kNotFound, kIo.
  [[nodiscard]] static Result<StaticFiles> load(const std::filesystem::path& folder);

  /// `/` is `/index.html`. Files below `/assets/`, whose names have a hash, may be kept for ever,
  /// except for HTML, whose name stays.
  [[nodiscard]] Response serve(const Request& request) const;

 private:
  struct File {
    std::string type;
    std::string tag;
    std::shared_ptr<const std::string> plain;
    std::shared_ptr<const std::string> gzip;  ///< Null: compressing it gains nothing.
  };
  std::map<std::string, File, std::less<>> files_;
};

}  // namespace rave::web
