// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/mpi_loader.h"

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "hooke/comm/mpi/mpi_module.h"
#include "hooke/run/module_loader.h"

namespace hooke::run {
namespace {

std::optional<int> number_of(const char* variable) {
  const char* const value = std::getenv(variable);
  if (value == nullptr) return std::nullopt;
  const std::string_view text(value);
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

Expected<Module> mpi_module(int launched) {
#if !HOOKE_WITH_MPI
  return fail(Error::Kind::bad_input, "mpi",
              std::to_string(launched) + " ranks were started; they need MPI, which is not in this build (HOOKE_MPI)");
#endif
  return Module::load("hooke-mpi.so", "hooke_mpi_version", "mpi",
                      (std::to_string(launched) + " ranks were started; they need it").c_str());
}

}  // namespace

LaunchedRank launched_rank() {
  // Open MPI's mpirun; PMI's launchers; srun --mpi=pmix, which gives the number by another name.
  constexpr const char* kVariables[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                           {"PMI_RANK", "PMI_SIZE"},
                                           {"PMIX_RANK", "SLURM_STEP_NUM_TASKS"}};
  for (const auto& [rank_variable, ranks_variable] : kVariables) {
    const auto rank = number_of(rank_variable), ranks = number_of(ranks_variable);
    if (rank && ranks && *rank >= 0 && *rank < *ranks) return {*rank, *ranks};
  }
  return {};
}

Expected<LaunchedRanks> load_ranks(int launched) {
  const auto module = mpi_module(launched);
  if (!module) return fail(module.error());
  const auto join = module->function<decltype(hooke_join_ranks)>("hooke_join_ranks");
  const auto own_cores = module->function<decltype(hooke_own_cores)>("hooke_own_cores");
  const auto on_this_node = module->function<decltype(hooke_ranks_on_this_node)>("hooke_ranks_on_this_node");
  if (join == nullptr || own_cores == nullptr || on_this_node == nullptr)
    return fail(Error::Kind::bad_input, "hooke-mpi.so", "is of another version of hooke");
  Expected<std::shared_ptr<Communicator>> joined;
  join(launched, joined);
  if (!joined) return fail(std::move(joined).error());
  LaunchedRanks ranks{std::move(*joined)};
  ranks.cores = own_cores();
  ranks.on_this_machine = on_this_node();
  return ranks;
}

}  // namespace hooke::run
