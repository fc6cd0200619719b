// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/structure_message.h"

#include "hooke/base/bytes.h"

namespace hooke {

void append_structure(std::vector<std::byte>& to, const Structure& structure) {
  const SpringSet& s = structure.springs;
  append_column(to, s.a);
  append_column(to, s.b);
  for (const std::vector<double>* column : {&s.rest_length, &s.stiffness, &s.damping, &s.break_strain})
    append_column(to, *column);
  append_column(to, s.mode);
  append_column(to, s.contact);
  append_column(to, structure.pinned);
  append_bytes(to, structure.surfaces.size());
  for (const Surface& surface : structure.surfaces) {
    append_column(to, std::vector<char>(surface.name.begin(), surface.name.end()));
    append_column(to, surface.particles);
    append_column(to, surface.triangles);
  }
}

Structure take_structure(std::span<const std::byte>& from) {
  Structure structure;
  SpringSet& s = structure.springs;
  take_column(from, s.a);
  take_column(from, s.b);
  for (std::vector<double>* column : {&s.rest_length, &s.stiffness, &s.damping, &s.break_strain})
    take_column(from, *column);
  take_column(from, s.mode);
  take_column(from, s.contact);
  take_column(from, structure.pinned);
  std::size_t surfaces = 0;
  take_bytes(from, surfaces);
  for (std::size_t k = 0; k < surfaces; ++k) {
    Surface& surface = structure.surfaces.emplace_back();
    std::vector<char> name;
    take_column(from, name);
    surface.name.assign(name.begin(), name.end());
    take_column(from, surface.particles);
    take_column(from, surface.triangles);
  }
  return structure;
}

}  // namespace hooke
