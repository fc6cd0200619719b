// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/base/random.h"
#include "hooke/core/colliders.h"
#include "viewer.h"

namespace hooke::view {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostPulled = 400;
constexpr double kGrip = 3;             // of a hand, radii of the smallest particle
constexpr double kFastestShot = 0.3;    // radii a step
constexpr auto kPourInterval = 60ms;

double norm(const Vec3d& v) { return std::sqrt(dot(v, v)); }

// The rotation vector of turned axes, rad.
Vec3d rotation_of(const std::array<Vec3d, 3>& turn) {
  const double trace = turn[0].x + turn[1].y + turn[2].z;
  const double angle = std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0));
  const Vec3d twice{turn[1].z - turn[2].y, turn[2].x - turn[0].z, turn[0].y - turn[1].x};
  if (norm(twice) > 1e-9) return (angle / norm(twice)) * twice;
  if (angle < 1) return {0, 0, 0};
  // Half a turn: the axis is in the columns of the sum of the turn and the identity.
  Vec3d axis{0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    Vec3d column = turn[static_cast<std::size_t>(k)];
    component(column, k) += 1;
    if (norm(column) > norm(axis)) axis = column;
  }
  return (angle / norm(axis)) * axis;
}

const Material* find_material(const Scene& scene, const std::string& name) {
  for (const Material& m : scene.materials) {
    if (m.name == name && m.is_of_particles()) return &m;
  }
  return nullptr;
}

}  // namespace

// Relative to the session's origin, as frames are.
Ray Viewer::ray_at(double x, double y) const {
  const double aspect = static_cast<double>(window_.width()) / std::max(window_.height(), 1);
  Ray ray = ray_through(camera_->camera(), x, y, aspect);
  ray.from -= session_.origin();
  return ray;
}

void Viewer::take_hold(double x, double y) {
  if (!frame_) return;
  const Ray ray = ray_at(x, y);
  const auto particle = pick_particle(*frame_, radii_, ray, clip_plane());
  const auto mesh = pick_mesh(collider_meshes_, ray);
  if (mesh && mesh->index < poses_.size() && (!particle || mesh->distance < particle->distance)) {
    session_.act(HoldCollider{scene_->colliders[mesh->index].name, rotation_of(poses_[mesh->index].turn)});
    held_depth_ = mesh->distance;
  } else {
    // A cloth is held by its particles, which are hidden behind its surface.
    const auto surface = particle ? particle : hit_cloth(ray);
    if (!surface) return;
    const Vec3d at = ray.from + surface->distance * ray.direction;
    const std::vector<std::uint64_t> ids = particles_near(*frame_, at, kGrip * ball_, kMostPulled);
    if (ids.empty()) return;
    session_.act(HoldParticles{ids});
    held_depth_ = surface->distance;
  }
  holding_ = true;
  held_shift_ = {0, 0, 0};
}

// By shares of the picture's height, and of the depth.
void Viewer::lead(double right, double up, double ahead) {
  const render::Camera camera = camera_->camera();
  const render::CameraAxes own = render::axes(camera);
  const double height = 2 * held_depth_ * std::tan(camera.field_of_view * std::numbers::pi / 360);
  held_shift_ += height * (right * own.right + up * own.up) - (ahead * 2 * held_depth_) * own.back;
  session_.act(Lead{held_shift_});
}

void Viewer::let_go() {
  holding_ = false;
  session_.act(LetGo{});
}

void Viewer::cut(double x, double y) {
  if (!frame_ || !frame_->snapshot || !scene_->structure) {
    if (!scene_->structure) show_message("there are no springs to cut in this scene");
    return;
  }
  const Ray ray = ray_at(x, y);
  const auto surface = hit_cloth(ray);
  const double depth = surface ? surface->distance : 1e3 * size_;
  const auto springs = springs_near(*scene_->structure, frame_->snapshot->particles, session_.origin(), ray,
                                    1.5 * ball_, depth + 2 * ball_);
  if (!springs.empty()) session_.act(CutSprings{springs});
}

void Viewer::pick(double x, double y) {
  if (!frame_) return;
  const auto particle = pick_particle(*frame_, radii_, ray_at(x, y), clip_plane());
  picked_ = particle ? std::optional(frame_->ids[particle->index]) : std::nullopt;
  session_.inspect(picked_);
}

std::optional<Hit> Viewer::hit_cloth(const Ray& ray) const {
  auto first = pick_mesh(cloth_meshes_, ray);
  const auto collider = pick_mesh(collider_meshes_, ray);
  if (first && collider && collider->distance < first->distance) return {};
  return first;
}

// A ball that fits into the scene, m.
double Viewer::ball_size(const Material& material) const {
  const Vec3d room = scene_->domain.max - scene_->domain.min;
  return std::min(static_cast<double>(state_.ball_radius) * material.radius, 0.25 * std::min({room.x, room.y, room.z}));
}

void Viewer::drop_ball() {
  const Material* material = find_material(*scene_, state_.ball_material);
  if (material == nullptr) return show_message("there is no material that a ball could be of");
  const double radius = ball_size(*material), margin = radius + material->radius;
  const Domain& domain = scene_->domain;
  const auto u = uniform4(0, ++random_, 0);
  Vec3d center;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = component(domain.min, axis) + margin, high = component(domain.max, axis) - margin;
    const double upward = component(up_, axis), top = component(look_.action.max, axis) + 2 * margin;
    component(center, axis) = std::abs(upward) < 0.5 ? low + u[static_cast<std::size_t>(axis)] * (high - low)
                              : upward > 0           ? std::min(high, top)
                                                     : std::max(low, component(look_.action.min, axis) - 2 * margin);
  }
  session_.act(AddBall{material->name, center, radius, {0, 0, 0}});
}

void Viewer::shoot_ball(double x, double y) {
  const Material* material = find_material(*scene_, state_.ball_material);
  if (material == nullptr) return show_message("there is no material that a ball could be of");
  const double radius = ball_size(*material), margin = radius + material->radius;
  const Ray ray = ray_at(x, y);
  // From the eye, or from where the ray comes into the domain.
  const Vec3d low = scene_->domain.min + Vec3d{margin, margin, margin} - session_.origin();
  const Vec3d high = scene_->domain.max - Vec3d{margin, margin, margin} - session_.origin();
  double enter = camera_->distance() * 1e-3, leave = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    const double speed = component(ray.direction, axis), from = component(ray.from, axis);
    double in = (component(low, axis) - from) / speed, out = (component(high, axis) - from) / speed;
    if (in > out) std::swap(in, out);
    enter = std::max(enter, in);
    leave = std::min(leave, out);
  }
  if (!(enter < leave)) return show_message("the ball would miss the scene");
  const double fall = render::default_scale(*scene_, session_.first_particles(), render::ColorBy::speed).high;
  const double speed =
      std::min(static_cast<double>(state_.shot_speed) * fall, kFastestShot * ball_ / scene_->time_step);
  session_.act(AddBall{material->name, session_.origin() + ray.from + (enter + 1e-6 * size_) * ray.direction, radius,
                       speed * ray.direction});
}

// From the cursor, a little above what lies under it.
void Viewer::pour() {
  const Material* material = find_material(*scene_, state_.ball_material);
  if (material == nullptr || !frame_ || Clock::now() - last_pour_ < kPourInterval) return;
  last_pour_ = Clock::now();
  const Ray ray = ray_at(mouse_x_, mouse_y_);
  const auto particle = pick_particle(*frame_, radii_, ray, clip_plane());
  const auto mesh = pick_mesh(collider_meshes_, ray);
  double distance = camera_->distance();
  if (particle) distance = particle->distance;
  if (mesh && (!particle || mesh->distance < particle->distance)) distance = mesh->distance;
  const double radius = 2.2 * material->radius;
  Vec3d at = session_.origin() + ray.from + distance * ray.direction + 3 * radius * up_;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = component(scene_->domain.min, axis) + radius + material->radius;
    const double high = component(scene_->domain.max, axis) - radius - material->radius;
    component(at, axis) = std::max(low, std::min(high, component(at, axis)));
  }
  session_.act(AddBall{material->name, at, radius, {0, 0, 0}},
               true);  // where the last ones still lie there is no room
}

}  // namespace hooke::view
