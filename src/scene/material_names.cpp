// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/material_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "hooke/scene/json_reader.h"
#include "hooke/scene/spelling.h"

namespace hooke::scene {

std::optional<std::size_t> material_named(const std::string& name, const std::string& where,
                                          const std::vector<Material>& materials, Findings& findings) {
  const auto found =
      std::find_if(materials.begin(), materials.end(), [&](const Material& m) { return m.name == name; });
  if (found != materials.end()) return static_cast<std::size_t>(found - materials.begin());
  if (findings.overflows()) return {};  // the likeliest name is dear to find
  std::vector<std::string> names;
  for (const Material& m : materials) names.push_back(m.name);
  const std::string hint = did_you_mean(name, names);
  findings.add(where, fmt::format("is \"{}\", which is no material{}{} the scene has {}", printable(name, 60), hint,
                                  hint.empty() ? ";" : "", quoted_list(names)));
  return {};
}

}  // namespace hooke::scene
