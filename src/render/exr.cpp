// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <algorithm>
#include <cstring>
#include <exception>

#include "hooke/render/linear_image.h"

namespace hooke::render {

namespace {

/// A file in memory.
class Bytes final : public Imf::OStream {
 public:
  Bytes() : Imf::OStream("picture") {}
  void write(const char from[], int count) override {
    const auto end = place_ + static_cast<std::size_t>(count);
    if (end > text.size()) text.resize(end);
    std::memcpy(text.data() + place_, from, static_cast<std::size_t>(count));
    place_ = end;
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t to) override { place_ = to; }

  std::string text;

 private:
  std::size_t place_ = 0;
};

half to_half(float value) { return half(std::min(value, static_cast<float>(HALF_MAX))); }

}  // namespace

bool has_openexr() { return true; }

Expected<std::string> encode_exr(const LinearImage& image) {
  HOOKE_ASSERT(image.width > 0 && image.height > 0, image.width, image.height);
  try {
    std::vector<Imf::Rgba> pixels;
    pixels.reserve(image.pixels.size() / LinearImage::kChannels);
    for (std::size_t i = 0; i < image.pixels.size(); i += LinearImage::kChannels) {
      const float* p = &image.pixels[i];
      pixels.emplace_back(to_half(p[0]), to_half(p[1]), to_half(p[2]), to_half(p[3]));
    }
    Imf::Header header(image.width, image.height);
    Imf::addChromaticities(header, Imf::Chromaticities());  // of sRGB
    Bytes bytes;
    {
      Imf::RgbaOutputFile file(bytes, header, Imf::WRITE_RGBA);
      file.setFrameBuffer(pixels.data(), 1, static_cast<std::size_t>(image.width));
      file.writePixels(image.height);
    }  // the table of its lines is written now
    return std::move(bytes.text);
  } catch (const std::exception& error) {
    return fail(Error::Kind::io, "OpenEXR", error.what());
  }
}

}  // namespace hooke::render
