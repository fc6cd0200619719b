// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A steady step allocates nothing: it uses the memory of the steps before. This program counts every call of malloc and
// of operator new, except calls from inside oneTBB's library, which keeps tasks of its own.

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <vector>

#include "busy_scenes.h"
#include "support/engines.h"
#include "support/particles.h"

namespace {

std::atomic<bool> counting{false};
std::atomic<std::uint64_t> allocations{0};

// `caller`: the address to which the allocating function returns.
void count_allocation(const void* caller) {
  if (!counting) return;
  Dl_info found;
  const bool by_tbb = dladdr(caller, &found) != 0 && std::strstr(found.dli_fname, "libtbb") != nullptr;
  if (!by_tbb) ++allocations;
}

}  // namespace

// NOLINTBEGIN: the names are the C library's, which has its own functions under these others.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* room);

void* malloc(std::size_t size) {
  count_allocation(__builtin_return_address(0));
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  count_allocation(__builtin_return_address(0));
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  count_allocation(__builtin_return_address(0));
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count_allocation(__builtin_return_address(0));
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** to, std::size_t alignment, std::size_t size) {
  count_allocation(__builtin_return_address(0));
  *to = __libc_memalign(alignment, size);
  return *to == nullptr ? ENOMEM : 0;
}
}

void* operator new(std::size_t size) {
  count_allocation(__builtin_return_address(0));
  if (void* room = __libc_malloc(size == 0 ? 1 : size)) return room;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  count_allocation(__builtin_return_address(0));
  if (void* room = __libc_memalign(static_cast<std::size_t>(alignment), size == 0 ? 1 : size)) return room;
  throw std::bad_alloc();
}
void operator delete(void* room) noexcept { __libc_free(room); }
void operator delete(void* room, std::size_t) noexcept { __libc_free(room); }
void operator delete(void* room, std::align_val_t) noexcept { __libc_free(room); }
void operator delete(void* room, std::size_t, std::align_val_t) noexcept { __libc_free(room); }
// NOLINTEND

namespace hooke::test {
namespace {

// Counts the allocations during its lifetime.
class AllocationCount {
 public:
  AllocationCount() {
    allocations = 0;
    counting = true;
  }
  ~AllocationCount() { counting = false; }
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;

  std::uint64_t value() const { return allocations; }
};

TEST(AllocationCount, SeesWhatAVectorTakes) {
  const AllocationCount count;
  std::vector<int> numbers(100);
  EXPECT_EQ(count.value(), 1U);
  numbers.resize(1000);
  EXPECT_EQ(count.value(), 2U);
  void* volatile room = std::malloc(10);
  std::free(room);
  EXPECT_EQ(count.value(), 3U);
}

class SteadySteps : public testing::TestWithParam<BusyKind> {};

// A pool of three materials between walls, nearly at rest: lists still grow old, but no grain is fast.
TEST_P(SteadySteps, AllocateNothing) {
  const Scene scene = busy_scene(GetParam());
  Simulation simulation = simulate(scene, busy_particles(scene), {"cpu", GetParam().precision, 2, ""});
  ASSERT_TRUE(advance(simulation, 300));
  std::uint64_t allocated = 0;
  int kept = 0;  // steps without a rebuild of the list
  const std::uint64_t rebuilds_before = simulation.neighbour_statistics().rebuilds;
  for (int step = 0; step < 200; ++step) {
    const std::uint64_t rebuilds = simulation.neighbour_statistics().rebuilds;
    const AllocationCount count;
    const bool taken = simulation.step().has_value();
    const std::uint64_t in_step = count.value();
    ASSERT_TRUE(taken);
    if (simulation.neighbour_statistics().rebuilds > rebuilds) continue;
    ++kept;
    allocated += in_step;
  }
  EXPECT_EQ(allocated, 0U);
  EXPECT_GT(kept, 50);
  EXPECT_GT(simulation.neighbour_statistics().rebuilds, rebuilds_before) << "lists were built on the way";
}

INSTANTIATE_TEST_SUITE_P(
    All, SteadySteps,
    testing::Values(BusyKind{Boundary::spring, Integrator::symplectic_euler, Precision::single_precision},
                    BusyKind{Boundary::spring, Integrator::symplectic_euler, Precision::double_precision},
                    BusyKind{Boundary::spring, Integrator::velocity_verlet, Precision::single_precision},
                    BusyKind{Boundary::spring, Integrator::velocity_verlet, Precision::double_precision}),
    [](const auto& kind) { return kind.param.name(); });

}  // namespace
}  // namespace hooke::test
