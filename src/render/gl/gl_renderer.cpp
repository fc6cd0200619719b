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
#include "hooke/render/gl/glass_layer.h"
#include "hooke/render/gl/lighting.h"
#include "hooke/render/gl/render_programs.h"
#include "hooke/render/gl/render_targets.h"
#include "hooke/render/gl/seen_spheres.h"
#include "hooke/render/gl/sun_maps.h"
#include "hooke/render/gl/surface_passes.h"
#include "hooke/render/gl/tank_edges.h"
#include "hooke/render/visible_spheres.h"
#include "hooke/render/water_thickness.h"

namespace hooke::render {

namespace {

using Clock = std::chrono::steady_clock;
using gl::Program;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Distance between the ground's lines, m: a power of ten, such that the action's diagonal is 3 to 30 steps long.
float ground_step(const Frame& frame) { return std::pow(10.0f, std::floor(std::log10(action_size(frame) / 3))); }

bool has_glass(const Frame& frame) {
  return std::any_of(frame.meshes.begin(), frame.meshes.end(), [](const ShadedMesh& m) { return m.is_glass(); });
}

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
    HOOKE_ASSERT(!settings_.linear);
    return draw(frame, [this] { return targets_.read_result(); });
  }
  Expected<LinearImage> render_linear(const Frame& frame) override {
    HOOKE_ASSERT(settings_.linear);
    return draw(frame, [this] { return targets_.read_linear_result(); });
  }

  RenderFigures figures() const override { return figures_; }
  std::string device() const override { return context_.device(); }

 private:
  template <class Read>
  auto draw(const Frame& frame, const Read& read) -> Expected<decltype(read())> {
    HOOKE_ASSERT(std::this_thread::get_id() == thread_);
    const Clock::time_point start = Clock::now();
    context_.make_current();
    const Projection view = project(frame.camera, targets_.samples_across, targets_.samples_down);
    const Sun sun = make_sun(frame);
    parallel_ranges(2, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        k == 0 ? eye_.find(frame.spheres, view) : sun_.find(frame.spheres, sun.projection);
      }
    });
    const bool water = !eye_.indices(true).empty();
    if (water) targets_.upload_thickness(water_thickness(frame.spheres, view));
    figures_ = {eye_.count(), seconds_since(start), 0};

    meshes_.upload(frame.meshes);
    eye_.upload();
    sun_.upload();
    draw_sun_maps(targets_, programs_, sun, sun_, water, meshes_, frame.meshes);
    const Projection pixels = project(frame.camera, settings_.width, settings_.height);
    light_ = {&frame, sun, typical_radius(frame, main_kind()), water};
    draw_solids(view, pixels);
    draw_backdrop(pixels);
    if (water) draw_water(view, pixels);
    const bool glass = has_glass(frame);
    if (glass) draw_glass(view);
    resolve(targets_.to_result, true, glass);
    draw_tank(targets_.to_result, frame, pixels, settings_.linear);
    auto image = read();
    if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
      return fail(Error::Kind::run_failed, "OpenGL", "error " + std::to_string(error) + " of " + context_.device());
    }
    figures_.total_seconds = seconds_since(start);
    return image;
  }

  // The kind of sphere whose size shades are made for.
  SphereKind main_kind() const {
    for (const SphereKind kind : {SphereKind::ball, SphereKind::skin, SphereKind::water}) {
      if (eye_.has(kind)) return kind;
    }
    return SphereKind::spark;
  }

  // The stencil tells what each sample shows, so that each kind is shaded by itself.
  enum Stencil { kNothing, kBall, kSkin, kSpark };
  using Smooth = SurfacePasses::Smooth;

  static void use_for_surfaces(const Program& program, const Projection& view) {
    program.use();
    set_view(program, view);
    program.set("clip_scale", 2 * view.scale / view.width, 2 * view.scale / view.height);
    program.set("parallel", 0);
    program.set("nearest", view.nearest);
    program.set("side", 1.0f);
    program.set("trimmed", 0);
  }

  // Draws and shades all but water and glass.
  void draw_solids(const Projection& view, const Projection& pixels) {
    const Frame& frame = *light_.frame;
    const bool skin = eye_.has(SphereKind::skin);
    const bool matt = eye_.has(SphereKind::ball) || !frame.meshes.empty();
    draw_surfaces(view, frame.meshes, false);
    const PixelRectangle box = frame.meshes.empty() ? bounds_on_picture(frame.spheres, eye_.indices(false), pixels)
                                                    : PixelRectangle{0, 0, settings_.width, settings_.height};
    const float skin_size = typical_radius(frame, SphereKind::skin);
    if (skin) {
      surface_passes_.find_outline(Smooth::skin, pixels, box, skin_size);
      draw_surfaces(view, frame.meshes, true);
      surface_passes_.smooth(Smooth::skin, frame, pixels, box, skin_size);
      draw_smoothed(view, SphereKind::skin, GL_EQUAL, 1);  // from now on it counts as solid
    }
    surface_passes_.find_solids(frame, pixels, box, light_.sphere_size, matt && !skin);
    clear_shaded();
    if (matt) shade(programs_.ball, kBall, view);
    if (skin) {
      programs_.skin.use();
      programs_.skin.read("surface", 5, targets_.surface[0]);
      programs_.skin.read("skin_normals", 6, targets_.water_normal);
      programs_.skin.set("samples", settings_.samples);
      programs_.skin.set("skin_size", skin_size);
      shade(programs_.skin, kSkin, view);
    }
    if (eye_.has(SphereKind::spark)) shade(programs_.spark, kSpark, view);
  }

  // `trimmed`: skins without what sticks out of their outline, once that is known.
  void draw_surfaces(const Projection& view, std::span<const ShadedMesh> meshes, bool trimmed) {
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
    eye_.of(SphereKind::ball).draw();
    glStencilFunc(GL_ALWAYS, kSpark, 0xff);
    eye_.of(SphereKind::spark).draw();
    glStencilFunc(GL_ALWAYS, kBall, 0xff);  // meshes are shaded alike
    use_for_surfaces(programs_.mesh, view);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      if (meshes[k].is_glass()) continue;
      programs_.mesh.set("tint", meshes[k].tint());
      programs_.mesh.set("roughness", meshes[k].roughness);
      meshes_.draw(k, meshes[k].sides == ShadedMesh::Sides::inner ? MeshBuffer::Faces::away : MeshBuffer::Faces::all);
    }
    glStencilFunc(GL_ALWAYS, kSkin, 0xff);
    draw_smoothed(view, SphereKind::skin, GL_GREATER, -1, trimmed);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_DEPTH_TEST);
  }

  // Over what is drawn already. `side`: -1 where the surface passes are to smooth it.
  void draw_smoothed(const Projection& view, SphereKind kind, GLenum passes, float side, bool trimmed = false) {
    if (!eye_.has(kind)) return;
    targets_.begin_samples(targets_.to_spheres);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(passes);
    use_for_surfaces(programs_.sphere, view);
    programs_.sphere.set("side", side);
    if (trimmed) {
      const Smooth what = kind == SphereKind::water ? Smooth::water : Smooth::skin;
      programs_.sphere.set("trimmed", 1);
      programs_.sphere.set("bodies", what == Smooth::skin ? 1 : 0);
      programs_.sphere.read("outline", 0, targets_.outline[static_cast<std::size_t>(what)]);
      programs_.sphere.set("sample_picture", view.width, view.height);
    }
    eye_.of(kind).draw();
    glDisable(GL_DEPTH_TEST);
  }

  void draw_water(const Projection& view, const Projection& pixels) {
    const Frame& frame = *light_.frame;
    const bool glass = has_glass(frame);
    if (glass) draw_glass(view);
    if (glass || !frame.meshes.empty() || !eye_.indices(false).empty()) {
      resolve(targets_.to_behind, false, glass);
    } else {
      targets_.copy(targets_.to_backdrop, targets_.to_behind);
    }
    draw_tank(targets_.to_behind, frame, pixels, false);
    draw_smoothed(view, SphereKind::water, GL_GREATER, -1);
    const float water_size = typical_radius(frame, SphereKind::water);
    const PixelRectangle box = bounds_on_picture(frame.spheres, eye_.indices(true), pixels);
    surface_passes_.find_outline(Smooth::water, pixels, box, water_size);
    const bool skin = eye_.has(SphereKind::skin);
    draw_surfaces(view, frame.meshes, skin);
    if (skin) draw_smoothed(view, SphereKind::skin, GL_EQUAL, 1);
    draw_smoothed(view, SphereKind::water, GL_GREATER, -1, true);
    surface_passes_.smooth(Smooth::water, frame, pixels, box, water_size);
    shade_water(pixels, water_size);
  }

  void draw_glass(const Projection& view) {
    light_.use(programs_.glass, view, targets_);
    use_for_surfaces(programs_.glass, view);
    programs_.glass.set("lead", light_.water ? 1.2f * typical_radius(*light_.frame, SphereKind::water) : 0.0f);
    glass_.draw(targets_, programs_.glass, meshes_, light_.frame->meshes, view.eye);
  }

  void draw_backdrop(const Projection& pixels) {
    targets_.begin_pixels(targets_.to_backdrop);
    light_.use(programs_.backdrop, pixels, targets_);
    programs_.backdrop.set("across", vec_cast<float>(light_.frame->across));
    programs_.backdrop.set("along", vec_cast<float>(light_.frame->along));
    programs_.backdrop.set("line_step", light_.frame->ground_lines ? ground_step(*light_.frame) : 0.0f);
    whole_.draw();
  }

  void clear_shaded() {
    targets_.begin_samples(targets_.to_shaded);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
  }

  // Shades the samples that show a kind.
  void shade(const Program& program, Stencil kind, const Projection& view) {
    light_.use(program, view, targets_);
    program.read("depths", 1, targets_.depth);
    program.read("colors", 2, targets_.color);
    program.read("normals", 3, targets_.normal);
    program.read("ambient", 4, targets_.ambient[1]);
    targets_.begin_samples(targets_.to_shaded);
    glEnable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glStencilFunc(GL_EQUAL, kind, 0xff);
    whole_.draw();
    glDisable(GL_STENCIL_TEST);
  }

  void shade_water(const Projection& pixels, float water_size) {
    const Program& program = programs_.water;
    targets_.begin_pixels(targets_.to_water);
    light_.use(program, pixels, targets_);
    program.read("depths", 1, targets_.depth);
    program.read("colors", 2, targets_.color);
    program.read("normals", 3, targets_.normal);
    program.read("ambient", 4, targets_.ambient[1]);
    program.read("surface", 5, targets_.surface[0]);
    program.read("water_normals", 6, targets_.water_normal);
    program.read("thickness", 7, targets_.thickness);
    program.read("behind", 8, targets_.behind);
    program.read("solids", 10, targets_.solids);
    program.set("samples", settings_.samples);
    const double height = extent_along(light_.frame->action, light_.frame->up);
    program.set("water_scale", static_cast<float>(0.6 * height));
    program.set("water_size", water_size);
    whole_.draw();
  }

  void resolve(const gl::Framebuffer& target, bool last, bool glass) {
    targets_.begin_pixels(target);
    const Program& program = programs_.resolve;
    program.use();
    program.read("shaded", 1, targets_.shaded);
    program.read("backdrop", 2, targets_.backdrop);
    program.read("depths", 3, targets_.depth);
    program.read("water", 4, targets_.water);
    program.set("samples", settings_.samples);
    program.read("glass", 5, glass ? glass_.texture() : targets_.shaded);
    program.set("has_glass", glass ? 1 : 0);
    program.set("last", last ? 1 : 0);
    program.set("linear_light", settings_.linear ? 1 : 0);
    program.set("brightest", targets_.brightest());
    program.set("transparent", light_.frame->transparent ? 1 : 0);
    whole_.draw();
  }

  void draw_tank(const gl::Framebuffer& target, const Frame& frame, const Projection& view, bool linear) {
    targets_.begin_pixels(target);
    tank_edges_.upload(frame.tank);
    const Vec3f color = linear ? Vec3f{0.85f, 0.89f, 0.93f} : Vec3f{0.93f, 0.95f, 0.97f};  // the same in sRGB
    tank_edges_.draw(programs_.edge, view, color, targets_.depth, settings_.samples);
  }

  std::thread::id thread_ = std::this_thread::get_id();  // the thread that made the renderer
  EglContext context_;  // declared first, so it outlives the OpenGL objects
  RenderSettings settings_;
  RenderFigures figures_;
  Lighting light_;  // of the picture that is drawn
  RenderTargets targets_;
  RenderPrograms programs_;
  SeenSpheres eye_, sun_;
  GlassLayer glass_;
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

}  // namespace hooke::render
