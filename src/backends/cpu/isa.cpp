// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/isa.h"

#include <fmt/format.h>

namespace hooke {

#define HOOKE_DECLARE_GROUP_SEARCH(isa)                                                          \
  namespace isa {                                                                                \
  std::size_t search_group(const NeighbourRule<float>& rule, const GroupSearch<float>& group);   \
  std::size_t search_group(const NeighbourRule<double>& rule, const GroupSearch<double>& group); \
  }
HOOKE_DECLARE_GROUP_SEARCH(portable)
HOOKE_DECLARE_GROUP_SEARCH(avx2)
HOOKE_DECLARE_GROUP_SEARCH(avx512)
#undef HOOKE_DECLARE_GROUP_SEARCH

std::vector<Isa> available_isas() {
  std::vector<Isa> isas;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
    isas.push_back({"avx512", {avx512::force_pass, avx512::search_group}, {avx512::force_pass, avx512::search_group}});
  }
  if (__builtin_cpu_supports("avx2"))
    isas.push_back({"avx2", {avx2::force_pass, avx2::search_group}, {avx2::force_pass, avx2::search_group}});
#endif
  isas.push_back(
      {"portable", {portable::force_pass, portable::search_group}, {portable::force_pass, portable::search_group}});
  return isas;
}

Expected<Isa> choose_isa(const std::string& name) {
  const std::vector<Isa> isas = available_isas();
  if (name.empty()) return isas.front();
  std::string known;
  for (const Isa& isa : isas) {
    if (name == isa.name) return isa;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", isa.name);
  }
  return fail(Error::Kind::bad_input, "instruction set",
              fmt::format("\"{}\" is not to be had on this processor; it has {}", name, known));
}

}  // namespace hooke
