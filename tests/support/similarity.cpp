// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "support/similarity.h"

#include <algorithm>

namespace hooke::test {
namespace {

constexpr int kWindow = 8;

double similarity_of_window(const render::Image& a, const render::Image& b, int left, int top, int channel) {
  double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
  for (int y = top; y < top + kWindow; ++y) {
    for (int x = left; x < left + kWindow; ++x) {
      const double p = a.at(x, y)[channel], q = b.at(x, y)[channel];
      sum_a += p;
      sum_b += q;
      sum_aa += p * p;
      sum_bb += q * q;
      sum_ab += p * q;
    }
  }
  constexpr double kCount = kWindow * kWindow;
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255, kC2 = 0.03 * 255 * 0.03 * 255;  // of the article
  const double mean_a = sum_a / kCount, mean_b = sum_b / kCount;
  const double variance_a = sum_aa / kCount - mean_a * mean_a, variance_b = sum_bb / kCount - mean_b * mean_b;
  const double covariance = sum_ab / kCount - mean_a * mean_b;
  return (2 * mean_a * mean_b + kC1) * (2 * covariance + kC2) /
         ((mean_a * mean_a + mean_b * mean_b + kC1) * (variance_a + variance_b + kC2));
}

}  // namespace

double similarity(const render::Image& a, const render::Image& b) {
  if (a.width != b.width || a.height != b.height || a.width < kWindow || a.height < kWindow) return 0;
  double worst = 1;
  for (int channel = 0; channel < 3; ++channel) {
    double sum = 0;
    for (int top = 0; top + kWindow <= a.height; ++top) {
      for (int left = 0; left + kWindow <= a.width; ++left) sum += similarity_of_window(a, b, left, top, channel);
    }
    worst = std::min(worst, sum / ((a.width - kWindow + 1.0) * (a.height - kWindow + 1.0)));
  }
  return worst;
}

}  // namespace hooke::test
