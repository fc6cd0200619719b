// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The machine's limits, to compare Hooke with: bytes from and to memory, and additions and multiplications of floats by
// instruction set. Without fused operations, because Hooke's laws use none.

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace hooke {
namespace {

// On one thread and on all.
void with_threads(benchmark::internal::Benchmark* benchmark) {
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  benchmark->UseRealTime()->Threads(1);
  if (cores > 1) benchmark->Threads(cores);
}

// Reads and writes much more than caches hold, each thread its own part; bytes read and bytes written both count.
void memory(benchmark::State& state) {
  constexpr std::size_t kNumbers = std::size_t{1} << 24U;  // 128 MiB
  std::vector<double> numbers(kNumbers, 1.0);
  for (auto iteration : state) {
    for (double& number : numbers) number *= -1.0;
    benchmark::ClobberMemory();
  }
  const double right = state.iterations() % 2 == 0 ? 1.0 : -1.0;
  if (numbers.front() != right || numbers.back() != right) return state.SkipWithError("wrong numbers");
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(2 * kNumbers * sizeof(double)));
}
BENCHMARK(memory)->Apply(with_threads)->Unit(benchmark::kMillisecond);

constexpr std::size_t kChains = 6;  // of each kind: enough to hide the latency, few enough for 16 registers
constexpr std::int64_t kRounds = 1'000'000;

typedef float Float4 __attribute__((vector_size(16)));
typedef float Float8 __attribute__((vector_size(32)));
typedef float Float16 __attribute__((vector_size(64)));

// As many additions as multiplications, in independent chains; returns the result of one chain of additions.
template <class Vector>
inline __attribute__((always_inline)) float run_chains(float one) {
  Vector sums[kChains], products[kChains];
  for (std::size_t c = 0; c < kChains; ++c) {
    sums[c] = Vector{};
    products[c] = Vector{} + one;
  }
  const Vector ones = Vector{} + one;
  for (std::int64_t round = 0; round < kRounds; ++round) {
    for (std::size_t c = 0; c < kChains; ++c) {
      sums[c] += ones;
      products[c] *= ones;
    }
  }
  float result = 0;
  for (std::size_t c = 0; c < kChains; ++c) result += sums[c][c % 4] * products[c][c % 3];
  return result / static_cast<float>(kChains);
}

float portable(float one) { return run_chains<Float4>(one); }
__attribute__((target("avx2"))) float avx2(float one) { return run_chains<Float8>(one); }
__attribute__((target("avx512f"))) float avx512(float one) { return run_chains<Float16>(one); }

void arithmetic(benchmark::State& state, float (*chains)(float), std::size_t lanes, bool available) {
  if (!available) return state.SkipWithError("not on this processor");
  float one = 1, sum = 0;
  for (auto iteration : state) {
    benchmark::DoNotOptimize(one);
    benchmark::DoNotOptimize(sum = chains(one));
  }
  if (sum != static_cast<float>(kRounds)) return state.SkipWithError("wrong sum");
  state.SetItemsProcessed(state.iterations() * kRounds * static_cast<std::int64_t>(2 * kChains * lanes));
}
BENCHMARK_CAPTURE(arithmetic, portable, portable, 4, true)->Apply(with_threads);
BENCHMARK_CAPTURE(arithmetic, avx2, avx2, 8, __builtin_cpu_supports("avx2") != 0)->Apply(with_threads);
BENCHMARK_CAPTURE(arithmetic, avx512, avx512, 16, __builtin_cpu_supports("avx512f") != 0)->Apply(with_threads);

}  // namespace
}  // namespace hooke
