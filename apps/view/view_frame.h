// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/simulation.h"
#include "hooke/render/coloring.h"
#include "hooke/render/live_picture.h"
#include "timeline.h"

namespace hooke::view {

/// What the colour of a particle tells.
enum class Coloring { material, speed, height, pressure, contacts, age, id };

struct ColoringInfo {
  const char* name;
  const char* unit;                ///< empty: none
  std::optional<render::ColorBy> of_films;  ///< the same in films, whose range it takes; empty: films have none
};
inline constexpr std::array<ColoringInfo, 7> kColorings = {{{"material", "", render::ColorBy::material},
                                                            {"speed", "m/s", render::ColorBy::speed},
                                                            {"height", "m", render::ColorBy::height},
                                                            {"pressure", "Pa", render::ColorBy::pressure},
                                                            {"contacts", "", render::ColorBy::contacts},
                                                            {"age", "s", {}},
                                                            {"id", "", render::ColorBy::id}}};

/// Values of some particles, found on another thread, by ascending id.
struct ColorColumn {
  Coloring by = Coloring::pressure;
  std::vector<std::uint64_t> id;
  std::vector<float> value;
};

/// How a frame is to be coloured.
struct ColorRequest {
  Coloring by = Coloring::material;
  double low = 0, high = 1;  ///< values at the two ends of the map, low < high
  double foam_speed = 1;     ///< at which water is white, m/s, > 0
  Vec3d up{0, 1, 0};         ///< unit vector
  double floor = 0;          ///< height of the lowest place, along `up`, m
  std::shared_ptr<const ColorColumn> column;  ///< of pressure and contacts; null: none yet

  friend bool operator==(const ColorRequest&, const ColorRequest&) = default;
};

/// The particles at one instant as the device takes them, and what the window must know to draw and to pick them.
struct ViewFrame {
  std::int64_t steps = 0;       ///< of the timeline
  std::int64_t step_count = 0;  ///< of the simulation
  double time = 0;              ///< s
  Vec3d origin{0, 0, 0};        ///< of the positions, m
  std::vector<render::LiveParticle> particles;  ///< by ascending id
  std::vector<std::uint64_t> ids;
  std::vector<ColliderPose> poses;
  std::shared_ptr<const Snapshot> snapshot;  ///< where the scene has cloths; else null
  double lowest = 0, highest = 0;            ///< of the values that colour

  // Room for copies; positions are relative to the origin but for the double ones.
  std::vector<Vec3f> positions, velocities;
  std::vector<Vec3d> double_positions, double_velocities;
  std::vector<std::uint16_t> materials;
};

/// Fills `frame` with the present state. Takes no longer than a copy of the particles does.
Expected<void> fill_frame(const Simulation& simulation, const Timeline& timeline, const ColorRequest& color,
                          const Vec3d& origin, ViewFrame& frame);

/// The column of a coloring by pressure or contacts.
ColorColumn contact_column(const Scene& scene, const Snapshot& snapshot, std::span<const std::uint64_t> broken_springs,
                           Coloring by);

}  // namespace hooke::view
