// SPDX-License-Identifier: Apache-2.0
#include "people/link_file.hpp"

#include <fmt/format.h>

#include <utility>

#include "rave/base/file.hpp"
#include "rave/base/markup.hpp"

namespace rave::gui_server {

Result<LinkFile> LinkFile::write(const std::filesystem::path& folder, const std::string& name,
                                 const std::string& link) {
  LinkFile file(folder / name);
  const std::string to = escaped_markup(link);
  RAVE_TRY(write_private_file_atomically(
      file.path_,
      fmt::format("<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>RAVE</title>"
                  "<meta name=\"referrer\" content=\"no-referrer\">"
                  "<meta http-equiv=\"refresh\" content=\"0;url={0}\">"
                  "<p><a href=\"{0}\">Open the page</a></p></html>\n",
                  to)));
  return file;
}

LinkFile::LinkFile(LinkFile&& other) noexcept : path_(std::exchange(other.path_, {})) {}

LinkFile& LinkFile::operator=(LinkFile&& other) noexcept {
  std::swap(path_, other.path_);
  return *this;
}

LinkFile::~LinkFile() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove(path_, ignored);
}

}  // namespace rave::gui_server
