// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// USD as text: one UsdGeomPoints prim with a time sample per snapshot. Lengths are in metres. One time code is one
// snapshot of an evenly spaced run (a frame), so timeCodesPerSecond is the rate of snapshots. Widths are diameters.
// Values that USD stores in single precision (points, velocities) are rounded to it. Up is against the scene's gravity,
// if that is along y or z; colours are the scene's; without a scene up is y, and there are no colours.
//
// USD keeps all samples of an attribute together, so the exporter reads all snapshots once per moving attribute, with
// one snapshot in memory at a time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/material_words.h"
#include "hooke/io/write_rows.h"

namespace hooke::io {

namespace {

constexpr double kDefaultRate = 24;  // time codes a second where one snapshot gives no rate; USD's own default

double rounded_if_near(double value, double nearness) {
  return std::abs(value - std::round(value)) <= nearness ? std::round(value) : value;
}

/// The spacing if all are the same; 0 if not.
double equal_spacing(std::span<const double> times, double nearness) {
  if (times.size() < 2) return 0;
  const double mean = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  for (std::size_t k = 1; k < times.size(); ++k) {
    if (std::abs(times[k] - times[k - 1] - mean) > nearness) return 0;
  }
  return mean;
}

/// A spacing such that each of `times` is the first step, of `time_step`, at or after its multiple: that is how a run
/// writes its output. One that makes a whole number of samples a second, if there is one; 0 if there is none at all.
double stepped_spacing(std::span<const double> times, double time_step) {
  double least = 0, most = INFINITY;
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double count = static_cast<double>(k), length = times[k] - times.front();
    least = std::max(least, (length - time_step) / count);
    most = std::min(most, (length + time_step) / count);
  }
  if (times.size() < 2 || !(least < most)) return 0;
  const double mean = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const double whole = 1 / std::max(std::round(1 / mean), 1.0);
  return least < whole && whole < most ? whole : std::clamp(mean, least, most);
}

/// Snapshots per second at the median spacing.
double median_rate(const std::vector<double>& times) {
  if (times.size() < 2) return kDefaultRate;
  std::vector<double> spacing;
  for (std::size_t k = 1; k < times.size(); ++k) spacing.push_back(times[k] - times[k - 1]);
  const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
  std::nth_element(spacing.begin(), middle, spacing.end());
  return *middle > 0 ? rounded_if_near(1 / *middle, 1e-6 / *middle) : kDefaultRate;
}

struct TimeCodes {
  double rate = kDefaultRate;  // codes a second
  std::vector<double> codes;  // of each sample
};

/// Codes of which the first `even` are whole numbers apart, the first a whole number if its time is so near to one; the
/// others follow their times.
TimeCodes time_codes(const std::vector<double>& times, double rate, std::size_t even, double nearness) {
  TimeCodes result{rate, {}};
  const double first = rounded_if_near(times.front() * rate, nearness);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double code = rounded_if_near(times[k] * rate, 1e-6);
    result.codes.push_back(k < even ? first + static_cast<double>(k) : code);
  }
  return result;
}

/// One code a sample where the samples are evenly spaced, or are the steps next to evenly spaced times. The last one
/// may be apart: a run writes its end too. Otherwise codes are times at the rate of the median spacing.
TimeCodes time_codes(const std::vector<double>& times, double time_step) {
  constexpr double kNear = 1e-6;
  const std::size_t n = times.size();
  for (const bool stepped : {false, true}) {
    for (std::size_t even = n; even >= std::max<std::size_t>(n - 1, 2); --even) {
      const std::span<const double> samples{times.data(), even};
      const double spacing = stepped ? stepped_spacing(samples, time_step) : equal_spacing(samples, kNear * time_step);
      if (!(spacing > 0)) continue;
      const double rate = rounded_if_near(1 / spacing, kNear / spacing);
      return time_codes(times, rate, even, stepped ? time_step * rate : kNear);
    }
  }
  return time_codes(times, median_rate(times), 0, kNear);
}

std::string digits(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string usd_string(std::string_view text) {
  std::string literal = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      literal += {'\\', c};
    } else if (static_cast<unsigned char>(c) < ' ') {
      literal += fmt::format("\\x{:02x}", c);
    } else {
      literal += c;
    }
  }
  return literal + '"';
}

const char* up_axis(const Scene* scene) {
  return scene && std::abs(scene->gravity.z) > std::abs(scene->gravity.y) ? "Z" : "Y";
}

/// Converts sRGB, as in "#rrggbb", to linear light, as in USD's colours.
float linear_light(std::uint8_t byte) {
  const double c = byte / 255.0;
  return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

/// "[(-1, -2, -3), (1, 2, 3)]": a box around all spheres.
std::string extent(const ParticleSet& p, const std::vector<MaterialInfo>& materials) {
  Vec3d min{0, 0, 0}, max{0, 0, 0};
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double radius = materials[p.material[i]].radius;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = component(p.position[i], axis);
      double& low = component(min, axis);
      double& high = component(max, axis);
      low = i == 0 ? x - radius : std::min(low, x - radius);
      high = i == 0 ? x + radius : std::max(high, x + radius);
    }
  }
  std::string text = "[(";
  append_vector<float>(text, min, ", ");
  text += "), (";
  append_vector<float>(text, max, ", ");
  return text + ")]";
}

/// One export into one file.
class UsdaWriter {
 public:
  explicit UsdaWriter(const ExportJob& job) : job_(job), info_(job.run.info()), out_(job.file) {
    std::vector<double> times;
    for (const std::size_t index : job.indices) times.push_back(job.run.times()[index]);
    const TimeCodes time = time_codes(times, info_.time_step);
    rate_ = time.rate;
    for (const double code : time.codes) codes_.push_back(digits(code));
  }

  void write() {
    write_head();
    write_points();
    write_velocities();
    write_materials();
    out_.write("}\n");
    out_.finish();
  }

 private:
  void write_head() {
    out_.write(
        fmt::format("#usda 1.0\n"
                    "(\n"
                    "    defaultPrim = \"particles\"\n"
                    "    endTimeCode = {}\n"
                    "    framesPerSecond = {}\n"
                    "    metersPerUnit = 1\n"
                    "    startTimeCode = {}\n"
                    "    timeCodesPerSecond = {}\n"
                    "    upAxis = \"{}\"\n"
                    ")\n\n"
                    "def Points \"particles\"\n"
                    "{{\n",
                    codes_.back(), digits(rate_), codes_.front(), digits(rate_), up_axis(job_.options.scene)));
    std::string names;
    for (const MaterialInfo& m : info_.materials) names += (names.empty() ? "" : ", ") + usd_string(m.name);
    out_.write(fmt::format("    custom uniform string[] materialNames = [{}]\n", names));
  }

  /// Writes points, and notes each snapshot's extent and whether its particles differ from those before.
  void write_points() {
    std::string extents;
    ParticleSet before;
    out_.write("    point3f[] points.timeSamples = {\n");
    for (std::size_t k = 0; k < codes_.size(); ++k) {
      ParticleSet p = read(k);
      extents += fmt::format("        {}: {},\n", codes_[k], extent(p, info_.materials));
      write_vectors(k, p.position);
      others_.push_back(k == 0 || p.id != before.id || p.material != before.material);
      before = std::move(p);
    }
    out_.write("    }\n    float3[] extent.timeSamples = {\n" + extents + "    }\n");
  }

  void write_velocities() {
    out_.write("    vector3f[] velocities.timeSamples = {\n");
    for (std::size_t k = 0; k < codes_.size(); ++k) write_vectors(k, read(k).velocity);
    out_.write("    }\n");
  }

  /// Writes the attributes that stay with a particle.
  void write_materials() {
    std::vector<std::string> indices, widths, colors;
    for (std::size_t m = 0; m < info_.materials.size(); ++m) {
      indices.push_back(std::to_string(m));
      append_number(widths.emplace_back(), static_cast<float>(2 * info_.materials[m].radius));
      if (!job_.options.scene) continue;
      const auto [red, green, blue] = rgb_bytes(job_.options.scene->materials[m].color);
      std::string& text = colors.emplace_back("(");
      append_vector<float>(text, {linear_light(red), linear_light(green), linear_light(blue)}, ", ");
      text += ')';
    }
    write_lasting("int64[] ids", "",
                  [](const ParticleSet& p, std::string& text, std::size_t i) { append_number(text, p.id[i]); });
    const auto by_material = [](const std::vector<std::string>& texts) {
      return [&texts](const ParticleSet& p, std::string& text, std::size_t i) { text += texts[p.material[i]]; };
    };
    constexpr const char* kOneEach = " (\n        interpolation = \"vertex\"\n    )";
    write_lasting("float[] widths", kOneEach, by_material(widths));
    write_lasting("int[] primvars:material", kOneEach, by_material(indices));
    if (job_.options.scene) write_lasting("color3f[] primvars:displayColor", kOneEach, by_material(colors));
  }

  /// Writes an attribute that changes only with the set of particles: one value, or samples on both sides of each
  /// change, so that nothing is interpolated in between.
  template <class Append>
  void write_lasting(const std::string& attribute, const std::string& metadata, const Append& append) {
    const auto write_value = [&](std::size_t k) {
      const ParticleSet p = read(k);
      out_.write("[");
      write_rows(out_, p.size(), [&](std::string& text, std::size_t i) {
        if (i > 0) text += ", ";
        append(p, text, i);
      });
      out_.write("]");
    };
    out_.write("    " + attribute);
    if (std::count(others_.begin(), others_.end(), true) == 1) {
      out_.write(" = ");
      write_value(0);
      out_.write(metadata + '\n');
      return;
    }
    if (!metadata.empty()) out_.write(metadata + "\n    " + attribute);
    out_.write(".timeSamples = {\n");
    for (std::size_t k = 0; k < codes_.size(); ++k) {
      if (!others_[k] && !(k + 1 < codes_.size() && others_[k + 1])) continue;
      out_.write("        " + codes_[k] + ": ");
      write_value(k);
      out_.write(",\n");
    }
    out_.write("    }\n");
  }

  void write_vectors(std::size_t k, const std::vector<Vec3d>& vectors) {
    out_.write("        " + codes_[k] + ": [");
    write_rows(out_, vectors.size(), [&](std::string& text, std::size_t i) {
      text += i > 0 ? ", (" : "(";
      append_vector<float>(text, vectors[i], ", ");
      text += ')';
    });
    out_.write("],\n");
  }

  ParticleSet read(std::size_t k) const { return take(job_.run.read(job_.indices[k])).particles; }

  const ExportJob& job_;
  const RunInfo& info_;
  OutputFile out_;
  double rate_ = kDefaultRate;
  std::vector<std::string> codes_;  ///< time code of each sample
  std::vector<bool> others_;  ///< whether a sample's particles differ from those before
};

}  // namespace

std::vector<std::filesystem::path> export_usda(const ExportJob& job) {
  UsdaWriter(job).write();
  return {job.file};
}

}  // namespace hooke::io
