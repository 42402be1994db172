// SPDX-License-Identifier: Apache-2.0
// The files of the page, read and packed once at the start: requests for them never touch the disk.
#include "rave/web/static_files.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <span>
#include <utility>

#include "rave/base/file.hpp"
#include "rave/base/hash.hpp"

namespace rave::web {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = std::uintmax_t{64} << 20U;

// With `nosniff` browsers run and show only what has the right type.
std::string type_of(const fs::path& path) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 11> kTypes = {{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".woff2", "font/woff2"},
      {".webmanifest", "application/manifest+json"},
      {".txt", "text/plain; charset=utf-8"},
      {".map", "application/json"},
  }};
  for (const auto& [ending, type] : kTypes) {
    if (path.extension() == ending) return std::string(type);
  }
  return "application/octet-stream";
}

/// Empty after an error.
std::string gzipped(const std::string& plain) {
  z_stream stream{};
  constexpr int kGzip = 15 + 16;
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, 9, Z_DEFAULT_STRATEGY) != Z_OK) {
    return {};
  }
  std::string packed(deflateBound(&stream, plain.size()), '\0');
  // zlib's interface is not const-correct; it does not write here.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
  stream.avail_in = static_cast<uInt>(plain.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int done = deflate(&stream, Z_FINISH);
  packed.resize(done == Z_STREAM_END ? stream.total_out : 0);
  deflateEnd(&stream);
  return packed;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// Cuts the first element off a list of a header, whose elements `separator` divides.
std::string_view cut_first(std::string_view& list, char separator) {
  const std::size_t end = list.find(separator);
  const std::string_view first = trimmed(list.substr(0, end));
  list = end == std::string_view::npos ? std::string_view() : list.substr(end + 1);
  return first;
}

/// Whether a weight (`q=0.5`) is above zero; without one it is 1.
bool is_wanted(std::string_view parameters) {
  while (!parameters.empty()) {
    const std::string_view one = cut_first(parameters, ';');
    if (!one.starts_with("q=") && !one.starts_with("Q=")) continue;
    return one.substr(2).find_first_not_of("0.") != std::string_view::npos;
  }
  return true;
}

/// Whether Accept-Encoding permits gzip (RFC 9110, section 12.5.3).
bool accepts_gzip(std::string_view accepted) {
  bool any = false;
  while (!accepted.empty()) {
    std::string_view element = cut_first(accepted, ',');
    const std::string_view coding = cut_first(element, ';');
    if (coding == "gzip") return is_wanted(element);
    if (coding == "*") any = is_wanted(element);
  }
  return any;
}

/// Whether If-None-Match names `tag`; its comparison is the weak one (RFC 9110, section 13.1.2).
bool names_tag(std::string_view known, std::string_view tag) {
  while (!known.empty()) {
    std::string_view one = cut_first(known, ',');
    if (one == "*") return true;
    if (one.starts_with("W/")) one.remove_prefix(2);
    if (one == tag) return true;
  }
  return false;
}

}  // namespace

Result<StaticFiles> StaticFiles::load(const fs::path& folder) {
  StaticFiles files;
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return fail(ErrorCode::kNotFound, "there is no folder `{}`", folder.string());
  }
  std::uintmax_t bytes = 0;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (!it->is_regular_file()) continue;
    RAVE_TRY_ASSIGN(std::string content, read_file(it->path()));
    bytes += content.size();
    if (bytes > kMostBytes) {
      return fail(ErrorCode::kIo, "`{}` has more than 64 MiB of files", folder.string());
    }
    File file;
    file.type = type_of(it->path());
    file.hash = content_hash(std::as_bytes(std::span(content)));
    std::string packed = gzipped(content);
    // Packed once, at the start; a small gain is not worth the work of the browser.
    if (!packed.empty() && packed.size() + 64 < content.size()) {
      file.gzip = std::make_shared<const std::string>(std::move(packed));
    }
    file.plain = std::make_shared<const std::string>(std::move(content));
    files.files_.emplace("/" + fs::relative(it->path(), folder).generic_string(), std::move(file));
  }
  if (error) return fail(ErrorCode::kIo, "cannot read `{}`: {}", folder.string(), error.message());
  return files;
}

Response StaticFiles::serve(const Request& request) const {
  const auto found = files_.find(request.path == "/" ? "/index.html" : request.path);
  if (found == files_.end()) return text_response(404, "not found\n");
  const File& file = found->second;
  const bool packed = file.gzip && accepts_gzip(request.header("accept-encoding"));
  // Bytes that differ have tags that differ: a cache must not take one for the other.
  const std::string tag = fmt::format("\"{:016x}{}\"", file.hash, packed ? "-gzip" : "");
  // Names of built files contain a hash of their content, so such a file never changes.
  const bool forever = request.path.starts_with("/assets/") && !request.path.ends_with(".html");
  Response response;
  response.type = file.type;
  response.headers.emplace_back("ETag", tag);
  response.headers.emplace_back("Cache-Control",
                                forever ? "public, max-age=31536000, immutable" : "no-cache");
  if (file.gzip) response.headers.emplace_back("Vary", "Accept-Encoding");
  if (names_tag(request.header("if-none-match"), tag)) {
    response.status = 304;
    return response;
  }
  if (packed) response.headers.emplace_back("Content-Encoding", "gzip");
  response.body = packed ? file.gzip : file.plain;
  return response;
}

}  // namespace rave::web
