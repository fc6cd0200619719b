// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Speed of pictures of half a million particles. Each picture is checked: a wrong one has no speed.

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

#include "hooke/base/random.h"
#include "hooke/render/frame.h"
#include "hooke/render/gl/gl_renderer.h"
#include "hooke/render/visible_spheres.h"

namespace hooke {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr double kRadius = 0.2;
constexpr std::size_t kCount = 512'000;

struct Pool {
  Scene scene;
  ParticleSet particles;
};

// A pool as if at rest: hexagonally close-packed layers over the floor of a tank, slightly jittered.
Pool make_pool(MaterialLook look) {
  constexpr std::size_t kColumns = 160, kRows = 80;
  const double row_step = std::sqrt(3.0) * kRadius, layer_step = 2 * std::sqrt(2.0 / 3) * kRadius;
  Pool pool;
  pool.scene.domain.max = {2 * kRadius * (kColumns + 1), 24, row_step * (kRows + 2)};
  pool.scene.materials = {{"water", kRadius, 1, {}, 0, "#2f7fd6", look}};
  ParticleSet& p = pool.particles;
  p.resize(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::size_t column = i % kColumns, row = i / kColumns % kRows, layer = i / kColumns / kRows;
    const auto u = uniform4(1, i, 0);
    const auto at = [](double step, std::size_t k, double random) {
      return kRadius + step * static_cast<double>(k) + 0.2 * kRadius * (random - 0.5);
    };
    p.id[i] = i + 1;
    p.position[i] = {at(2 * kRadius, column, u[0]) + kRadius * static_cast<double>((row + layer) % 2),
                     at(layer_step, layer, u[1]),
                     at(row_step, row, u[2]) + row_step / 3 * static_cast<double>(layer % 2)};
    p.velocity[i] = {0, 0.5 * u[3], 0};
  }
  return pool;
}

render::Frame make_picture(MaterialLook look) {
  const Pool pool = make_pool(look);
  return render::make_frame(pool.scene, pool.particles, 0,
                            render::make_look(pool.scene, pool.particles, render::ColorBy::material),
                            static_cast<double>(kWidth) / kHeight);
}

// The share of the picture's pixels that are blue; only the pool is blue.
double blue_share(const render::Image& image) {
  std::size_t blue = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += render::Image::kChannels) {
    blue += image.pixels[i + 2] > image.pixels[i] + 25 ? 1 : 0;
  }
  return static_cast<double>(blue) * render::Image::kChannels / static_cast<double>(image.pixels.size());
}

// Peak memory of this process, MB.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

// Whole pictures, from the reference frame to the pixels; argument: as balls or as water.
void draw_picture(benchmark::State& state) {
  const render::Frame frame = make_picture(state.range(0) != 0 ? MaterialLook::water : MaterialLook::ball);
  auto renderer = render::make_gl_renderer({kWidth, kHeight, 2});
  if (!renderer) return state.SkipWithError(renderer.error().text().c_str());
  auto image = (*renderer)->render(frame);  // shaders are compiled at their first use
  for (auto iteration : state) {
    image = (*renderer)->render(frame);
    if (!image) return state.SkipWithError(image.error().text().c_str());
  }
  const double blue = blue_share(*image);
  if (!(blue > 0.3 && blue < 0.8)) return state.SkipWithError("the pool is not where it should be in the picture");
  state.SetLabel((*renderer)->device());
  state.counters["spheres_drawn"] = static_cast<double>((*renderer)->figures().spheres_drawn);
  state.counters["peak_MB"] = peak_memory();
}
BENCHMARK(draw_picture)
    ->ArgName("water")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// Making a reference frame of a run's particles.
void prepare_frame(benchmark::State& state) {
  const Pool pool = make_pool(MaterialLook::water);
  const render::Look look = render::make_look(pool.scene, pool.particles, render::ColorBy::material);
  render::Frame frame;
  for (auto iteration : state) frame = render::make_frame(pool.scene, pool.particles, 0, look, 1.5);
  if (frame.spheres.size() != kCount || frame.spheres[0].foam == 0) return state.SkipWithError("not the pool's frame");
}
BENCHMARK(prepare_frame)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void find_visible_spheres(benchmark::State& state) {
  const render::Frame frame = make_picture(MaterialLook::ball);
  const render::Projection view = render::project(frame.camera, 2 * kWidth, 2 * kHeight);
  std::vector<std::uint32_t> visible;
  for (auto iteration : state) visible = render::visible_spheres(frame.spheres, view);
  // The picture shows two sides and the top of the pool, and some balls below through the gaps.
  if (visible.size() < 160 * 80 || visible.size() > kCount / 5) return state.SkipWithError("not a pool's surface");
  state.counters["visible"] = static_cast<double>(visible.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kCount));
}
BENCHMARK(find_visible_spheres)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
}  // namespace hooke
