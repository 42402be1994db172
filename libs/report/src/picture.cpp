// SPDX-License-Identifier: Apache-2.0
#include "rave/report/picture.hpp"

#include <cairo-svg.h>
#include <cairo.h>

#include <cmath>
#include <memory>
#include <new>

#include "leak_notes.hpp"
#include "page.hpp"
#include "rave/base/file.hpp"
#include "svg_text.hpp"

namespace rave::report {
namespace {

/// cairo's limit of the side of an image.
constexpr double kMostPixels = 32767;

struct Release {
  void operator()(cairo_surface_t* surface) const noexcept { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const noexcept { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, Release>;
using Context = std::unique_ptr<cairo_t, Release>;

cairo_status_t append(void* content, const unsigned char* data, unsigned int length) {
  try {
    static_cast<std::string*>(content)->append(data, data + length);
  } catch (const std::bad_alloc&) {
    // An exception must not pass through the C code of cairo.
    return CAIRO_STATUS_NO_MEMORY;
  }
  return CAIRO_STATUS_SUCCESS;
}

Status check_cairo(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return {};
  return fail(ErrorCode::kState, "picture: cairo says: {}", cairo_status_to_string(status));
}

Status draw_on(cairo_surface_t* surface, const Picture& picture, const Layout& layout,
               double scale) {
  link_leak_notes();
  RAVE_TRY(check_cairo(cairo_surface_status(surface)));
  const Context context(cairo_create(surface));
  cairo_scale(context.get(), scale, scale);
  Pen pen(context.get());
  draw_page(pen, picture, layout);
  return check_cairo(cairo_status(context.get()));
}

Status write_whole(const std::filesystem::path& path, const std::string& content) {
  std::error_code ignored;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, ignored)) {
    return fail(ErrorCode::kNotFound, "cannot write `{}`: there is no folder `{}`", path.string(),
                folder.string());
  }
  return write_file_atomically(path, content);
}

}  // namespace

Status write_svg(const Picture& picture, const std::filesystem::path& path) {
  RAVE_TRY_ASSIGN(const Layout layout, lay_out(picture));
  std::string content;
  {
    const Surface surface(
        cairo_svg_surface_create_for_stream(append, &content, layout.width, layout.height));
    cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
    RAVE_TRY(draw_on(surface.get(), picture, layout, 1));
    // Only then everything has been written to the stream.
    cairo_surface_finish(surface.get());
    RAVE_TRY(check_cairo(cairo_surface_status(surface.get())));
  }
  return write_whole(path, finished_svg(std::move(content), picture));
}

Status write_png(const Picture& picture, const std::filesystem::path& path, double scale) {
  if (!std::isfinite(scale) || scale < 0.1 || scale > 8) {
    return fail(ErrorCode::kInvalidArgument, "picture: scale is {}; expected 0.1 to 8", scale);
  }
  RAVE_TRY_ASSIGN(const Layout layout, lay_out(picture));
  const double width = std::ceil(layout.width * scale);
  const double height = std::ceil(layout.height * scale);
  // cairo would only say that the size is invalid.
  if (width > kMostPixels || height > kMostPixels) {
    return fail(ErrorCode::kInvalidArgument, "picture: {} x {} pixels are more than {} a side",
                width, height, kMostPixels);
  }
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width),
                                                   static_cast<int>(height)));
  RAVE_TRY(draw_on(surface.get(), picture, layout, scale));
  std::string content;
  RAVE_TRY(check_cairo(cairo_surface_write_to_png_stream(surface.get(), append, &content)));
  return write_whole(path, content);
}

}  // namespace rave::report
