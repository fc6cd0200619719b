// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/gpu/cuda_backend.h"
#include "hooke/base/format.h"
#include "hooke/core/attraction.h"

namespace hooke {

std::vector<Finding> cuda_refusals(const Scene& scene, std::size_t particles) {
  if (!scene.attraction) return {};
  const bool grows = !scene.emitters.empty() && scene.attraction->method == Attraction::Method::automatic;
  if (!grows && !attracts_by_tree(*scene.attraction, particles)) return {};
  return {
      {"attraction.method",
       formatted("the back end of a GPU has no tree, which {} particles would be summed by; \"direct\" sums all pairs",
                 particles)}};
}

}  // namespace hooke
