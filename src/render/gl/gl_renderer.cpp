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
#include <thread>
#include <utility>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/render/gl/egl_context.h"
#include "hooke/render/gl/gl_buffers.h"
#include "hooke/render/gl/gl_objects.h"
#include "hooke/render/gl/render_programs.h"
#include "hooke/render/gl/render_targets.h"
#include "hooke/render/gl/sun.h"
#include "hooke/render/gl/surface_passes.h"
#include "hooke/render/gl/tank_edges.h"
#include "hooke/render/visible_spheres.h"
#include "hooke/render/water_thickness.h"

namespace hooke {

namespace {

using Clock = std::chrono::steady_clock;
using gl::Program;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Distance between the ground's lines, m: a power of ten, such that the action's diagonal is 3 to 30 steps long.
float ground_step(const Frame& frame) { return std::pow(10.0f, std::floor(std::log10(action_size(frame) / 3))); }

class GlRenderer final : public Renderer {
 public:
  GlRenderer(EglContext context, const RenderSettings& settings)
      : context_(std::move(context)),
        settings_(settings),
        targets_(settings) {
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
  }

  // The members' OpenGL objects are then deleted in their own context.
  ~GlRenderer() override { context_.make_current(); }

  Expected<Image> render(const Frame& frame) override {
    HOOKE_ASSERT(std::this_thread::get_id() == thread_);
    const Clock::time_point start = Clock::now();
    context_.make_current();
    const Projection view = project(frame.camera, targets_.samples_across, targets_.samples_down);
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
    surface_passes_.run(frame, pixels, box, sphere_size, water);
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
  static float typical_radius(const Frame& frame) {
    return frame.spheres.empty() ? 1.0f : frame.spheres[frame.spheres.size() / 2].radius;
  }

  void upload_thickness(const WaterThickness& thickness) {
    glBindTexture(GL_TEXTURE_2D, targets_.thickness.get());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, thickness.columns, thickness.rows, 0, GL_RED, GL_FLOAT,
                 thickness.meters.data());
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

  static void use_for_sun_map(const Program& program, const Sun& sun) {
    program.use();
    set_view(program, sun.projection);
    program.set("scale", sun.scale(), sun.scale());
    program.set("parallel", 1);
    program.set("range", sun.range);
  }

  void draw_sun_map(const Sun& sun, std::span<const ShadedMesh> meshes) {
    targets_.begin_sun_map();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClearDepth(1);
    glClear(GL_DEPTH_BUFFER_BIT);
    use_for_sun_map(programs_.sun, sun);
    balls_.draw();
    water_.draw();
    use_for_sun_map(programs_.mesh_sun, sun);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      // A mesh that is cut open for the eye lets the light in too.
      if (meshes[k].sides == ShadedMesh::Sides::both) meshes_.draw(k, meshes[k].sides);
    }
    glDisable(GL_DEPTH_TEST);
  }

  // The stencil tells what each sample shows, so that each kind is shaded by itself.
  enum Stencil { kNothing, kBall, kWater, kSpark };

  static void use_for_surfaces(const Program& program, const Projection& view) {
    program.use();
    set_view(program, view);
    program.set("scale", 2 * view.scale / view.width, 2 * view.scale / view.height);
    program.set("parallel", 0);
    program.set("nearest", view.nearest);
  }

  void draw_surfaces(const Projection& view, std::span<const ShadedMesh> meshes) {
    targets_.begin_samples(targets_.to_spheres);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);  // stored depth decreases with distance
    glClearDepth(0);
    glClearStencil(kNothing);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    use_for_surfaces(programs_.sphere, view);
    glEnable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glStencilFunc(GL_ALWAYS, kBall, 0xff);
    balls_.draw();
    glStencilFunc(GL_ALWAYS, kWater, 0xff);
    water_.draw();
    glStencilFunc(GL_ALWAYS, kSpark, 0xff);
    sparks_.draw();
    glStencilFunc(GL_ALWAYS, kBall, 0xff);  // meshes are shaded alike
    use_for_surfaces(programs_.mesh, view);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      const Color c = meshes[k].color;
      programs_.mesh.set("tint", (1 / 255.0f) * Vec3f{static_cast<float>(c.red), static_cast<float>(c.green),
                                                      static_cast<float>(c.blue)});
      meshes_.draw(k, meshes[k].sides);
    }
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_DEPTH_TEST);
  }

  // Sets the uniforms of light.glsl.
  void set_light(const Program& program, const Frame& frame, const Projection& view, const Sun& sun,
                 float sphere_size) const {
    program.use();
    set_picture(program, view);
    set_view(program, view);
    program.read("sun_map", 0, targets_.sun_map);
    program.set_rows("to_sun", sun.projection.right, sun.projection.up, sun.projection.back);
    program.set("to_light", sun.to);
    program.set("sun_eye", sun.projection.eye);
    const float scale = sun.scale();
    program.set("sun_scale", Vec3f{scale, scale, 1 / sun.range});
    program.set("sun_blur", 0.003f * sun.range);
    program.set("up", vec_cast<float>(frame.up));
    program.set("has_ground", frame.ground ? 1 : 0);
    program.set("ground", static_cast<float>(frame.ground.value_or(0)));
    program.set("sky_light", frame.night ? 0.03f : 1.0f);
    program.set("action_center", vec_cast<float>(frame.action.center()));
    program.set("action_size", action_size(frame));
    program.set("sphere_size", sphere_size);
    program.set("daylight", frame.daylight);
  }

  void draw_backdrop(const Frame& frame, const Projection& pixels, const Sun& sun, float sphere_size) {
    targets_.begin_pixels(targets_.to_backdrop);
    set_light(programs_.backdrop, frame, pixels, sun, sphere_size);
    programs_.backdrop.set("across", vec_cast<float>(frame.across));
    programs_.backdrop.set("along", vec_cast<float>(frame.along));
    programs_.backdrop.set("line_step", ground_step(frame));
    whole_.draw();
  }

  void clear_shaded() {
    targets_.begin_samples(targets_.to_shaded);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
  }

  void begin_shading(const Program& program, Stencil kind) {
    program.read("depths", 1, targets_.depth);
    program.read("colors", 2, targets_.color);
    program.read("normals", 3, targets_.normal);
    program.read("ambient", 4, targets_.ambient[1]);
    targets_.begin_samples(targets_.to_shaded);
    glEnable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glStencilFunc(GL_EQUAL, kind, 0xff);
  }

  void shade_balls(const Frame& frame, const Projection& view, const Sun& sun, float sphere_size) {
    set_light(programs_.ball, frame, view, sun, sphere_size);
    begin_shading(programs_.ball, kBall);
    whole_.draw();
    glDisable(GL_STENCIL_TEST);
  }

  void shade_sparks() {
    programs_.spark.use();
    begin_shading(programs_.spark, kSpark);
    whole_.draw();
    glDisable(GL_STENCIL_TEST);
  }

  void shade_water(const Frame& frame, const Projection& view, const Sun& sun, float sphere_size) {
    const Program& program = programs_.water;
    set_light(program, frame, view, sun, sphere_size);
    program.read("surface", 5, targets_.surface[0]);
    program.read("water_normals", 6, targets_.water_normal);
    program.read("thickness", 7, targets_.thickness);
    program.set("samples", settings_.samples);
    const double height = extent_along(frame.action, frame.up);
    program.set("water_scale", static_cast<float>(0.6 * height));
    begin_shading(program, kWater);
    whole_.draw();
    glDisable(GL_STENCIL_TEST);
  }

  void resolve() {
    targets_.begin_pixels(targets_.to_result);
    programs_.resolve.use();
    programs_.resolve.read("shaded", 1, targets_.shaded);
    programs_.resolve.read("backdrop", 2, targets_.backdrop);
    programs_.resolve.set("samples", settings_.samples);
    whole_.draw();
  }

  void draw_tank(const Frame& frame, const Projection& view) {
    const Program& program = programs_.edge;
    tank_edges_.upload(frame.tank);
    targets_.begin_pixels(targets_.to_result);
    program.use();
    set_view(program, view);
    program.set("scale", 2 * view.scale / view.width, 2 * view.scale / view.height);
    program.set("picture", view.width, view.height);
    program.set("width", 1.4f);
    program.set("nearest", view.nearest);
    program.read("depths", 0, targets_.depth);
    program.set("samples", settings_.samples);
    program.set("color", Vec3f{0.93f, 0.95f, 0.97f});
    program.set("opacity", 0.55f);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    tank_edges_.draw();
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

  std::thread::id thread_ = std::this_thread::get_id();  // the thread that made the renderer
  EglContext context_;  // declared first, so it outlives the OpenGL objects
  RenderSettings settings_;
  RenderFigures figures_;
  RenderTargets targets_;
  RenderPrograms programs_;
  SphereBuffer balls_, water_, sparks_;
  MeshBuffer meshes_;
  TankEdges tank_edges_;
  WholePicture whole_;
  SurfacePasses surface_passes_{targets_, programs_, settings_.samples};
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
