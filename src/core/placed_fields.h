// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/box3.h"
#include "hooke/base/sine.h"
#include "hooke/core/scene.h"
#include "hooke/physics/field.h"

namespace hooke {

/// What a field does at one instant, as loops read it: plain numbers, on a host or a device.
template <class Real>
struct FieldView {
  enum class Law { still_wind, wind, uniform, toward };
  /// What of a material the field needs.
  struct Feeling {
    bool chosen;      ///< whether it acts on the material at all
    Real mass, drag;  ///< kg, kg/s
  };

  /// Whether it acts on a particle of this material (index) at `x` (m).
  HOOKE_HD bool acts_on(std::size_t material, const Vec3<Real>& x) const {
    if (!feels[material].chosen) return false;
    return !bounded || within.contains(x);
  }

  /// The force on a particle that it acts on, N; `v` in m/s.
  HOOKE_HD Vec3<Real> force(std::size_t material, const Vec3<Real>& x, const Vec3<Real>& v) const {
    const Feeling& own = feels[material];
    switch (law) {
      case Law::still_wind:  // the material's own drag, -k_d v, is there already
        return wind_force(wind_at(x), {Real(0), Real(0), Real(0)}, own.drag);
      case Law::wind:
        return wind_force(wind_at(x), v, drag);
      case Law::uniform:
        return own.mass * vector;
      case Law::toward: {
        const Vec3<Real> direction = direction_to(vector, x);
        Vec3<Real> force = (own.mass * acceleration) * direction;
        if (rate > Real(0)) force += driving_force(direction, v, speed, own.mass * rate);
        return force;
      }
    }
    return {Real(0), Real(0), Real(0)};
  }

  /// Whether it acts on triangles of cloths too.
  HOOKE_HD bool blows_on_sheets() const { return area_drag > Real(0); }

  /// The force on each corner of such a triangle, N. Its middle `x` is in the field; edges are from its first corner,
  /// m; `v` is the mean velocity of its corners, m/s.
  HOOKE_HD Vec3<Real> force_on_corner(const Vec3<Real>& x, const Vec3<Real>& edge_1, const Vec3<Real>& edge_2,
                                      const Vec3<Real>& v) const {
    return sheet_force(edge_1, edge_2, wind_at(x) - v, area_drag);
  }

  HOOKE_HD Vec3<Real> wind_at(const Vec3<Real>& x) const {
    if (!travels) return vector;
    const double here = turns - dot(turns_a_metre, vec_cast<double>(x));
    return vector + static_cast<Real>(sine_cosine_of_turns(here).sine) * amplitude;
  }

  Law law = Law::uniform;
  bool bounded = false, travels = false;
  Box3<Real> within;  ///< m
  const Feeling* feels = nullptr;  ///< by material
  Vec3<Real> vector{};  ///< of the wind, m/s; of the push, m/s^2; the point, m
  Vec3<Real> amplitude{};  ///< of gusts that travel, m/s
  double turns = 0;  ///< of gusts, at x = 0
  Vec3d turns_a_metre{0, 0, 0};
  Real drag = 0, area_drag = 0;  ///< kg/s, kg/(m^2 s)
  Real acceleration = 0, speed = 0, rate = 0;  ///< m/s^2, m/s, 1/s
};

/// A field of a scene at one instant, in a back end's number type.
template <class Real>
class PlacedField : public FieldView<Real> {
  using View = FieldView<Real>;
  using Law = typename View::Law;

 public:
  PlacedField(const Scene& scene, const Field& field, double time) {
    this->bounded = field.within.has_value();
    if (this->bounded) {
      this->within = {vec_cast<Real>(field.within->min), vec_cast<Real>(field.within->max)};
    }
    std::vector<char> chosen(scene.materials.size(), field.materials.empty() ? 1 : 0);
    for (const std::size_t m : field.materials) {
      HOOKE_ASSERT(m < chosen.size(), m, chosen.size());
      chosen[m] = 1;
    }
    for (std::size_t m = 0; m < chosen.size(); ++m) {
      by_material_.push_back(
          {chosen[m] != 0, static_cast<Real>(scene.materials[m].mass), static_cast<Real>(scene.materials[m].drag)});
    }
    this->feels = by_material_.data();
    std::visit([&](const auto& own) { take(own, time); }, field.law);
  }
  PlacedField(const PlacedField&) = delete;  // the view points into it
  PlacedField& operator=(const PlacedField&) = delete;
  PlacedField(PlacedField&&) noexcept = default;
  PlacedField& operator=(PlacedField&&) noexcept = default;

 private:
  void take(const Wind& wind, double time) {
    this->law = wind.drag ? Law::wind : Law::still_wind;
    this->vector = vec_cast<Real>(wind.velocity);
    this->drag = static_cast<Real>(wind.drag.value_or(0));
    this->area_drag = static_cast<Real>(wind.area_drag);
    if (!wind.gust) return;
    const double now = wind.gust->frequency * time;
    this->amplitude = vec_cast<Real>(wind.gust->amplitude);
    if (wind.gust->wavelength > 0) {
      HOOKE_ASSERT(dot(wind.velocity, wind.velocity) > 0, wind.velocity, wind.gust->wavelength);
      this->travels = true;
      this->turns = now - std::floor(now);
      this->turns_a_metre =
          (1 / (wind.gust->wavelength * std::sqrt(dot(wind.velocity, wind.velocity)))) * wind.velocity;
    } else {
      this->vector += static_cast<Real>(sine_cosine_of_turns(now).sine) * this->amplitude;
    }
  }
  void take(const UniformPush& push, double) {
    this->law = Law::uniform;
    this->vector = vec_cast<Real>(push.acceleration);
  }
  void take(const PushToward& push, double) {
    this->law = Law::toward;
    this->vector = vec_cast<Real>(push.point);
    this->acceleration = static_cast<Real>(push.acceleration);
    this->speed = static_cast<Real>(push.speed);
    this->rate = static_cast<Real>(push.time > 0 ? 1 / push.time : 0);
  }

  std::vector<typename View::Feeling> by_material_;
};

/// All fields of a scene at `time` (s), in its order.
template <class Real>
std::vector<PlacedField<Real>> place_fields(const Scene& scene, double time) {
  std::vector<PlacedField<Real>> placed;
  for (const Field& field : scene.fields) placed.emplace_back(scene, field, time);
  return placed;
}

}  // namespace hooke
