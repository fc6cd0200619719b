// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "samples.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <numeric>
#include <random>
#include <sstream>
#include <stdexcept>

#include "hooke/io/export.h"
#include "hooke/io/failure.h"

namespace hooke::samples {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  static std::atomic<int> count = 0;
  path_ = fs::temp_directory_path() / ("hooke-io-test-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
  fs::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

io::RunInfo run_info(Precision precision) {
  return {"sample", 0.005, Integrator::symplectic_euler, precision, {{"water", 0.2, 1.0}, {"oil", 0.35, 0.8}}};
}

ParticleSet particles(std::int64_t step, std::size_t n, Precision precision) {
  std::mt19937_64 random(static_cast<std::uint64_t>(step) + 1);
  std::uniform_real_distribution<double> uniform(-100, 100);
  const auto number = [&] {
    const double x = uniform(random);
    return precision == Precision::single_precision ? static_cast<double>(static_cast<float>(x)) : x;
  };
  ParticleSet p;
  for (std::size_t i = 0; i < n; ++i) {
    p.id.push_back(3 * i + 1);
    p.material.push_back(static_cast<std::uint16_t>(i % 3 == 0));
    p.position.push_back({number(), number(), number()});
    p.velocity.push_back({number(), number(), number()});
  }
  return p;
}

Snapshot snapshot(std::int64_t step, std::size_t n, Precision precision) {
  return {step, static_cast<double>(step) * 0.005, particles(step, n, precision)};
}

SimulationState state(std::int64_t step, std::size_t n) {
  SimulationState s;
  s.particles = particles(step, n, Precision::double_precision);
  s.particles.acceleration = particles(step + 1000, n, Precision::double_precision).position;
  s.step = step;
  s.next_id = 3 * n + 20;  // above all ids below
  int k = 0;  // sums of a few numbers that no double holds
  LedgerSums::for_each_sum(
      [&k](ExactSum& sum) {
        for (int i = ++k; i % 4 > 0; ++i) sum.add(std::pow(-7.0, 11 * i - 300));
      },
      s.ledger);
  s.ledger.kick = 1.0 / 3000;
  s.ledger.kicks.force[Cause::drag].add({5e-324, 1.7976931348623157e308, 2});
  LedgerSums::for_each_count([&k](std::uint64_t& count) { count = 0xffffffffffffffffU - static_cast<unsigned>(++k); },
                             s.ledger);
  s.emission.emitters = {{1.0 / 3, 12, 3, 0xffffffffU, 64}, {}};
  s.emission.mortals = {{7, 3, 0}, {7, 9, 1}, {0x7fffffffffffffff, 2, 0}};
  const auto structure = std::make_shared<Structure>();
  for (std::uint64_t i = 0; i < n; ++i) {
    structure->springs.push_back({3 * i + 1, 3 * i + 4, 0.1 * static_cast<double>(i + 1), 1e3 / 3, 0.7, 0.5,
                                  static_cast<SpringMode>(i % 3), i % 2 == 0});
    if (i % 5 == 0) structure->pinned.push_back(3 * i + 1);
    if (i % 7 == 0) s.broken_springs.push_back(i);
  }
  structure->surfaces = {{"linen", {1, 4, 7}, {0, 1, 2}}, {"silk", {10, 13, 16, 19}, {0, 1, 2, 1, 2, 3}}};
  s.structure = structure;
  s.initial_energy = 1e15 / 3;
  s.initial_elastic = 1.0 / 9;
  s.initial_momentum = {-1, 0.1, 7};
  return s;
}

io::SeriesRow series_row(std::int64_t step) {
  io::SeriesRow row;
  row.step = step;
  row.time = static_cast<double>(step) * 0.005;
  row.measurements.kinetic_energy = static_cast<double>(step) / 3;
  row.measurements.max = {1.5, 2.5, 3.5};
  return row;
}

Scene scene(const io::RunInfo& info) {
  Scene s;
  s.name = info.scene;
  s.time_step = info.time_step;
  s.gravity = {0, 0, -9.8};
  s.domain.min = {-110, -100, -120};
  s.domain.max = {115, 100, 105.5};
  s.domain.boundary[1] = Boundary::periodic;
  const char* colors[] = {"#2f7fd6", "#ff0080", ""};
  for (std::size_t m = 0; m < info.materials.size(); ++m) {
    Material& material = s.materials.emplace_back();
    material.name = info.materials[m].name;
    material.radius = info.materials[m].radius;
    material.mass = info.materials[m].mass;
    material.color = colors[m % std::size(colors)];
  }
  return s;
}

io::RunReader write_run(const fs::path& folder, const io::RunInfo& info, const std::vector<Snapshot>& snapshots) {
  io::RunWriter writer = io::take(io::RunWriter::create(folder, info, "{}\n", {}));
  for (const Snapshot& snapshot : snapshots) io::take(writer.write_snapshot(snapshot));
  io::take(writer.finish());
  return io::take(io::RunReader::open(folder));
}

std::vector<fs::path> export_all(const io::RunReader& run, const fs::path& file, const Scene* scene) {
  std::vector<std::size_t> all(run.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  io::ExportOptions options;
  options.scene = scene;
  return io::take(io::export_run(run, all, file, options));
}

namespace {

bool same(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const Vec3d& u, const Vec3d& v) {
    return bits(u.x) == bits(v.x) && bits(u.y) == bits(v.y) && bits(u.z) == bits(v.z);
  });
}

}  // namespace

bool same(const ParticleSet& a, const ParticleSet& b) {
  return a.id == b.id && a.material == b.material && same(a.position, b.position) && same(a.velocity, b.velocity) &&
         same(a.acceleration, b.acceleration);
}

bool same(const Snapshot& a, const Snapshot& b) {
  return a.step == b.step && a.time == b.time && same(a.particles, b.particles);
}

std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const fs::path& file, const std::string& content) {
  std::ofstream out(file, std::ios::binary);
  out << content;
}

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

namespace {

template <class Real>
Real parse(const std::string& text) {
  Real value{};
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) throw std::runtime_error("\"" + text + "\" is no number");
  return value;
}

}  // namespace

double number(const std::string& text, Precision precision) {
  return precision == Precision::single_precision ? static_cast<double>(parse<float>(text)) : parse<double>(text);
}

std::string output_of(const std::string& command) {
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error(command + " can't be started");
  std::string output;
  char bytes[4096];
  while (const std::size_t n = std::fread(bytes, 1, sizeof bytes, pipe)) output.append(bytes, n);
  if (::pclose(pipe) != 0) throw std::runtime_error(command + " failed: " + output);
  return output;
}

}  // namespace hooke::samples
