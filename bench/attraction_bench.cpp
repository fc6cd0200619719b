// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Attraction by itself: the sum over every pair, counted at 20 flops a pair, against the machine's peak with fused
// operations; and the tree at the requested accuracy. A wrong result has no speed.

#include <benchmark/benchmark.h>
#include <immintrin.h>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include "clusters.h"
#include "hooke/backends/cpu/attraction_sums.h"
#include "hooke/backends/cpu/isa.h"
#include "hooke/base/parallel.h"
#include "hooke/base/threads.h"

namespace hooke::bench {
namespace {

constexpr double kSoftening2 = 1e-8;
constexpr double kFlops = 20;  // an interaction, the usual count
constexpr std::size_t kChecked = 10'000;  // particles in the check of the error

int cores() { return static_cast<int>(std::thread::hardware_concurrency()); }

// Fused multiply-adds of floats in twelve chains, two flops a lane; returns the result of a chain.
constexpr std::int64_t kRounds = 4'000'000;
constexpr std::size_t kChains = 12;

__attribute__((target("avx512f"))) float fused_avx512(float one) {
  __m512 chain[kChains];
  const __m512 ones = _mm512_set1_ps(one);
  for (__m512& c : chain) c = ones;
  for (std::int64_t round = 0; round < kRounds; ++round) {
    for (__m512& c : chain) c = _mm512_fmadd_ps(c, ones, ones);
  }
  float sum = 0;
  for (const __m512& c : chain) sum += _mm512_cvtss_f32(c);
  return sum;
}
__attribute__((target("avx2,fma"))) float fused_avx2(float one) {
  __m256 chain[kChains];
  const __m256 ones = _mm256_set1_ps(one);
  for (__m256& c : chain) c = ones;
  for (std::int64_t round = 0; round < kRounds; ++round) {
    for (__m256& c : chain) c = _mm256_fmadd_ps(c, ones, ones);
  }
  float sum = 0;
  for (const __m256& c : chain) sum += _mm256_cvtss_f32(c);
  return sum;
}

// flop/s of one thread at this moment; on a shared machine the figure changes from moment to moment.
double measured_peak() {
  const bool wide = __builtin_cpu_supports("avx512f") != 0;
  if (!wide && __builtin_cpu_supports("fma") == 0) return 0;
  const auto start = std::chrono::steady_clock::now();
  benchmark::DoNotOptimize(wide ? fused_avx512(1) : fused_avx2(1));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return static_cast<double>(kRounds) * kChains * 2 * (wide ? 16 : 8) / seconds;
}

template <class Real>
AttractionLoops<Real> loops_of(const Isa& isa) {
  if constexpr (sizeof(Real) == 4) {
    return isa.single_loops.attraction;
  } else {
    return isa.double_loops.attraction;
  }
}

template <class Real>
std::vector<AttractionPoint<Real>> points_at(const std::vector<Vec3d>& positions) {
  std::vector<AttractionPoint<Real>> points;
  points.reserve(positions.size());
  for (const Vec3d& x : positions) {
    const auto k = static_cast<std::uint32_t>(points.size());
    points.push_back({{static_cast<Real>(x.x), static_cast<Real>(x.y), static_cast<Real>(x.z), Real(1)}, k, k});
  }
  return points;
}

IdTable ids_for(std::size_t count) {
  std::vector<std::uint64_t> ids(count);
  for (std::size_t i = 0; i < count; ++i) ids[i] = i + 1;
  return IdTable(ids);
}

// Accelerations of every `stride`-th particle, summed pair by pair in double precision.
std::vector<Vec3d> pulls_on(const std::vector<Vec3d>& positions, std::size_t stride) {
  const auto points = points_at<float>(positions);
  std::vector<AttractionSource<double>> sources;
  for (const auto& p : points) sources.push_back({p.source.x, p.source.y, p.source.z, 1});
  const auto loops = loops_of<double>(available_isas().front());
  constexpr std::size_t kMost = AttractionTargets<double>::kMost;
  std::vector<Vec3d> a((positions.size() + stride - 1) / stride);
  parallel_ranges(a.size(), kMost, [&](std::size_t first, std::size_t last) {
    for (std::size_t from = first; from < last; from += kMost) {
      AttractionTargets<double> t{};
      t.count = kMost;
      for (std::size_t i = 0; i < kMost; ++i) {
        const auto& p = sources[std::min(from + i, a.size() - 1) * stride];
        t.x[i] = p.x;
        t.y[i] = p.y;
        t.z[i] = p.z;
      }
      loops.pull_by_particles({&t, sources.data(), sources.size(), nullptr, 0, kSoftening2, true});
      for (std::size_t i = 0; i < kMost && from + i < last; ++i) a[from + i] = {t.ax[i], t.ay[i], t.az[i]};
    }
  });
  return a;
}

template <class Real>
double rms_error(const std::vector<Vec3<Real>>& a, const std::vector<Vec3d>& right, std::size_t stride) {
  double sum = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    const Vec3d off = vec_cast<double>(a[i * stride]) - right[i];
    sum += dot(off, off) / dot(right[i], right[i]);
  }
  return std::sqrt(sum / static_cast<double>(right.size()));
}

template <class Real>
void direct(benchmark::State& state, const Isa& isa, bool exact, int threads) {
  constexpr std::size_t kCount = 32'768;
  const auto positions = plummer_sphere(kCount, 1, 10, 1);
  const auto points = points_at<Real>(positions);
  const IdTable ids = ids_for(kCount);
  AttractionSums<Real> sums;
  Attraction attraction;
  attraction.method = Attraction::Method::direct;
  attraction.exact = exact;
  sums.configure(attraction, kSoftening2, loops_of<Real>(isa));
  std::vector<Vec3<Real>> a(kCount);
  double peak = 0;  // flop/s, measured between the sums
  Threads(threads).run([&] {
    for (auto iteration : state) {
      state.PauseTiming();
      peak += measured_peak();
      auto working = points;
      state.ResumeTiming();
      sums.accelerations(working, working.size(), ids, a.data());
    }
    const double error = rms_error(a, pulls_on(positions, 16), 16);
    if (!(error < 1e-5)) state.SkipWithError("wrong forces");
  });
  const auto n = static_cast<double>(kCount);
  const double iterations = static_cast<double>(state.iterations());
  state.counters["flops"] = benchmark::Counter(iterations * n * n * kFlops, benchmark::Counter::kIsRate);
  state.counters["fma_peak"] = peak / iterations * threads;
  state.counters["of_peak"] =
      benchmark::Counter(iterations * n * n * kFlops / (peak / iterations * threads), benchmark::Counter::kIsRate);
}

template <class Real>
void tree(benchmark::State& state, bool exact, double accuracy) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const auto positions = plummer_sphere(count, 1, 20, 1);
  const auto points = points_at<Real>(positions);
  const IdTable ids = ids_for(count);
  AttractionSums<Real> sums;
  Attraction attraction;
  attraction.method = Attraction::Method::tree;
  attraction.exact = exact;
  attraction.accuracy = accuracy;
  sums.configure(attraction, kSoftening2, loops_of<Real>(available_isas().front()));
  std::vector<Vec3<Real>> a(count);
  for (auto iteration : state) {
    state.PauseTiming();
    auto working = points;
    state.ResumeTiming();
    sums.accelerations(working, working.size(), ids, a.data());
  }
  const std::size_t stride = std::max<std::size_t>(1, count / kChecked);
  const double error = rms_error(a, pulls_on(positions, stride), stride);
  if (!(error < accuracy)) state.SkipWithError("less accurate than asked for");
  state.counters["rms_error"] = error;
  state.counters["particles/s"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(count), benchmark::Counter::kIsRate);
}

template <class Real>
void add_direct(const std::string& precision) {
  for (const Isa& isa : available_isas()) {
    for (const bool exact : {true, false}) {
      for (int threads = 1; threads <= cores(); threads += std::max(1, cores() - 1)) {
        const std::string name =
            "direct/" + precision + "/" + isa.name + (exact ? "/exact/" : "/fast/") + std::to_string(threads);
        benchmark::RegisterBenchmark(name.c_str(), direct<Real>, isa, exact, threads)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
}

void add_tree(const std::string& name, void (*body)(benchmark::State&, bool, double), bool exact, double accuracy) {
  benchmark::RegisterBenchmark(name.c_str(), body, exact, accuracy)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond)
      ->RangeMultiplier(10)
      ->Range(10'000, 1'000'000);
}

}  // namespace
}  // namespace hooke::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  hooke::bench::add_direct<float>("single");
  hooke::bench::add_direct<double>("double");
  hooke::bench::add_tree("tree/single/exact/1e-3", hooke::bench::tree<float>, true, 1e-3);
  hooke::bench::add_tree("tree/single/fast/1e-3", hooke::bench::tree<float>, false, 1e-3);
  hooke::bench::add_tree("tree/double/exact/1e-5", hooke::bench::tree<double>, true, 1e-5);
  benchmark::RunSpecifiedBenchmarks();
}
