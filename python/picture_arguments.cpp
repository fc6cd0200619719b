// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "picture_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hooke::python {

run::PictureArguments to_picture_arguments(std::pair<int, int> size, const std::string& color_by,
                                           const std::optional<std::array<double, 2>>& range, int samples, bool legend,
                                           bool alpha) {
  constexpr int kLargest = 16384;  // pixels
  run::PictureArguments arguments;
  for (const int pixels : {size.first, size.second}) {
    if (pixels < 1 || pixels > kLargest) {
      raise_input("size",
                  fmt::format("({}, {}): width and height must be 1 to {} pixels", size.first, size.second, kLargest));
    }
  }
  if (samples < 1 || samples > 4) raise_input("samples", fmt::format("{} must be 1 to 4", samples));
  if (range && !(std::isfinite((*range)[0]) && std::isfinite((*range)[1]) && (*range)[0] < (*range)[1])) {
    raise_input("range", fmt::format("({}, {}) must be two ascending numbers", (*range)[0], (*range)[1]));
  }
  const auto* const known = std::find_if(std::begin(render::kColorByNames), std::end(render::kColorByNames),
                                         [&](const render::ColorByName& name) { return name.name == color_by; });
  if (known == std::end(render::kColorByNames)) {
    std::string names;
    for (const render::ColorByName& name : render::kColorByNames)
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name.name);
    raise_input("color_by", fmt::format("\"{}\" is not known; known are {}", color_by, names));
  }
  arguments.width = size.first;
  arguments.height = size.second;
  arguments.color_by = known->by;
  arguments.range = range;
  arguments.samples = samples;
  arguments.legend = legend;
  arguments.alpha = alpha;
  return arguments;
}

py::array to_array(render::Image image, bool alpha) {
  const auto kept = std::make_shared<render::Image>(std::move(image));
  constexpr auto kChannels = static_cast<py::ssize_t>(render::Image::kChannels);
  const auto width = static_cast<py::ssize_t>(kept->width), height = static_cast<py::ssize_t>(kept->height);
  return view(kept, py::dtype::of<std::uint8_t>(), {height, width, alpha ? kChannels : kChannels - 1},
              {kChannels * width, kChannels, 1}, kept->pixels.data());
}

}  // namespace hooke::python
