// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Surfaces of known shapes: VTK reads the meshes and measures them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "hooke/io/export.h"
#include "hooke/volumes/openvdb_support.h"
#include "samples.h"
#include "source_dir.h"

namespace hooke {
namespace {

constexpr double kRadius = 0.2;
constexpr double kSphere = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;

/// The output of read_mesh.py.
struct Measures {
  double points, faces, bad_edges, volume, cosine;
};

class ExportSurface : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!volumes::has_openvdb()) GTEST_SKIP() << "needs OpenVDB, which is not in this build";
  }
  void add(const Vec3d& x) {
    ParticleSet& p = snapshot_.particles;
    p.id.push_back(p.size());
    p.material.push_back(0);
    p.position.push_back(x);
    p.velocity.push_back({1, -2, 0.5});
  }
  /// Adds n^3 particles that touch, from (-1, 2, 3) on.
  void add_block(int n) {
    for (int i = 0; i < n * n * n; ++i) {
      const Vec3d at{double(i % n), double(i / n % n), double(i / (n * n))};
      add(Vec3d{-1, 2, 3} + 2 * kRadius * at);
    }
  }
  Expected<std::vector<std::filesystem::path>> exported(const volumes::SurfaceOptions& surface) {
    const io::RunInfo info{
        "s", 0.005, Integrator::symplectic_euler, Precision::single_precision, {{"water", kRadius, 1}}};
    const io::RunReader run = samples::write_run(folder_ / "run", info, {snapshot_});
    io::ExportOptions options;
    options.content = io::ExportContent::surface;
    options.surface = surface;
    return io::export_run(run, std::vector<std::size_t>{0}, folder_ / (std::string("s.") + GetParam()), options);
  }
  Measures measured(const volumes::SurfaceOptions& surface = {}) {
    const auto files = exported(surface);
    if (!files) throw std::runtime_error(files.error().text());
    const auto words = samples::words(samples::output_of(
        fmt::format("/usr/bin/python3 '{}/tests/io/read_mesh.py' '{}'", HOOKE_SOURCE_DIR, files->front().string())));
    const auto word = [&](std::size_t k) { return samples::number(words.at(k)); };
    return {word(0), word(1), word(2), word(3), word(4)};
  }

  const samples::TemporaryFolder folder_;
  Snapshot snapshot_{40, 0.2, {}};
};

TEST_P(ExportSurface, OfALoneParticleIsItsSphere) {
  add({0.31, -4.2, 7.7});
  const Measures m = measured({1, 1.5, 0.1});
  EXPECT_GT(m.points, 500);
  EXPECT_EQ(m.bad_edges, 0);
  EXPECT_NEAR(m.volume / kSphere, 1, 0.02);
  EXPECT_GT(m.cosine, 0.95);  // outward, and smooth
}

TEST_P(ExportSurface, OfALargerRadiusIsALargerSphere) {
  add({0, 0, 0});
  EXPECT_NEAR(measured({1.5, 1.5, 0.15}).volume / (1.5 * 1.5 * 1.5 * kSphere), 1, 0.02);
}

TEST_P(ExportSurface, OfABlockIsTheBlock) {
  add_block(8);
  const Measures m = measured();
  EXPECT_EQ(m.bad_edges, 0);
  EXPECT_NEAR(m.volume / std::pow(8 * 2 * kRadius, 3), 1, 0.02);
  EXPECT_GT(m.cosine, 0.5);
}

TEST_P(ExportSurface, WithoutMuchSmoothingIsOfSingleSpheres) {
  add_block(4);
  const Measures m = measured({0.9, 0.15, 0.15});
  EXPECT_EQ(m.bad_edges, 0);
  EXPECT_NEAR(m.volume / (64 * 0.9 * 0.9 * 0.9 * kSphere), 1, 0.05);
}

TEST_P(ExportSurface, RefusesOptionsOutOfRange) {
  add({0, 0, 0});
  const std::pair<volumes::SurfaceOptions, const char*> wrong[] = {
      {{0, 1.5, 0.5}, "radius 0 is not from 0.1 to 10"},        {{1, 0, 0.5}, "smoothing 0 is not from 0.5 to 10"},
      {{1, 1.5, 0}, "resolution 0 is not from 0.1 to 1"},       {{1, 1.5, 1.1}, "resolution 1.1 is not from 0.1 to 1"},
      {{std::nan(""), 1.5, 0.5}, "radius nan is not from 0.1"},
  };
  for (const auto& [options, message] : wrong) {
    std::filesystem::remove_all(folder_ / "run");
    const auto files = exported(options);
    ASSERT_FALSE(files) << message;
    EXPECT_EQ(files.error().kind, Error::Kind::bad_input);
    EXPECT_NE(files.error().text().find(message), std::string::npos) << files.error().text();
  }
  std::filesystem::remove_all(folder_ / "run");
  snapshot_.particles.position[0].x = 1e7;
  const auto far = exported({});
  ASSERT_FALSE(far);
  EXPECT_NE(far.error().text().find("too far"), std::string::npos) << far.error().text();
  EXPECT_EQ(samples::files_in(folder_.path()), std::vector<std::string>{"run"});
}

TEST_P(ExportSurface, OfNobodyIsEmpty) {
  const auto files = exported({});
  ASSERT_TRUE(files) << files.error().text();
  EXPECT_LT(std::filesystem::file_size(files->front()), 400U);
}

INSTANTIATE_TEST_SUITE_P(Formats, ExportSurface, testing::Values("ply", "obj"),
                         [](const auto& format) { return std::string(format.param); });

class ExportSurfacePly : public ExportSurface {};

TEST_P(ExportSurfacePly, CarriesTheFluidsVelocity) {
  add_block(3);
  const auto files = exported({});
  ASSERT_TRUE(files);
  const std::string text = samples::read_file(files->front());
  const std::string end = "end_header\n";
  const char* row = text.data() + text.find(end) + end.size();
  const std::size_t at = text.find("element vertex ") + 15;
  const int count = std::stoi(text.substr(at, 20));
  ASSERT_GT(count, 100);
  for (int i = 0; i < count; ++i, row += 36) {
    float v[3];
    std::memcpy(v, row + 24, sizeof v);
    ASSERT_NEAR(v[0], 1, 1e-5) << i;
    ASSERT_NEAR(v[1], -2, 1e-5) << i;
    ASSERT_NEAR(v[2], 0.5, 1e-5) << i;
  }
}

// Two materials side by side: a closed surface each, in its colour.
TEST_P(ExportSurface, IsByMaterial) {
  add({0, 0, 0});
  add({1.5 * kRadius, 0, 0});
  EXPECT_EQ(measured({1, 1.5, 0.1}).bad_edges, 0);
  snapshot_.particles.material[1] = 1;
  const io::RunInfo info{"s",
                         0.005,
                         Integrator::symplectic_euler,
                         Precision::single_precision,
                         {{"water", kRadius, 1}, {"oil", kRadius, 1}}};
  const io::RunReader run = samples::write_run(folder_ / "two", info, {snapshot_});
  Scene scene;
  scene.materials = {{"water", kRadius, 1, {}, 0, "#0000ff"}, {"oil", kRadius, 1, {}, 0, "#ff8000"}};
  io::ExportOptions options;
  options.content = io::ExportContent::surface;
  options.surface = {1, 1.5, 0.1};
  options.scene = &scene;
  const auto file = folder_ / (std::string("two.") + GetParam());
  const auto files = io::export_run(run, std::vector<std::size_t>{0}, file, options);
  ASSERT_TRUE(files) << files.error().text();
  const auto words = samples::words(samples::output_of(
      fmt::format("/usr/bin/python3 '{}/tests/io/read_mesh.py' '{}'", HOOKE_SOURCE_DIR, file.string())));
  EXPECT_EQ(samples::number(words.at(2)), 0) << "bad edges";
  EXPECT_NEAR(samples::number(words.at(3)) / kSphere, 2, 0.1) << "two whole spheres";
  const std::string text = samples::read_file(file);
  if (std::string(GetParam()) == "obj") {
    EXPECT_NE(text.find("\no water\n"), std::string::npos);
    EXPECT_NE(text.find("\no oil\n"), std::string::npos);
    EXPECT_NE(text.find(" 0 0 1\n"), std::string::npos) << "blue";
    EXPECT_NE(text.find(" 1 0.502 0\n"), std::string::npos) << "orange";
  } else {
    EXPECT_NE(text.find("property uchar blue"), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, ExportSurfacePly, testing::Values("ply"),
                         [](const auto& format) { return std::string(format.param); });

}  // namespace
}  // namespace hooke
