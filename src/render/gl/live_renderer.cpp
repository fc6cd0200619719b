// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/live_renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <numbers>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/render/gl/gl_buffers.h"
#include "hooke/render/gl/gl_objects.h"
#include "hooke/render/gl/live_culling.h"
#include "hooke/render/gl/shaders.h"

namespace hooke::render {

namespace {

using Vec4f = std::array<float, 4>;

// The block of uniforms in live_scene.glsl.
struct SceneBlock {
  Vec4f eye, right, up, back, to_sun, sky_up, clip, picture, action, balls;
};

constexpr float kRelief = 0.16f;

Vec4f with(const Vec3d& v, double w) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

SceneBlock scene_block(const LiveView& view, int width, int height) {
  const CameraAxes own = axes(view.camera);
  const double tangent = std::tan(view.camera.field_of_view * std::numbers::pi / 360);
  const Vec3d to_middle = view.camera.eye - view.middle;
  const double away = std::sqrt(dot(to_middle, to_middle));
  // Balls of the size of a thousandth of the distance are all that is still seen close by.
  const double nearest = std::min(0.5 * view.ball, 1e-3 * std::max(away, view.size));
  SceneBlock block;
  block.eye = with(view.camera.eye, nearest);
  block.right = with(own.right, height / (tangent * width));
  block.up = with(own.up, 1 / tangent);
  block.back = with(own.back, 0);
  block.to_sun = with(view.to_sun, 1);
  block.sky_up = with(view.up, view.ground.value_or(0));
  block.clip = {0, 0, 0, 1};
  if (view.clip) block.clip = {view.clip->normal.x, view.clip->normal.y, view.clip->normal.z, view.clip->offset};
  block.picture = {static_cast<float>(width), static_cast<float>(height), view.ground ? 1.0f : 0.0f,
                   view.dark ? 1.0f : 0.0f};
  block.action = with(view.middle, view.size);
  block.balls = {static_cast<float>(view.ball), view.relief ? kRelief : 0, 0, 0};
  return block;
}

// What belongs to a size of the window.
struct Target {
  int width = 0, height = 0;
  gl::Texture colors, depths;
  gl::Framebuffer framebuffer;

  void resize(int wanted_width, int wanted_height) {
    if (width == wanted_width && height == wanted_height) return;
    width = wanted_width;
    height = wanted_height;
    colors = gl::make_texture(width, height, GL_RGBA8, GL_NEAREST);
    depths = gl::make_texture(width, height, GL_DEPTH_COMPONENT32F, GL_NEAREST);
    framebuffer = gl::make_framebuffer({&colors}, &depths);
  }
};

gl::Program live_program(const char* vertex, const char* fragment) {
  const std::string scene = gl::shaders::live_scene_glsl;
  return {(scene + vertex).c_str(), (scene + fragment).c_str()};
}

gl::Program final_program() {
  return {gl::shaders::whole_picture_vert,
          (std::string(gl::shaders::live_scene_glsl) + gl::shaders::live_final_frag).c_str()};
}

gl::Texture make_color_map() {
  constexpr int kColors = 256;
  std::vector<float> texels;
  for (int i = 0; i < kColors; ++i) {
    const Color c = map_color(static_cast<double>(i) / (kColors - 1));
    for (const std::uint8_t channel : {c.red, c.green, c.blue}) texels.push_back(static_cast<float>(channel) / 255);
    texels.push_back(1);
  }
  gl::Texture map = gl::make_texture(kColors, 1, GL_RGBA8, GL_LINEAR);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kColors, 1, GL_RGBA, GL_FLOAT, texels.data());
  return map;
}

}  // namespace

struct LiveRenderer::Impl {
  gl::Program balls = live_program(gl::shaders::live_balls_vert, gl::shaders::live_balls_frag);
  gl::Program points = live_program(gl::shaders::live_points_vert, gl::shaders::live_points_frag);
  gl::Program meshes = live_program(gl::shaders::live_meshes_vert, gl::shaders::live_meshes_frag);
  gl::Program lines = live_program(gl::shaders::live_lines_vert, gl::shaders::live_lines_frag);
  gl::Program finish = final_program();
  gl::Texture color_map = make_color_map(), materials;
  gl::Buffer scene = gl::make_buffer(), particle_buffer = gl::make_buffer(), line_buffer = gl::make_buffer();
  gl::VertexArray point_array = gl::make_vertex_array(), line_array = gl::make_vertex_array();
  LiveCulling culling;
  MeshBuffer mesh_buffer;
  WholePicture whole;
  Target target;
  GLsizei particle_count = 0, line_ends = 0;
  std::vector<std::pair<Vec3f, MeshBuffer::Faces>> looks;  // of the meshes

  Impl() {
    glBindVertexArray(point_array.get());
    glBindBuffer(GL_ARRAY_BUFFER, particle_buffer.get());
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(LiveParticle), nullptr);
    glVertexAttribIPointer(1, 1, GL_UNSIGNED_INT, sizeof(LiveParticle),
                           reinterpret_cast<const void*>(offsetof(LiveParticle, tag)));
    glBindVertexArray(line_array.get());
    glBindBuffer(GL_ARRAY_BUFFER, line_buffer.get());
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(LiveVertex), nullptr);
    glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(LiveVertex),
                          reinterpret_cast<const void*>(offsetof(LiveVertex, color)));
    static_assert(offsetof(LiveVertex, opacity) == offsetof(LiveVertex, color) + 3);
  }

  void draw_particles(const LiveView& view) {
    const gl::Program& program = view.spheres ? balls : points;
    program.use();
    program.read("materials", 0, materials);
    program.read("colors", 1, color_map);
    program.set("by_value", view.by_value ? 1 : 0);
    if (view.spheres) return culling.draw_seen();
    glEnable(GL_PROGRAM_POINT_SIZE);
    program.set("pixels", view.point);
    glBindVertexArray(point_array.get());
    glDrawArrays(GL_POINTS, 0, particle_count);
  }

  void draw_meshes(const LiveView& view) {
    meshes.use();
    meshes.set("clipped", view.clip ? 1 : 0);
    for (std::size_t k = 0; k < looks.size(); ++k) {
      meshes.set("tint", looks[k].first);
      mesh_buffer.draw(k, looks[k].second);
    }
  }

  void draw_lines() {
    lines.use();
    glDepthMask(GL_FALSE);
    glBindVertexArray(line_array.get());
    glDrawArrays(GL_LINES, 0, line_ends);
    glDepthMask(GL_TRUE);
  }
};

LiveRenderer::LiveRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveRenderer::~LiveRenderer() = default;
LiveRenderer::LiveRenderer(LiveRenderer&&) noexcept = default;
LiveRenderer& LiveRenderer::operator=(LiveRenderer&&) noexcept = default;

Expected<LiveRenderer> LiveRenderer::create() {
  const int version = epoxy_gl_version();
  if (version < 10 * kMajor + kMinor) {
    return fail(Error::Kind::bad_input, "OpenGL",
                fmt::format("the driver has version {}.{}, the window needs {}.{}", version / 10, version % 10, kMajor,
                            kMinor));
  }
  try {
    return LiveRenderer(std::make_unique<Impl>());
  } catch (const std::exception& thrown) {
    return fail(Error::Kind::bad_input, "OpenGL", thrown.what());
  }
}

void LiveRenderer::set_materials(std::span<const LiveMaterial> materials) {
  HOOKE_ASSERT(!materials.empty());
  std::vector<float> texels(8 * materials.size(), 0);
  for (std::size_t k = 0; k < materials.size(); ++k) {
    const LiveMaterial& m = materials[k];
    const float row[] = {static_cast<float>(m.color.red) / 255, static_cast<float>(m.color.green) / 255,
                         static_cast<float>(m.color.blue) / 255, m.radius};
    std::copy(std::begin(row), std::end(row), texels.begin() + static_cast<std::ptrdiff_t>(4 * k));
    texels[4 * (materials.size() + k)] = m.whitens ? 1.0f : 0.0f;
  }
  const auto width = static_cast<int>(materials.size());
  impl_->materials = gl::make_texture(width, 2, GL_RGBA32F, GL_NEAREST);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, 2, GL_RGBA, GL_FLOAT, texels.data());
}

void LiveRenderer::set_particles(std::span<const LiveParticle> particles) {
  impl_->particle_count = static_cast<GLsizei>(particles.size());
  glBindBuffer(GL_ARRAY_BUFFER, impl_->particle_buffer.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(particles.size_bytes()), particles.data(), GL_STREAM_DRAW);
}

void LiveRenderer::set_meshes(std::span<const ShadedMesh> meshes) {
  impl_->mesh_buffer.upload(meshes);
  impl_->looks.clear();
  for (const ShadedMesh& mesh : meshes) {
    const auto channel = [](std::uint8_t value) { return static_cast<float>(value) / 255; };
    // What is within glass shows as what is within an open mesh does.
    const bool open = mesh.sides == ShadedMesh::Sides::inner || mesh.is_glass();
    impl_->looks.push_back({{channel(mesh.color.red), channel(mesh.color.green), channel(mesh.color.blue)},
                            open ? MeshBuffer::Faces::away : MeshBuffer::Faces::all});
  }
}

void LiveRenderer::set_lines(std::span<const LiveVertex> ends) {
  HOOKE_ASSERT(ends.size() % 2 == 0, ends.size());
  impl_->line_ends = static_cast<GLsizei>(ends.size());
  glBindBuffer(GL_ARRAY_BUFFER, impl_->line_buffer.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(ends.size_bytes()), ends.data(), GL_STREAM_DRAW);
}

void LiveRenderer::draw(const LiveView& view, int width, int height) {
  HOOKE_ASSERT(width > 0 && height > 0, width, height);
  HOOKE_ASSERT(view.size > 0 && view.ball > 0, view.size, view.ball);
  Impl& s = *impl_;
  s.target.resize(width, height);
  const SceneBlock block = scene_block(view, width, height);
  glBindBuffer(GL_UNIFORM_BUFFER, s.scene.get());
  glBufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, s.scene.get());

  const bool particles = view.particles && s.particle_count > 0;
  if (particles && view.spheres) s.culling.find_seen(s.particle_buffer, s.particle_count, s.materials, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, s.target.framebuffer.get());
  glViewport(0, 0, width, height);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glClearColor(0, 0, 0, 0);
  glClearDepth(0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  s.draw_meshes(view);
  if (particles) s.draw_particles(view);
  s.draw_lines();

  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDisable(GL_DEPTH_TEST);
  s.finish.use();
  s.finish.read("colors", 0, s.target.colors);
  s.finish.read("depths", 1, s.target.depths);
  s.whole.draw();
}

Image LiveRenderer::read_window(int width, int height) {
  Image image(width, height), upside_down(width, height);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.pixels.data());
  const std::size_t row = Image::kChannels * static_cast<std::size_t>(width);
  for (int y = 0; y < height; ++y) std::copy_n(upside_down.at(0, height - 1 - y), row, image.at(0, y));
  return image;
}

std::string LiveRenderer::device() { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }

}  // namespace hooke::render
