// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Prints how alike two PNG files are, from 0 to 1 (support/similarity.h).

#include <cstdio>
#include <fstream>
#include <sstream>

#include "hooke/render/image.h"
#include "support/similarity.h"

namespace {

hooke::Expected<hooke::render::Image> read(const char* file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return hooke::render::decode_png(bytes.str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto a = read(argv[1]), b = read(argv[2]);
  if (!a || !b) {
    std::fprintf(stderr, "%s\n", (a ? b : a).error().text().c_str());
    return 2;
  }
  std::printf("%.4f\n", hooke::test::similarity(*a, *b));
  return 0;
}
