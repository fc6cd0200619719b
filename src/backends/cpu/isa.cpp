// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/isa.h"

#include <fmt/format.h>

namespace hooke {

std::vector<Isa> available_isas() {
  std::vector<Isa> isas;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
    isas.push_back({"avx512", avx512::force_pass, avx512::force_pass});
  }
  if (__builtin_cpu_supports("avx2")) isas.push_back({"avx2", avx2::force_pass, avx2::force_pass});
#endif
  isas.push_back({"portable", portable::force_pass, portable::force_pass});
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
