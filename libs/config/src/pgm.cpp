// SPDX-License-Identifier: Apache-2.0
// Format: http://netpbm.sourceforge.net/doc/pgm.html
#include <cstdint>
#include <optional>

#include "image_size.hpp"
#include "rave/config/map_image.hpp"

namespace rave::config {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

/// Reads the tokens of a PGM: numbers separated by white space and comments.
class PgmScanner {
 public:
  PgmScanner(std::string_view bytes, std::size_t start) : bytes_(bytes), next_(start) {}

  /// The next number up to 10^9; empty at the end or before anything else.
  std::optional<std::uint32_t> number() {
    skip_blank();
    std::uint32_t value = 0;
    const std::size_t start = next_;
    while (next_ < bytes_.size() && bytes_[next_] >= '0' && bytes_[next_] <= '9') {
      value = value * 10 + static_cast<std::uint32_t>(bytes_[next_] - '0');
      if (value > 1'000'000'000) return std::nullopt;
      ++next_;
    }
    return next_ == start ? std::nullopt : std::optional(value);
  }
  [[nodiscard]] bool at_end() {
    skip_blank();
    return next_ >= bytes_.size();
  }
  /// The data after the single white space that ends the header.
  [[nodiscard]] std::string_view raster() const {
    return next_ < bytes_.size() && is_space(bytes_[next_]) ? bytes_.substr(next_ + 1)
                                                            : std::string_view{};
  }

 private:
  void skip_blank() {
    while (next_ < bytes_.size()) {
      if (bytes_[next_] == '#') {
        while (next_ < bytes_.size() && bytes_[next_] != '\n') ++next_;
      } else if (!is_space(bytes_[next_])) {
        return;
      } else {
        ++next_;
      }
    }
  }

  std::string_view bytes_;
  std::size_t next_;
};

struct Header {
  GreyImage image;
  std::uint32_t max_value = 0;
  std::size_t pixels = 0;
};

// Rounded to the nearest of 256 shades; values above the largest are white.
std::uint8_t to_shade(std::uint32_t value, std::uint32_t max_value) {
  if (value >= max_value) return 255;
  return static_cast<std::uint8_t>((value * 255U + max_value / 2) / max_value);
}

Result<Header> read_header(PgmScanner& scanner, std::string_view name) {
  const auto width = scanner.number();
  const auto height = scanner.number();
  const auto max_value = scanner.number();
  if (!width || !height || !max_value) {
    return fail(ErrorCode::kParse, "`{}`: the PGM header is cut or damaged", name);
  }
  RAVE_TRY(check_image_size(*width, *height, name));
  if (*max_value < 1 || *max_value > 65535) {
    return fail(ErrorCode::kParse, "`{}`: the PGM's largest grey value is {}, expected 1 to 65535",
                name, *max_value);
  }
  Header header;
  header.image.width = static_cast<int>(*width);
  header.image.height = static_cast<int>(*height);
  header.max_value = *max_value;
  header.pixels = std::size_t{*width} * *height;
  return header;
}

tl::unexpected<Error> cut(std::string_view name, std::size_t found, std::size_t expected,
                          std::string_view what) {
  return fail(ErrorCode::kParse, "`{}`: the image is cut: {} of {} {}", name, found, expected,
              what);
}

Status read_ascii(PgmScanner& scanner, std::string_view name, Header& header) {
  for (std::size_t i = 0; i < header.pixels; ++i) {
    const auto value = scanner.number();
    if (!value && scanner.at_end()) return cut(name, i, header.pixels, "pixels");
    if (!value || *value > header.max_value) {
      return fail(ErrorCode::kParse, "`{}`: pixel {} is not a number from 0 to {}", name, i + 1,
                  header.max_value);
    }
    header.image.shade.push_back(to_shade(*value, header.max_value));
  }
  return {};
}

Status read_binary(std::string_view raster, std::string_view name, Header& header) {
  const std::size_t depth = header.max_value > 255 ? 2 : 1;
  if (raster.size() < header.pixels * depth) {
    return cut(name, raster.size(), header.pixels * depth, "bytes");
  }
  header.image.shade.resize(header.pixels);
  for (std::size_t i = 0; i < header.pixels; ++i) {
    std::uint32_t value = static_cast<unsigned char>(raster[i * depth]);
    // Two bytes per pixel have the more significant one first.
    if (depth == 2) value = (value << 8) | static_cast<unsigned char>(raster[i * depth + 1]);
    header.image.shade[i] = to_shade(value, header.max_value);
  }
  return {};
}

}  // namespace

Result<GreyImage> decode_pgm(std::string_view bytes, std::string_view file_name) {
  const bool ascii = bytes.starts_with("P2");
  if (!ascii && !bytes.starts_with("P5")) {
    return fail(ErrorCode::kParse, "`{}`: not a PGM image", file_name);
  }
  PgmScanner scanner(bytes, 2);
  RAVE_TRY_ASSIGN(Header header, read_header(scanner, file_name));
  // Memory is allocated only after the data is known to have the size in the header.
  RAVE_TRY(ascii ? read_ascii(scanner, file_name, header)
                 : read_binary(scanner.raster(), file_name, header));
  header.image.opaque.assign(header.pixels, 1);
  return std::move(header.image);
}

}  // namespace rave::config
