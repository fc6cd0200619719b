// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/shuffle_deflate.h"

#include <zlib.h>

#include <array>
#include <cmath>
#include <new>

#include "hooke/base/assert.h"

namespace hooke::io {

namespace {

/// Whether Huffman codes alone would save a twentieth; samples some of the bytes.
bool is_compressible(const std::string& bytes, std::size_t begin, std::size_t size) {
  constexpr std::size_t kSamples = 8192;
  const std::size_t stride = size / kSamples + 1;
  std::array<double, 256> count{};
  double samples = 0;
  for (std::size_t i = 0; i < size; i += stride, ++samples) ++count[static_cast<unsigned char>(bytes[begin + i])];
  double bits = 0;
  for (const double n : count) {
    if (n > 0) bits -= n / samples * std::log2(n / samples);
  }
  return bits < 0.95 * 8;
}

class Deflate {
 public:
  Deflate() {
    if (deflateInit(&stream_, 1) != Z_OK) throw std::bad_alloc();
  }
  ~Deflate() { deflateEnd(&stream_); }
  Deflate(const Deflate&) = delete;
  Deflate& operator=(const Deflate&) = delete;

  z_stream& stream() { return stream_; }

 private:
  z_stream stream_{};
};

}  // namespace

std::string shuffle_deflate(const void* data, std::size_t count, std::size_t element_size) {
  HOOKE_ASSERT(element_size > 0 && (data != nullptr || count == 0), count, element_size);
  const char* elements = static_cast<const char*>(data);
  std::string planes(count * element_size, '\0');
  for (std::size_t k = 0; k < element_size; ++k) {
    char* plane = planes.data() + k * count;
    for (std::size_t i = 0; i < count; ++i) plane[i] = elements[i * element_size + k];
  }

  Deflate deflater;
  z_stream& stream = deflater.stream();
  // Room for every change of level too, because each one ends a block.
  std::string out(deflateBound(&stream, static_cast<uLong>(planes.size())) + 64 * element_size + 64, '\0');
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  for (std::size_t k = 0; k < element_size; ++k) {
    deflateParams(&stream, is_compressible(planes, k * count, count) ? 1 : 0, Z_DEFAULT_STRATEGY);
    stream.next_in = reinterpret_cast<Bytef*>(planes.data() + k * count);
    stream.avail_in = static_cast<uInt>(count);
    deflate(&stream, k + 1 < element_size ? Z_NO_FLUSH : Z_FINISH);
  }
  out.resize(stream.total_out);
  return out;
}

}  // namespace hooke::io
