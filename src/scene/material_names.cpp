// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/material_names.h"

#include <fmt/format.h>

#include "hooke/scene/json_reader.h"
#include "hooke/scene/spelling.h"

namespace hooke {

std::optional<std::size_t> material_named(const std::string& name, const std::string& where,
                                          const std::vector<Material>& materials, Findings& findings) {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (materials[m].name == name) return m;
    names.push_back(materials[m].name);
  }
  const std::string hint = did_you_mean(name, names);
  findings.add(where, fmt::format("is \"{}\", which is no material{}{} the scene has {}", printable(name, 60), hint,
                                  hint.empty() ? ";" : "", quoted_list(names)));
  return {};
}

}  // namespace hooke
