// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/physics/contact.h"

namespace hooke {

/// How pictures show a material.
enum class MaterialLook { ball, water, spark, skin };

/// Materials that a scene may have: back ends hold a table of all pairs.
inline constexpr std::size_t kMostMaterials = 1024;

/// What particles are made of.
struct Material {
  std::string name;
  double radius = 0.5;  ///< r, m, > 0; 0, with the mass, where only colliders are of the material
  double mass = 1;      ///< m, kg, > 0, of one particle
  ContactCoefficients<double> contact;  ///< against its own kind, and against walls without an entry
  double drag = 0;                      ///< k_d, kg/s, >= 0
  std::string color;                    ///< "#rrggbb", or empty
  MaterialLook look = MaterialLook::ball;
  SurfaceCoefficients<double> surface{};  ///< as `contact`
  bool interacts = true;  ///< else its particles touch walls and colliders, but no particles
  bool fixed = false;                     ///< no force moves its particles
  double foam = 1;         ///< how much of it pictures show where it looks like water, >= 0
  double opacity = 1;      ///< of colliders and cloths in pictures, 0 (left out) to 1
  double roughness = 0.5;  ///< of their surface in pictures, 0 (polished) to 1 (matt)

  /// If not, only colliders may have it.
  bool is_of_particles() const { return radius > 0; }
};

/// Coefficients of one pair of materials, or of one material and the walls, given in place of the mixed ones.
struct ContactEntry {
  static constexpr std::size_t kWall = static_cast<std::size_t>(-1);
  std::size_t a = 0;  ///< index into the materials
  std::size_t b = 0;  ///< index into the materials, or kWall
  ContactCoefficients<double> coefficients;
  SurfaceCoefficients<double> surface{};
};

/// The mixing rule for a pair without an entry (docs/theory.md eq. 8): stiffness 2 k1 k2/(k1 + k2), as of
/// two springs in series, twice; shear and damping the arithmetic mean.
ContactCoefficients<double> mix(const ContactCoefficients<double>& a, const ContactCoefficients<double>& b);

/// The same for surfaces: the smaller of each.
SurfaceCoefficients<double> mix(const SurfaceCoefficients<double>& a, const SurfaceCoefficients<double>& b);

/// The laws of every pair of materials and of every material against the walls.
class ContactTable {
 public:
  ContactTable() = default;
  ContactTable(std::span<const Material> materials, std::span<const ContactEntry> entries);

  std::size_t material_count() const { return wall_.size(); }
  /// The law of two materials < material_count().
  const ContactLaw<double>& pair(std::size_t a, std::size_t b) const {
    HOOKE_ASSERT(a < material_count() && b < material_count(), a, b, material_count());
    return pairs_[a * wall_.size() + b];
  }
  const ContactLaw<double>& wall(std::size_t a) const {
    HOOKE_ASSERT(a < material_count(), a, material_count());
    return wall_[a];
  }
  /// The law of material `a` against a collider of material `b`; without `b`, the wall's.
  const ContactLaw<double>& collider(std::size_t a, std::optional<std::size_t> b) const {
    return b ? pair(a, *b) : wall(a);
  }

  /// Whether no surface does anything: the law is linear.
  bool is_linear() const { return linear_; }
  /// The largest gap across which a pair acts, m.
  double widest_range() const { return widest_range_; }

 private:
  std::vector<ContactLaw<double>> pairs_;  // material_count() squared, symmetric
  std::vector<ContactLaw<double>> wall_;
  bool linear_ = true;
  double widest_range_ = 0;
};

}  // namespace hooke
