// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "viewer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "hooke/render/cloth_meshes.h"
#include "scale.h"
#include "status_file.h"

namespace hooke::view {
namespace {

using namespace std::chrono_literals;

constexpr double kIdle = 0.05;  // s between frames while nothing moves
constexpr auto kMessageTime = 6s;

double seconds(std::chrono::steady_clock::duration time) { return std::chrono::duration<double>(time).count(); }

}  // namespace

Viewer::Viewer(Window& window, Session& session, const ViewerOptions& options, render::LiveRenderer renderer)
    : window_(window),
      session_(session),
      options_(options),
      renderer_(std::move(renderer)) {}

Expected<std::unique_ptr<Viewer>> Viewer::open(Window& window, Session& session, const ViewerOptions& options) {
  auto renderer = render::LiveRenderer::create();
  if (!renderer) return fail(std::move(renderer).error());
  std::unique_ptr<Viewer> viewer(new Viewer(window, session, options, std::move(*renderer)));
  Viewer& v = *viewer;
  const std::shared_ptr<const Scene> scene = session.scene();
  const ParticleSet& first = session.first_particles();
  v.look_ = render::make_look(*scene, first, render::ColorBy::material);
  v.up_ = render::up_of(*scene);
  const Vec3d size = v.look_.action.extent();
  v.size_ = std::sqrt(dot(size, size));
  v.floor_ = dot(v.look_.action.center(), v.up_) - 0.5 * render::extent_along(v.look_.action, v.up_);
  const double aspect = static_cast<double>(std::max(window.width(), 1)) / std::max(window.height(), 1);
  v.camera_.emplace(render::camera_at(*scene, v.look_.action, aspect, 0), render::level_axes(v.look_.action, v.up_),
                    v.up_, v.size_);
  for (std::size_t k = 0; k < kColorings.size(); ++k) {
    std::tie(v.state_.low[k], v.state_.high[k]) = default_range(*scene, first, kColorings[k]);
  }
  v.follow_scene();
  for (const Finding& warning : session.warnings()) v.show_message(warning.where + ": " + warning.message);
  return viewer;
}

// What depends on the scene, after each of its changes.
void Viewer::follow_scene() {
  if (const std::uint64_t version = session_.scene_version(); version == scene_version_) {
    return;
  } else {
    scene_version_ = version;
  }
  scene_ = session_.scene();
  colliders_.set_scene(*scene_);
  poses_.clear();
  std::vector<render::LiveMaterial> materials(std::max<std::size_t>(scene_->materials.size(), 1));
  radii_.assign(scene_->materials.size(), 0);
  colors_ = render::material_colors(*scene_);
  ball_ = 0;
  for (std::size_t k = 0; k < scene_->materials.size(); ++k) {
    radii_[k] = render::drawn_radius(scene_->materials[k]);
    materials[k] = {colors_[k], radii_[k], scene_->materials[k].look == MaterialLook::water};
    const double radius = scene_->materials[k].radius;
    if (radius > 0 && (ball_ == 0 || radius < ball_)) ball_ = radius;
    if (state_.ball_material.empty() && radius > 0) state_.ball_material = scene_->materials[k].name;
  }
  if (ball_ == 0) ball_ = 0.01 * size_;
  double mass = 0;
  for (const std::uint16_t material : session_.first_particles().material) mass += scene_->materials[material].mass;
  reference_force_ = std::max(0.01 * mass * std::sqrt(dot(scene_->gravity, scene_->gravity)), 1e-12);
  renderer_.set_materials(materials);
}

ColorRequest Viewer::color_request() const {
  const auto by = static_cast<std::size_t>(state_.coloring);
  return {state_.coloring, state_.low[by], state_.high[by], look_.foam_speed, up_, floor_, nullptr};
}

std::optional<render::ClipPlane> Viewer::clip_plane() const {
  if (!state_.clip) return {};
  const Domain& domain = scene_->domain;
  Vec3f normal{0, 0, 0};
  component(normal, state_.clip_axis) = state_.clip_flipped ? -1.0f : 1.0f;
  const Vec3d place = domain.min + static_cast<double>(state_.clip_place) * (domain.max - domain.min);
  return render::ClipPlane{normal, dot(normal, vec_cast<float>(place - session_.origin()))};
}

render::LiveView Viewer::live_view() const {
  render::LiveView view;
  view.camera = camera_->camera();
  view.camera.eye -= session_.origin();
  view.camera.target -= session_.origin();
  view.up = up_;
  view.to_sun = render::direction_to_sun(look_.action, up_);
  view.middle = look_.action.center() - session_.origin();
  view.size = size_;
  view.ball = ball_;
  const bool falls = !(scene_->gravity == Vec3d{0, 0, 0});
  if (state_.ground && falls) view.ground = floor_ - dot(session_.origin(), up_);
  view.clip = clip_plane();
  view.spheres = state_.spheres;
  view.point = state_.point_size * window_.scale();
  view.by_value = state_.coloring != Coloring::material;
  view.relief = state_.relief && state_.spheres;
  view.dark = state_.dark;
  return view;
}

// The tank, and the force on the collider that is held.
std::vector<render::LiveVertex> Viewer::lines() const {
  std::vector<render::LiveVertex> ends;
  const render::Color grey = state_.dark ? render::Color{120, 132, 148} : render::Color{96, 104, 116};
  const Domain& domain = scene_->domain;
  const auto add = [&](const Vec3d& from, const Vec3d& to, render::Color color) {
    for (const Vec3d& x : {from, to}) ends.push_back({vec_cast<float>(x - session_.origin()), color});
  };
  for (int axis = 0; state_.tank && axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int corner = 0; corner < 4; ++corner) {
      Vec3d from = domain.min;
      component(from, u) = component(corner & 1 ? domain.max : domain.min, u);
      component(from, v) = component(corner & 2 ? domain.max : domain.min, v);
      Vec3d to = from;
      component(to, axis) = component(domain.max, axis);
      add(from, to, grey);
    }
  }
  const std::string held = session_.readings().held_collider;
  const auto figures = session_.figures();
  for (std::size_t k = 0; !held.empty() && figures && frame_ && k < scene_->colliders.size(); ++k) {
    if (scene_->colliders[k].name != held || k >= figures->now.colliders.size()) continue;
    const Vec3d force = -figures->now.colliders[k].force;
    const double strength = std::sqrt(dot(force, force));
    if (!(strength > 0)) continue;
    // Longer forces' arrows grow ever slower: they are compared with a hundredth of the weight of all particles.
    const double length = 0.1 * size_ * std::log1p(strength / reference_force_);
    add(frame_->poses[k].pivot, frame_->poses[k].pivot + (std::min(length, 0.4 * size_) / strength) * force,
        {240, 150, 40});
  }
  return ends;
}

// New particles, and the surfaces that follow them.
void Viewer::upload(const std::shared_ptr<const ViewFrame>& frame) {
  if (!frame || frame == frame_) return;
  frame_ = frame;
  const bool moved = frame->poses != poses_ && frame->poses.size() == scene_->colliders.size();
  if (moved) {
    poses_ = frame->poses;
    collider_meshes_ = colliders_.posed(poses_, session_.origin());
  }
  if (!frame->snapshot) {
    renderer_.set_particles(frame->particles);
    if (moved || drawn_ == 0) renderer_.set_meshes(collider_meshes_);
    return;
  }
  // Particles that a cloth's surface shows are not drawn as balls.
  std::vector<render::LiveParticle> particles = frame->particles;
  std::vector<char> covered(particles.size(), 0);
  const auto color_of = [&](std::size_t i) { return colors_[frame->snapshot->particles.material[i]]; };
  cloth_meshes_ = render::cloth_meshes(*scene_, frame->snapshot->particles, session_.origin(), color_of, covered);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (covered[i] != 0) particles[i].tag = render::kHiddenParticle;
  }
  std::vector<render::ShadedMesh> meshes = cloth_meshes_;
  meshes.insert(meshes.end(), collider_meshes_.begin(), collider_meshes_.end());
  renderer_.set_particles(particles);
  renderer_.set_meshes(meshes);
}

void Viewer::draw_picture() {
  renderer_.set_lines(lines());
  renderer_.draw(live_view(), window_.width(), window_.height());
}

// The window rests where a replay has ended.
void Viewer::follow_replay() {
  const ReplayReport report = session_.readings().replay;
  if (replays_ && !report.running) {
    session_.run(false);
    show_message(report.diverged ? "the replay has DIVERGED at step " + std::to_string(*report.diverged)
                                 : "the replay has ended, with the same bits");
  }
  replays_ = report.running;
}

void Viewer::show_message(const std::string& text) {
  message_ = text;
  message_until_ = Clock::now() + kMessageTime;
}

Expected<void> Viewer::run() {
  StatusFile status(options_.status);
  last_frame_ = Clock::now();
  std::uint64_t shown = 0;
  bool busy = true;
  while (!window_.should_close()) {
    const std::vector<InputEvent> events = window_.take_events(busy ? 0 : kIdle);
    if (window_.width() <= 0 || window_.height() <= 0) {  // minimised
      for (const InputEvent& event : events) handle(event);  // what was pressed is released
      busy = false;
      continue;
    }
    const auto now = Clock::now();
    const double passed = seconds(now - last_frame_);
    last_frame_ = now;
    frame_seconds_ = frame_seconds_ > 0 ? frame_seconds_ + 0.2 * (passed - frame_seconds_) : passed;

    window_.begin_frame();
    for (const InputEvent& event : events) handle(event);
    fly(passed);
    if (pouring_) pour();
    camera_->follow(passed);
    if (const std::string message = session_.next_message(); !message.empty()) show_message(message);
    if (!session_.readings().failure.empty() && session_.runs()) session_.run(false);
    follow_replay();

    follow_scene();
    upload(session_.frame(color_request()));
    history_.add(session_.figures(), session_.readings());
    draw_gui();
    if (state_.rendering) draw_picture();
    capture();
    finish_film_still();
    step_film();
    window_.draw_gui();
    window_.show();
    ++drawn_;
    status.write(status_now());
    busy = session_.runs() || film_ || !events.empty() || drawn_ < 4 || session_.readings().version != shown;
    shown = session_.readings().version;
  }
  if (film_) end_film();
  return {};
}

}  // namespace hooke::view
