// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/gl_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "hooke/base/parallel.h"
#include "hooke/render/gl/egl_context.h"
#include "hooke/render/gl/gl_buffers.h"
#include "hooke/render/gl/gl_objects.h"
#include "hooke/render/gl/shaders.h"
#include "hooke/render/visible_spheres.h"
#include "hooke/render/water_thickness.h"

namespace hooke {

namespace {

using Clock = std::chrono::steady_clock;
using gl::Buffer;
using gl::Framebuffer;
using gl::Program;
using gl::Texture;
using gl::VertexArray;

constexpr int kSunMap = 1280;  // pixels along each side

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

float length_of(const Vec3d& v) { return static_cast<float>(std::sqrt(dot(v, v))); }

// Between the lines of the ground: the power of ten of which the action is 3 to 30 long, m.
float ground_step(const Frame& frame) {
  const float size = length_of(frame.action.max - frame.action.min);
  return std::pow(10.0f, std::floor(std::log10(size / 3)));
}

// A parallel projection along the sun's rays that holds the whole action and, as far as it may splash, what is above.
struct Sun {
  Projection projection;
  float range = 1;  // m, from its eye to the farthest that it lights
  Vec3f to;         // unit vector
};

Sun make_sun(const Frame& frame) {
  constexpr double kRoom = 1.3;
  const Vec3d center = frame.action.center();
  const double radius = 0.5 * kRoom * length_of(frame.action.max - frame.action.min);
  const Camera camera{
      center + radius * frame.to_sun, center,
      std::abs(dot(frame.to_sun, frame.up)) < 0.99 ? frame.up : Vec3d{frame.up.y, frame.up.z, frame.up.x}};
  Sun sun{project(camera, kSunMap, kSunMap), static_cast<float>(2 * radius), vec_cast<float>(frame.to_sun)};
  sun.projection.parallel = true;
  sun.projection.nearest = 0;
  sun.projection.scale = static_cast<float>(0.5 * kSunMap / radius);
  return sun;
}

class GlRenderer final : public Renderer {
 public:
  GlRenderer(EglContext context, const RenderSettings& settings)
      : context_(std::move(context)),
        settings_(settings),
        width_(settings.width * settings.samples),
        height_(settings.height * settings.samples) {
    make_targets();
    make_programs();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
  }

  // What this owns is then deleted from its own context.
  ~GlRenderer() override { context_.make_current(); }

  Expected<Image> render(const Frame& frame) override {
    const Clock::time_point start = Clock::now();
    context_.make_current();
    const Projection view = project(frame.camera, width_, height_);
    const Sun sun = make_sun(frame);
    std::vector<std::uint32_t> seen, sunlit;
    parallel_ranges(2, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        (k == 0 ? seen : sunlit) = visible_spheres(frame.spheres, k == 0 ? view : sun.projection);
      }
    });
    const bool water =
        std::any_of(frame.spheres.begin(), frame.spheres.end(), [](const Sphere& s) { return s.foam > 0; });
    if (water) upload_thickness(water_thickness(frame.spheres, view));
    figures_ = {seen.size(), seconds_since(start), 0};

    const float sphere_size = typical_radius(frame);
    meshes_.upload(frame.meshes);
    upload(frame.spheres, sunlit);
    draw_sun_map(sun, frame.meshes);
    upload(frame.spheres, seen);
    draw_surfaces(view, frame.meshes);
    const Projection pixels = project(frame.camera, settings_.width, settings_.height);
    const PixelRectangle box = frame.meshes.empty() ? bounds_on_picture(frame.spheres, seen, pixels)
                                                    : PixelRectangle{0, 0, settings_.width, settings_.height};
    begin_surface_passes(box);
    reduce();
    if (water) {
      smooth_water(pixels, sphere_size);
      find_water_normals(pixels, sphere_size);
    }
    draw_ambient(pixels, box, sphere_size, frame);
    glDisable(GL_SCISSOR_TEST);
    draw_backdrop(frame, pixels, sun, sphere_size);
    clear_shaded();
    if (!balls_.empty() || !frame.meshes.empty()) shade_balls(frame, view, sun, sphere_size);
    if (water) shade_water(frame, view, sun, sphere_size);
    if (!sparks_.empty()) shade_sparks();
    resolve();
    draw_tank(frame, pixels);
    Image image = read_image();
    if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
      return fail(Error::Kind::run_failed, "OpenGL", "error " + std::to_string(error) + " of " + context_.device());
    }
    figures_.total_seconds = seconds_since(start);
    return image;
  }

  RenderFigures figures() const override { return figures_; }
  std::string device() const override { return context_.device(); }

 private:
  void make_targets() {
    const int w = settings_.width, h = settings_.height;
    color_ = gl::make_texture(width_, height_, GL_RGBA8, GL_NEAREST);
    normal_ = gl::make_texture(width_, height_, GL_RGBA8, GL_NEAREST);
    depth_ = gl::make_texture(width_, height_, GL_R32F, GL_NEAREST);
    depth_stencil_ = gl::make_texture(width_, height_, GL_DEPTH32F_STENCIL8, GL_NEAREST);
    shaded_ = gl::make_texture(width_, height_, GL_RGBA8, GL_NEAREST);
    for (Texture& surface : surface_) surface = gl::make_texture(w, h, GL_RG32F, GL_NEAREST);
    for (Texture& ambient : ambient_) ambient = gl::make_texture(half(w), half(h), GL_R8, GL_LINEAR);
    water_normal_ = gl::make_texture(w, h, GL_RGBA8, GL_LINEAR);
    thickness_ = gl::make_texture(1, 1, GL_R32F, GL_LINEAR);
    backdrop_ = gl::make_texture(w, h, GL_RGBA8, GL_NEAREST);
    result_ = gl::make_texture(w, h, GL_RGBA8, GL_NEAREST);
    sun_map_ = gl::make_texture(kSunMap, kSunMap, GL_DEPTH_COMPONENT32F, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);

    to_sun_map_ = gl::make_framebuffer({}, &sun_map_);
    to_spheres_ = gl::make_framebuffer({&color_, &normal_, &depth_}, &depth_stencil_);
    to_surface_[0] = gl::make_framebuffer({&surface_[0]}, nullptr);
    to_surface_[1] = gl::make_framebuffer({&surface_[1]}, nullptr);
    to_water_normal_ = gl::make_framebuffer({&water_normal_}, nullptr);
    to_ambient_ = gl::make_framebuffer({&ambient_[0]}, nullptr);
    to_blurred_ = gl::make_framebuffer({&ambient_[1]}, nullptr);
    to_backdrop_ = gl::make_framebuffer({&backdrop_}, nullptr);
    to_shaded_ = gl::make_framebuffer({&shaded_}, &depth_stencil_);
    to_result_ = gl::make_framebuffer({&result_}, nullptr);
    nothing_ = gl::make_vertex_array();
    edge_array_ = gl::make_vertex_array();
    edge_buffer_ = gl::make_buffer();
  }

  void make_programs() {
    using namespace gl::shaders;
    const std::string view = view_glsl, lit = view + light_glsl;
    const auto picture = [](const std::string& fragment) { return Program(whole_picture_vert, fragment.c_str()); };
    sun_program_ = Program(spheres_vert, sun_depth_frag);
    sphere_program_ = Program(spheres_vert, spheres_frag);
    mesh_program_ = Program(meshes_vert, meshes_frag);
    mesh_sun_program_ = Program(meshes_vert, meshes_sun_depth_frag);
    reduce_program_ = picture(reduce_frag);
    smooth_program_ = picture(smooth_frag);
    water_normal_program_ = picture(view + water_normal_frag);
    ambient_program_ = picture(view + ambient_frag);
    blur_program_ = picture(blur_frag);
    backdrop_program_ = picture(lit + backdrop_frag);
    ball_program_ = picture(lit + shade_ball_frag);
    water_program_ = picture(lit + shade_water_frag);
    spark_program_ = picture(view + shade_spark_frag);
    resolve_program_ = picture(view + resolve_frag);
    edge_program_ = Program(edges_vert, edges_frag);
  }

  static float typical_radius(const Frame& frame) {
    return frame.spheres.empty() ? 1.0f : frame.spheres[frame.spheres.size() / 2].radius;
  }

  void upload_thickness(const WaterThickness& thickness) {
    glBindTexture(GL_TEXTURE_2D, thickness_.get());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, thickness.columns, thickness.rows, 0, GL_RED, GL_FLOAT,
                 thickness.meters.data());
  }

  static void begin(const Framebuffer& target, int width, int height) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.get());
    glViewport(0, 0, width, height);
  }

  void cover() const {
    glBindVertexArray(nothing_.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

  static void set_view(const Program& program, const Projection& view) {
    program.set("eye", view.eye);
    program.set_rows("to_view", view.right, view.up, view.back);
  }

  void upload(std::span<const Sphere> spheres, std::span<const std::uint32_t> chosen) {
    balls_.clear();
    water_.clear();
    sparks_.clear();
    for (const std::uint32_t i : chosen) {
      (spheres[i].foam > 0 ? water_ : spheres[i].glows ? sparks_ : balls_).add(spheres[i]);
    }
    for (const SphereBuffer* buffer : {&balls_, &water_, &sparks_}) buffer->upload();
  }

  void draw_sun_map(const Sun& sun, std::span<const ShadedMesh> meshes) {
    begin(to_sun_map_, kSunMap, kSunMap);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClearDepth(1);
    glClear(GL_DEPTH_BUFFER_BIT);
    sun_program_.use();
    set_view(sun_program_, sun.projection);
    const float scale = 2 * sun.projection.scale / kSunMap;
    sun_program_.set("scale", scale, scale);
    sun_program_.set("parallel", 1);
    sun_program_.set("range", sun.range);
    balls_.draw();
    water_.draw();
    mesh_sun_program_.use();
    set_view(mesh_sun_program_, sun.projection);
    mesh_sun_program_.set("scale", scale, scale);
    mesh_sun_program_.set("parallel", 1);
    mesh_sun_program_.set("range", sun.range);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      // What is cut open for the eye is open for the light.
      if (meshes[k].sides == ShadedMesh::Sides::both) meshes_.draw(k, meshes[k].sides);
    }
    glDisable(GL_DEPTH_TEST);
  }

  // What samples show is told apart by the stencil, so that each kind is shaded by itself.
  enum Stencil { kNothing, kBall, kWater, kSpark };

  void draw_surfaces(const Projection& view, std::span<const ShadedMesh> meshes) {
    begin(to_spheres_, width_, height_);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);  // what is stored falls with the distance
    glClearDepth(0);
    glClearStencil(kNothing);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    sphere_program_.use();
    set_view(sphere_program_, view);
    sphere_program_.set("scale", 2 * view.scale / view.width, 2 * view.scale / view.height);
    sphere_program_.set("parallel", 0);
    sphere_program_.set("nearest", view.nearest);
    glEnable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glStencilFunc(GL_ALWAYS, kBall, 0xff);
    balls_.draw();
    glStencilFunc(GL_ALWAYS, kWater, 0xff);
    water_.draw();
    glStencilFunc(GL_ALWAYS, kSpark, 0xff);
    sparks_.draw();
    glStencilFunc(GL_ALWAYS, kBall, 0xff);  // meshes are shaded alike
    mesh_program_.use();
    set_view(mesh_program_, view);
    mesh_program_.set("scale", 2 * view.scale / view.width, 2 * view.scale / view.height);
    mesh_program_.set("parallel", 0);
    mesh_program_.set("nearest", view.nearest);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      const Color c = meshes[k].color;
      mesh_program_.set("tint", (1 / 255.0f) * Vec3f{static_cast<float>(c.red), static_cast<float>(c.green),
                                                     static_cast<float>(c.blue)});
      meshes_.draw(k, meshes[k].sides);
    }
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_DEPTH_TEST);
  }

  // Ambient light is drawn for every second pixel along each side.
  static int half(int pixels) { return (pixels + 1) / 2; }

  // The passes that look at surfaces need to run only where there are some: `box`, and as far as they look around.
  void begin_surface_passes(const PixelRectangle& box) {
    glClearColor(0, 0, 0, 0);
    for (const Framebuffer& target : to_surface_) {
      begin(target, settings_.width, settings_.height);
      glClear(GL_COLOR_BUFFER_BIT);
    }
    glClearColor(1, 1, 1, 1);
    for (const Framebuffer* target : {&to_ambient_, &to_blurred_}) {
      begin(*target, half(settings_.width), half(settings_.height));
      glClear(GL_COLOR_BUFFER_BIT);
    }
    glEnable(GL_SCISSOR_TEST);
    restrict_to(box);
  }

  static void restrict_to(const PixelRectangle& box) {
    constexpr int kAround = 4;  // pixels, that blur.frag looks around
    glScissor(box.x - kAround, box.y - kAround, box.width + 2 * kAround, box.height + 2 * kAround);
  }

  void reduce() {
    begin(to_surface_[0], settings_.width, settings_.height);
    reduce_program_.use();
    reduce_program_.read("depths", 0, depth_);
    reduce_program_.read("colors", 1, color_);
    reduce_program_.set("samples", settings_.samples);
    cover();
  }

  void smooth_water(const Projection& pixels, float sphere_size) {
    smooth_program_.use();
    smooth_program_.set("range", 4.0f * sphere_size);
    smooth_program_.set("scale", pixels.scale);
    // Wide with few samples first, then what lies between them.
    const float reaches[] = {4.0f, 1.5f};
    const int taps[] = {10, 6};
    for (std::size_t pass = 0; pass < 2; ++pass) {
      begin(to_surface_[1 - pass], settings_.width, settings_.height);
      smooth_program_.read("surface", 0, surface_[pass]);
      smooth_program_.set("reach", reaches[pass] * sphere_size);
      smooth_program_.set("taps", taps[pass]);
      cover();
    }
  }

  void find_water_normals(const Projection& pixels, float sphere_size) {
    begin(to_water_normal_, settings_.width, settings_.height);
    water_normal_program_.use();
    set_picture(water_normal_program_, pixels);
    water_normal_program_.read("surface", 0, surface_[0]);
    water_normal_program_.set("range", 10.0f * sphere_size);
    cover();
  }

  void draw_ambient(const Projection& pixels, const PixelRectangle& box, float sphere_size, const Frame& frame) {
    restrict_to({box.x / 2, box.y / 2, half(box.width), half(box.height)});
    begin(to_ambient_, half(settings_.width), half(settings_.height));
    const Program& program = ambient_program_;
    program.use();
    set_picture(program, pixels);
    program.read("surface", 0, surface_[0]);
    program.read("normals", 1, normal_);
    program.read("water_normals", 2, water_normal_);
    program.set("samples", settings_.samples);
    program.set("reach", 2.5f * sphere_size);
    program.set("far_reach", 0.08f * length_of(frame.action.max - frame.action.min));
    cover();
    begin(to_blurred_, half(settings_.width), half(settings_.height));
    blur_program_.use();
    blur_program_.read("ambient", 0, ambient_[0]);
    cover();
  }

  static void set_picture(const Program& program, const Projection& view) {
    program.set("picture", view.width, view.height);
    program.set("scale", view.scale);
  }

  // What light.glsl asks for.
  void set_light(const Program& program, const Frame& frame, const Projection& view, const Sun& sun,
                 float sphere_size) const {
    program.use();
    set_picture(program, view);
    set_view(program, view);
    program.read("sun_map", 0, sun_map_);
    program.set_rows("to_sun", sun.projection.right, sun.projection.up, sun.projection.back);
    program.set("to_light", sun.to);
    program.set("sun_eye", sun.projection.eye);
    const float scale = 2 * sun.projection.scale / kSunMap;
    program.set("sun_scale", Vec3f{scale, scale, 1 / sun.range});
    program.set("sun_blur", 0.003f * sun.range);
    program.set("up", vec_cast<float>(frame.up));
    program.set("has_ground", frame.ground ? 1 : 0);
    program.set("ground", static_cast<float>(frame.ground.value_or(0)));
    program.set("sky_light", frame.night ? 0.03f : 1.0f);
    program.set("action_center", vec_cast<float>(frame.action.center()));
    program.set("action_size", length_of(frame.action.max - frame.action.min));
    program.set("sphere_size", sphere_size);
    program.set("daylight", frame.daylight);
  }

  void draw_backdrop(const Frame& frame, const Projection& pixels, const Sun& sun, float sphere_size) {
    begin(to_backdrop_, settings_.width, settings_.height);
    set_light(backdrop_program_, frame, pixels, sun, sphere_size);
    backdrop_program_.set("across", vec_cast<float>(frame.across));
    backdrop_program_.set("along", vec_cast<float>(frame.along));
    backdrop_program_.set("line_step", ground_step(frame));
    cover();
  }

  void clear_shaded() {
    begin(to_shaded_, width_, height_);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
  }

  void begin_shading(const Program& program, Stencil kind) {
    program.read("depths", 1, depth_);
    program.read("colors", 2, color_);
    program.read("normals", 3, normal_);
    program.read("ambient", 4, ambient_[1]);
    begin(to_shaded_, width_, height_);
    glEnable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glStencilFunc(GL_EQUAL, kind, 0xff);
  }

  void shade_balls(const Frame& frame, const Projection& view, const Sun& sun, float sphere_size) {
    set_light(ball_program_, frame, view, sun, sphere_size);
    begin_shading(ball_program_, kBall);
    cover();
    glDisable(GL_STENCIL_TEST);
  }

  void shade_sparks() {
    spark_program_.use();
    begin_shading(spark_program_, kSpark);
    cover();
    glDisable(GL_STENCIL_TEST);
  }

  void shade_water(const Frame& frame, const Projection& view, const Sun& sun, float sphere_size) {
    const Program& program = water_program_;
    set_light(program, frame, view, sun, sphere_size);
    program.read("surface", 5, surface_[0]);
    program.read("water_normals", 6, water_normal_);
    program.read("thickness", 7, thickness_);
    program.set("samples", settings_.samples);
    const double height = extent_along(frame.action, frame.up);
    program.set("water_scale", static_cast<float>(0.6 * height));
    begin_shading(program, kWater);
    cover();
    glDisable(GL_STENCIL_TEST);
  }

  void resolve() {
    begin(to_result_, settings_.width, settings_.height);
    resolve_program_.use();
    resolve_program_.read("shaded", 1, shaded_);
    resolve_program_.read("backdrop", 2, backdrop_);
    resolve_program_.set("samples", settings_.samples);
    cover();
  }

  // Edges of the domain that belong to a wall.
  void draw_tank(const Frame& frame, const Projection& view) {
    const Tank& tank = frame.tank;
    std::vector<Vec3f> ends;
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      if (!tank.walls[static_cast<std::size_t>(u)] && !tank.walls[static_cast<std::size_t>(v)]) continue;
      for (int corner = 0; corner < 4; ++corner) {
        Vec3d from = tank.min;
        component(from, u) = component(corner & 1 ? tank.max : tank.min, u);
        component(from, v) = component(corner & 2 ? tank.max : tank.min, v);
        Vec3d to = from;
        component(to, axis) = component(tank.max, axis);
        ends.push_back(vec_cast<float>(from));
        ends.push_back(vec_cast<float>(to));
      }
    }
    begin(to_result_, settings_.width, settings_.height);
    glBindVertexArray(edge_array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, edge_buffer_.get());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(ends.size() * sizeof(Vec3f)), ends.data(), GL_STREAM_DRAW);
    for (GLuint end = 0; end < 2; ++end) {
      glEnableVertexAttribArray(end);
      glVertexAttribPointer(end, 3, GL_FLOAT, GL_FALSE, 2 * sizeof(Vec3f),
                            reinterpret_cast<const void*>(end * sizeof(Vec3f)));
      glVertexAttribDivisor(end, 1);
    }
    edge_program_.use();
    set_view(edge_program_, view);
    edge_program_.set("scale", 2 * view.scale / view.width, 2 * view.scale / view.height);
    edge_program_.set("picture", view.width, view.height);
    edge_program_.set("width", 1.4f);
    edge_program_.set("nearest", view.nearest);
    edge_program_.read("depths", 0, depth_);
    edge_program_.set("samples", settings_.samples);
    edge_program_.set("color", Vec3f{0.93f, 0.95f, 0.97f});
    edge_program_.set("opacity", 0.55f);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(ends.size() / 2));
    glDisable(GL_BLEND);
  }

  Image read_image() const {
    Image flipped(settings_.width, settings_.height);
    glReadPixels(0, 0, flipped.width, flipped.height, GL_RGBA, GL_UNSIGNED_BYTE, flipped.pixels.data());
    const std::size_t row = Image::kChannels * static_cast<std::size_t>(flipped.width);
    for (int y = 0; y < flipped.height / 2; ++y) {
      std::swap_ranges(flipped.at(0, y), flipped.at(0, y) + row, flipped.at(0, flipped.height - 1 - y));
    }
    return flipped;
  }

  EglContext context_;  // outlives all that is in it
  RenderSettings settings_;
  int width_, height_;  // of what is drawn: several samples a pixel
  RenderFigures figures_;

  Texture sun_map_, color_, normal_, depth_, depth_stencil_, shaded_;  // several samples a pixel
  Texture water_normal_, thickness_, backdrop_, result_;
  std::array<Texture, 2> surface_, ambient_;
  Framebuffer to_sun_map_, to_spheres_, to_water_normal_, to_ambient_, to_blurred_, to_backdrop_, to_shaded_,
      to_result_;
  std::array<Framebuffer, 2> to_surface_;
  SphereBuffer balls_, water_, sparks_;
  MeshBuffer meshes_;
  VertexArray nothing_, edge_array_;
  Buffer edge_buffer_;
  Program sun_program_, mesh_sun_program_, sphere_program_, mesh_program_, reduce_program_, smooth_program_,
      water_normal_program_, ambient_program_, blur_program_, backdrop_program_, ball_program_, water_program_,
      spark_program_, resolve_program_, edge_program_;
};

}  // namespace

Expected<std::unique_ptr<Renderer>> make_gl_renderer(const RenderSettings& settings) {
  if (settings.width < 1 || settings.height < 1 || settings.samples < 1 || settings.samples > 4) {
    return fail(Error::Kind::bad_input, "size", "width and height must be at least 1, samples from 1 to 4");
  }
  auto context = EglContext::create();
  if (!context) return fail(std::move(context).error());
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (std::max(settings.width, settings.height) * settings.samples > most) {
    return fail(Error::Kind::bad_input, "size",
                "at most " + std::to_string(most / settings.samples) + " pixels along a side with this driver");
  }
  try {
    return std::make_unique<GlRenderer>(std::move(*context), settings);
  } catch (const std::runtime_error& error) {
    return fail(Error::Kind::bad_input, "OpenGL", error.what());
  }
}

}  // namespace hooke
