// SPDX-License-Identifier: Apache-2.0
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <string>

#include "image_size.hpp"
#include "rave/config/map_image.hpp"

namespace rave::config {
namespace {

/// Decodes one PNG. libpng reports errors by longjmp, which must not skip destructors: objects that
/// exist across a jump are members, and each guarded function has no locals.
class PngDecoder {
 public:
  PngDecoder(std::string_view bytes, std::string_view name)
      : bytes_(bytes),
        name_(name),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning)) {
    if (png_) info_ = png_create_info_struct(png_);
  }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }

  Result<GreyImage> decode() {
    if (!info_) return fail(ErrorCode::kIo, "`{}`: cannot start the PNG decoder", name_);
    if (!read_header()) return failure();
    RAVE_TRY(check_image_size(width_, height_, name_));
    if (!set_up_rows()) return failure();
    // Interlaced images arrive in passes over all rows, others row by row.
    row_bytes_ = png_get_rowbytes(png_, info_);
    buffer_.resize(passes_ > 1 ? row_bytes_ * height_ : row_bytes_);
    image_.width = static_cast<int>(width_);
    image_.height = static_cast<int>(height_);
    for (pass_ = 0; pass_ < passes_; ++pass_) {
      for (row_ = 0; row_ < height_; ++row_) {
        if (!read_row()) return failure();
        if (pass_ + 1 == passes_) append_row();
      }
    }
    return std::move(image_);
  }

 private:
  static void on_error(png_structp png, png_const_charp message) {
    auto* self = static_cast<PngDecoder*>(png_get_error_ptr(png));
    std::strncpy(self->message_, message, sizeof self->message_ - 1);
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}
  static void on_read(png_structp png, png_bytep target, std::size_t count) {
    auto* self = static_cast<PngDecoder*>(png_get_io_ptr(png));
    if (self->bytes_.size() - self->next_ < count) png_error(png, "the image is cut");
    std::memcpy(target, self->bytes_.data() + self->next_, count);
    self->next_ += count;
  }

  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, this, on_read);
    png_set_user_limits(png_, 0x7FFFFFFF, 0x7FFFFFFF);  // check_image_size() has a better message
    // A small file may claim texts of gigabytes.
    png_set_chunk_malloc_max(png_, 8U << 20);
    png_read_info(png_, info_);
    width_ = png_get_image_width(png_, info_);
    height_ = png_get_image_height(png_, info_);
    return true;
  }

  bool set_up_rows() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_expand(png_);    // palettes to RGB, few bits to eight, transparent colours to alpha
    png_set_scale_16(png_);  // 16 bits to the nearest 8
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    channels_ = png_get_channels(png_, info_);
    return true;
  }

  bool read_row() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_row(png_, row_start(), nullptr);
    return true;
  }

  png_bytep row_start() { return buffer_.data() + (passes_ > 1 ? row_bytes_ * row_ : 0); }

  void append_row() {
    const bool has_alpha = channels_ == 2 || channels_ == 4;
    const std::size_t colours = channels_ - (has_alpha ? 1U : 0U);
    const png_byte* pixel = row_start();
    for (std::size_t i = 0; i < width_; ++i, pixel += channels_) {
      unsigned sum = 0;
      for (std::size_t c = 0; c < colours; ++c) sum += pixel[c];
      // The mean of the colours, rounded.
      image_.shade.push_back(static_cast<std::uint8_t>((sum + colours / 2) / colours));
      image_.opaque.push_back(!has_alpha || pixel[colours] == 255 ? 1 : 0);
    }
  }

  tl::unexpected<Error> failure() const {
    return fail(ErrorCode::kParse, "`{}`: PNG: {}", name_, message_);
  }

  std::string_view bytes_;
  std::string_view name_;
  std::size_t next_ = 0;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  char message_[120] = "damaged";
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  std::size_t row_bytes_ = 0;
  std::size_t row_ = 0;
  int passes_ = 1;
  int pass_ = 0;
  std::size_t channels_ = 1;
  std::vector<png_byte> buffer_;
  GreyImage image_;
};

}  // namespace

Result<GreyImage> decode_png(std::string_view bytes, std::string_view file_name) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  if (!bytes.starts_with(kSignature)) {
    return fail(ErrorCode::kParse, "`{}`: not a PNG image", file_name);
  }
  return PngDecoder(bytes, file_name).decode();
}

}  // namespace rave::config
