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

/// A field of a scene at one instant, in a back end's number type.
template <class Real>
class PlacedField {
 public:
  PlacedField(const Scene& scene, const Field& field, double time) : bounded_(field.within.has_value()) {
    if (bounded_) {
      within_ = {vec_cast<Real>(field.within->min), vec_cast<Real>(field.within->max)};
    }
    std::vector<char> chosen(scene.materials.size(), field.materials.empty() ? 1 : 0);
    for (const std::size_t m : field.materials) {
      HOOKE_ASSERT(m < chosen.size(), m, chosen.size());
      chosen[m] = 1;
    }
    for (std::size_t m = 0; m < chosen.size(); ++m) {
      feels_.push_back(
          {chosen[m] != 0, static_cast<Real>(scene.materials[m].mass), static_cast<Real>(scene.materials[m].drag)});
    }
    std::visit([&](const auto& law) { take(law, time); }, field.law);
  }

  /// Whether it acts on a particle of this material (index) at `x` (m).
  bool acts_on(std::size_t material, const Vec3<Real>& x) const {
    if (!feels_[material].chosen) return false;
    return !bounded_ || within_.contains(x);
  }

  /// The force on a particle that it acts on, N; `v` in m/s.
  Vec3<Real> force(std::size_t material, const Vec3<Real>& x, const Vec3<Real>& v) const {
    const Feeling& own = feels_[material];
    switch (law_) {
      case Law::still_wind:  // the material's own drag, -k_d v, is there already
        return wind_force(wind_at(x), {Real(0), Real(0), Real(0)}, own.drag);
      case Law::wind:
        return wind_force(wind_at(x), v, drag_);
      case Law::uniform:
        return own.mass * vector_;
      case Law::toward: {
        const Vec3<Real> direction = direction_to(vector_, x);
        Vec3<Real> force = (own.mass * acceleration_) * direction;
        if (rate_ > Real(0)) force += driving_force(direction, v, speed_, own.mass * rate_);
        return force;
      }
    }
    return {Real(0), Real(0), Real(0)};
  }

  /// Whether it acts on triangles of cloths too.
  bool blows_on_sheets() const { return area_drag_ > Real(0); }

  /// The force on each corner of such a triangle, N. Its middle `x` is in the field; edges are from its first corner,
  /// m; `v` is the mean velocity of its corners, m/s.
  Vec3<Real> force_on_corner(const Vec3<Real>& x, const Vec3<Real>& edge_1, const Vec3<Real>& edge_2,
                             const Vec3<Real>& v) const {
    return sheet_force(edge_1, edge_2, wind_at(x) - v, area_drag_);
  }

 private:
  enum class Law { still_wind, wind, uniform, toward };
  struct Feeling {
    bool chosen;
    Real mass, drag;  // kg, kg/s
  };

  void take(const Wind& wind, double time) {
    law_ = wind.drag ? Law::wind : Law::still_wind;
    vector_ = vec_cast<Real>(wind.velocity);
    drag_ = static_cast<Real>(wind.drag.value_or(0));
    area_drag_ = static_cast<Real>(wind.area_drag);
    if (!wind.gust) return;
    const double turns = wind.gust->frequency * time;
    amplitude_ = vec_cast<Real>(wind.gust->amplitude);
    if (wind.gust->wavelength > 0) {
      HOOKE_ASSERT(dot(wind.velocity, wind.velocity) > 0, wind.velocity, wind.gust->wavelength);
      travels_ = true;
      turns_ = turns - std::floor(turns);
      turns_a_metre_ = (1 / (wind.gust->wavelength * std::sqrt(dot(wind.velocity, wind.velocity)))) * wind.velocity;
    } else {
      vector_ += static_cast<Real>(sine_cosine_of_turns(turns).sine) * amplitude_;
    }
  }
  void take(const UniformPush& push, double) {
    law_ = Law::uniform;
    vector_ = vec_cast<Real>(push.acceleration);
  }
  void take(const PushToward& push, double) {
    law_ = Law::toward;
    vector_ = vec_cast<Real>(push.point);
    acceleration_ = static_cast<Real>(push.acceleration);
    speed_ = static_cast<Real>(push.speed);
    rate_ = static_cast<Real>(push.time > 0 ? 1 / push.time : 0);
  }

  Vec3<Real> wind_at(const Vec3<Real>& x) const {
    if (!travels_) return vector_;
    const double turns = turns_ - dot(turns_a_metre_, vec_cast<double>(x));
    return vector_ + static_cast<Real>(sine_cosine_of_turns(turns).sine) * amplitude_;
  }

  Law law_ = Law::uniform;
  bool bounded_, travels_ = false;
  Box3<Real> within_;  // m
  std::vector<Feeling> feels_;  // by material
  Vec3<Real> vector_{};  // of the wind, m/s; of the push, m/s^2; the point, m
  Vec3<Real> amplitude_{};  // of gusts that travel, m/s
  double turns_ = 0;  // of gusts, at x = 0
  Vec3d turns_a_metre_{0, 0, 0};
  Real drag_ = 0, area_drag_ = 0;  // kg/s, kg/(m^2 s)
  Real acceleration_ = 0, speed_ = 0, rate_ = 0;  // m/s^2, m/s, 1/s
};

/// All fields of a scene at `time` (s), in its order.
template <class Real>
std::vector<PlacedField<Real>> place_fields(const Scene& scene, double time) {
  std::vector<PlacedField<Real>> placed;
  for (const Field& field : scene.fields) placed.emplace_back(scene, field, time);
  return placed;
}

}  // namespace hooke
