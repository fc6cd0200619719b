// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Sums of many numbers by packs: on every instruction set the parts add up to the exact sum of any numbers.

#include "pack_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "hooke/backends/cpu/isa.h"
#include "hooke/base/exact_sum.h"
#include "numbers_to_sum.h"

namespace hooke::test {
namespace {

template <class Real>
void add_numbers(const std::string& isa, const std::vector<Real>& values, ExactParts& parts) {
#if defined(__x86_64__)
  if (isa == "avx512") return avx512::add_numbers(values.data(), values.size(), parts);
  if (isa == "avx2") return avx2::add_numbers(values.data(), values.size(), parts);
#endif
  portable::add_numbers(values.data(), values.size(), parts);
}

// The parts' sum minus the values' sum: 0 where the parts are exact.
template <class Real>
double remainder_of(const std::vector<Real>& values, const ExactParts& parts) {
  ExactSum sum;
  sum.add(parts.values, parts.count);
  for (const Real value : values) sum.add(-static_cast<double>(value));
  return sum.value();
}

template <class Real>
void check_parts() {
  for (const Isa& isa : available_isas()) {
    for (const Kind kind : {Kind::alike, Kind::mixed, Kind::wild, Kind::cancelling, Kind::zero, Kind::tiny}) {
      for (const std::size_t count : {16U, 64U, 208U, 1024U}) {
        std::vector<Real> values(count);
        for (std::size_t i = 0; i < count; ++i) values[i] = number<Real>(kind, i);
        ExactParts parts;
        parts.count = 0;
        add_numbers(isa.name, values, parts);
        EXPECT_EQ(remainder_of(values, parts), 0) << isa.name << ", kind " << static_cast<int>(kind) << ", " << count;
        EXPECT_LE(parts.count, ExactParts::kMost);
      }
    }
  }
}

TEST(PackSums, OfFloatsAreExact) { check_parts<float>(); }
TEST(PackSums, OfDoublesAreExact) { check_parts<double>(); }

// Parts are added to the parts already there. However many alike numbers are summed, they leave only a few parts: one
// a lane for floats, two a lane for doubles.
TEST(PackSums, LeaveFewPartsOfNumbersThatAreAlike) {
  for (const Isa& isa : available_isas()) {
    std::vector<float> floats(1024);
    std::vector<double> doubles(1024), all;
    for (std::size_t i = 0; i < 1024; ++i) {
      floats[i] = number<float>(Kind::alike, i);
      doubles[i] = number<double>(Kind::mixed, i);
    }
    ExactParts parts;
    parts.count = 0;
    add_numbers(isa.name, floats, parts);
    EXPECT_LE(parts.count, 16U) << isa.name;
    add_numbers(isa.name, doubles, parts);
    EXPECT_LE(parts.count, 32U) << isa.name;
    all.insert(all.end(), floats.begin(), floats.end());
    all.insert(all.end(), doubles.begin(), doubles.end());
    EXPECT_EQ(remainder_of(all, parts), 0) << isa.name;
  }
}

}  // namespace
}  // namespace hooke::test
