// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/isa.h"

#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/base/format.h"

namespace hooke {

#define HOOKE_DECLARE_SEARCH(isa)                                                            \
  namespace isa {                                                                            \
  void search_window(const NeighbourRule<float>& rule, const WindowSearch<float>& window);   \
  void search_window(const NeighbourRule<double>& rule, const WindowSearch<double>& window); \
  }
#define HOOKE_DECLARE_LOOPS(isa)                                                             \
  namespace isa {                                                                            \
  void spring_pass(const SpringPass<float>& pass, const SpringWork<float>& work);            \
  void spring_pass(const SpringPass<double>& pass, const SpringWork<double>& work);          \
  void work_pass(const ForceWork<float>& work, ExactParts* sums);                            \
  void work_pass(const ForceWork<double>& work, ExactParts* sums);                           \
  template <class Real>                                                                      \
  constexpr Loops<Real> loops() {                                                            \
    return {force_pass,                                                                      \
            search_window,                                                                   \
            spring_pass,                                                                     \
            work_pass,                                                                       \
            {pull_by_particles, pull_by_cells, potential_of_particles, potential_of_cells}}; \
  }                                                                                          \
  constexpr Isa named(const char* name) { return {name, loops<float>(), loops<double>()}; }  \
  }
HOOKE_DECLARE_SEARCH(portable)
HOOKE_DECLARE_LOOPS(portable)
// What a thread of a GPU computes. Its search is another one, and which pairs are listed alters no bit.
namespace scalar {
using portable::search_window;
}
HOOKE_DECLARE_LOOPS(scalar)
#if defined(__x86_64__)
HOOKE_DECLARE_SEARCH(avx2)
HOOKE_DECLARE_SEARCH(avx512)
HOOKE_DECLARE_LOOPS(avx2)
HOOKE_DECLARE_LOOPS(avx512)
#endif
#undef HOOKE_DECLARE_LOOPS
#undef HOOKE_DECLARE_SEARCH

std::vector<Isa> available_isas() {
  std::vector<Isa> isas;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) isas.push_back(avx512::named("avx512"));
  if (__builtin_cpu_supports("avx2")) isas.push_back(avx2::named("avx2"));
#endif
  isas.push_back(portable::named("portable"));
  isas.push_back(scalar::named("scalar"));
  return isas;
}

std::vector<std::string> cpu_instruction_sets() {
  std::vector<std::string> names;
  for (const Isa& isa : available_isas()) names.push_back(isa.name);
  return names;
}

Expected<Isa> choose_isa(const std::string& name) {
  const std::vector<Isa> isas = available_isas();
  if (name.empty()) return isas.front();
  std::string known;
  for (const Isa& isa : isas) {
    if (name == isa.name) return isa;
    known += formatted("{}{}", known.empty() ? "" : ", ", isa.name);
  }
  return fail(Error::Kind::bad_input, "instruction set",
              formatted("\"{}\" is not to be had on this processor; it has {}", name, known));
}

}  // namespace hooke
