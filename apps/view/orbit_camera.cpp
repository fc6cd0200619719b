// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hooke::view {
namespace {

constexpr double kSteepest = 89 * std::numbers::pi / 180;
constexpr double kSoftness = 0.08;  // s in which a picture catches up by a factor e

double norm(const Vec3d& v) { return std::sqrt(dot(v, v)); }

}  // namespace

OrbitCamera::OrbitCamera(const render::Camera& camera, const render::LevelAxes& level, const Vec3d& up, double size)
    : level_(level),
      up_(up),
      field_of_view_(camera.field_of_view),
      size_(size) {
  const Vec3d from = camera.eye - camera.target;
  start_.target = camera.target;
  start_.distance = norm(from);
  start_.pitch = std::clamp(std::asin(std::clamp(dot(from, up) / start_.distance, -1.0, 1.0)), -kSteepest, kSteepest);
  start_.yaw = std::atan2(dot(from, level.across), dot(from, level.front));
  wanted_ = shown_ = start_;
}

Vec3d OrbitCamera::from_target(const Pose& pose) const {
  const Vec3d level = std::cos(pose.yaw) * level_.front + std::sin(pose.yaw) * level_.across;
  return pose.distance * (std::cos(pose.pitch) * level + std::sin(pose.pitch) * up_);
}

render::Camera OrbitCamera::camera_of(const Pose& pose) const {
  return {pose.target + from_target(pose), pose.target, up_, field_of_view_};
}

void OrbitCamera::turn(double right, double up) {
  wanted_.yaw += right;
  wanted_.pitch = std::clamp(wanted_.pitch + up, -kSteepest, kSteepest);
}

void OrbitCamera::look(double right, double up) {
  const Vec3d eye = wanted_.target + from_target(wanted_);
  turn(right, up);
  wanted_.target = eye - from_target(wanted_);
}

void OrbitCamera::pan(double right, double up) {
  const render::CameraAxes own = render::axes(camera_of(wanted_));
  const double height = 2 * wanted_.distance * std::tan(field_of_view_ * std::numbers::pi / 360);
  wanted_.target += height * (right * own.right + up * own.up);
}

void OrbitCamera::zoom(double factor) {
  wanted_.distance = std::clamp(wanted_.distance / factor, 1e-4 * size_, 50 * size_);
}

void OrbitCamera::fly(double right, double up, double ahead) {
  const render::CameraAxes own = render::axes(camera_of(wanted_));
  wanted_.target += wanted_.distance * (right * own.right + up * up_ - ahead * own.back);
}

void OrbitCamera::follow(double seconds) {
  const double share = 1 - std::exp(-std::max(seconds, 0.0) / kSoftness);
  shown_.target += share * (wanted_.target - shown_.target);
  shown_.yaw += share * (wanted_.yaw - shown_.yaw);
  shown_.pitch += share * (wanted_.pitch - shown_.pitch);
  shown_.distance *= std::pow(wanted_.distance / shown_.distance, share);
}

}  // namespace hooke::view
