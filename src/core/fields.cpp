// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/fields.h"

#include <cmath>
#include <string>

#include "hooke/base/format.h"
#include "hooke/core/scene.h"

namespace hooke {
namespace {

class FieldCheck {
 public:
  FieldCheck(std::string where, std::vector<Finding>& findings) : where_(std::move(where)), findings_(findings) {}

  void finite(const std::string& key, const Vec3d& v) {
    for (int axis = 0; axis < 3; ++axis) number(formatted("{}[{}]", key, axis), component(v, axis), -INFINITY);
  }
  /// Finite, and at least `least`.
  void number(const std::string& key, double value, double least) {
    if (!std::isfinite(value)) {
      add(key, formatted("{} is not finite", value));
    } else if (value < least) {
      add(key, formatted("{} must be {} or more", value, least));
    }
  }

  void operator()(const Wind& wind) {
    finite("wind.velocity", wind.velocity);
    if (wind.drag) number("wind.drag", *wind.drag, 0);
    number("wind.area_drag", wind.area_drag, 0);
    if (!wind.gust) return;
    finite("wind.gust.amplitude", wind.gust->amplitude);
    number("wind.gust.frequency", wind.gust->frequency, 0);
    number("wind.gust.wavelength", wind.gust->wavelength, 0);
    if (wind.gust->wavelength > 0 && dot(wind.velocity, wind.velocity) == 0) {
      add("wind.gust.wavelength", "needs a wind to travel with, but wind.velocity is 0");
    }
  }
  void operator()(const UniformPush& push) { finite("acceleration", push.acceleration); }
  void operator()(const PushToward& push) {
    finite("toward.point", push.point);
    number("toward.acceleration", push.acceleration, -INFINITY);
    number("toward.speed", push.speed, 0);
    number("toward.time", push.time, 0);
  }

  void add(const std::string& key, const std::string& message) { findings_.push_back({where_ + "." + key, message}); }

 private:
  std::string where_;
  std::vector<Finding>& findings_;
};

}  // namespace

std::vector<Finding> check_fields(const Scene& scene) {
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < scene.fields.size(); ++i) {
    const Field& field = scene.fields[i];
    FieldCheck check(formatted("fields[{}]", i), findings);
    std::visit(check, field.law);
    for (const std::size_t m : field.materials) {
      if (m >= scene.materials.size()) check.add("materials", formatted("there is no material {}", m));
    }
    if (!field.within) continue;
    check.finite("within.box.min", field.within->min);
    check.finite("within.box.max", field.within->max);
    for (int axis = 0; axis < 3; ++axis) {
      const double low = component(field.within->min, axis), high = component(field.within->max, axis);
      if (high > low || !std::isfinite(low) || !std::isfinite(high)) continue;
      check.add(formatted("within.box.max[{}]", axis), formatted("{} must be greater than {}", high, low));
    }
  }
  return findings;
}

}  // namespace hooke
