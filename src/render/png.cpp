// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include <png.h>

#include "hooke/base/assert.h"
#include "hooke/render/image.h"

namespace hooke::render {

namespace {

png_image describe(const Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  return png;
}

// libpng's simplified interface knows pixels of three bytes, or of four with alpha, but not of four without alpha.
std::vector<std::uint8_t> without_fourth_byte(const std::vector<std::uint8_t>& pixels) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(pixels.size() / Image::kChannels * 3);
  for (std::size_t i = 0; i < pixels.size(); i += Image::kChannels) rgb.insert(rgb.end(), &pixels[i], &pixels[i] + 3);
  return rgb;
}

}  // namespace

Expected<std::string> encode_png(const Image& image, bool alpha) {
  HOOKE_ASSERT(image.pixels.size() == Image(image.width, image.height).pixels.size(), image.width, image.height,
               image.pixels.size());
  png_image png = describe(image);
  if (alpha) png.format = PNG_FORMAT_RGBA;
  const std::vector<std::uint8_t> rgb = alpha ? std::vector<std::uint8_t>() : without_fourth_byte(image.pixels);
  const std::vector<std::uint8_t>& pixels = alpha ? image.pixels : rgb;
  // Asking libpng for the size first would compress twice; libpng's upper bound is cheaper.
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0) {
    return fail(Error::Kind::io, "PNG", png.message);
  }
  bytes.resize(size);
  return bytes;
}

Expected<Image> decode_png(const std::string& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    return fail(Error::Kind::bad_input, "PNG", png.message);
  }
  png.format = PNG_FORMAT_RGBA;
  Image image(static_cast<int>(png.width), static_cast<int>(png.height));
  if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0) {
    return fail(Error::Kind::bad_input, "PNG", png.message);
  }
  return image;
}

}  // namespace hooke::render
