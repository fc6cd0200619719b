// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Reads USDA back by the grammar of its text: attributes of one prim, with a value or with time samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "samples.h"

namespace hooke {
namespace {

using Numbers = std::vector<double>;

struct Attribute {
  std::string type;
  std::string interpolation;
  std::string value;                      ///< as it is written, without time samples
  std::map<std::string, Numbers> samples;  ///< by time code
};

struct Stage {
  std::map<std::string, std::string> metadata;
  std::map<std::string, Attribute> attributes;
};

/// All numbers of an array; brackets are ignored.
Numbers numbers_in(const std::string& text) {
  Numbers numbers;
  for (std::size_t at = 0; (at = text.find_first_of("-0123456789", at)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_not_of("-+.0123456789e", at), text.size());
    numbers.push_back(samples::number(text.substr(at, end - at)));
    at = end;
  }
  return numbers;
}

/// `text` without the spaces around it.
std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \n") + 1 - begin);
}

Stage read_stage(const std::filesystem::path& file) {
  const std::string text = samples::read_file(file);
  EXPECT_TRUE(text.starts_with("#usda 1.0\n(\n"));
  Stage stage;
  std::size_t at = text.find('(');
  const auto line = [&] {
    const std::size_t begin = text.find('\n', at) + 1;
    at = std::min(text.find('\n', begin), text.size());
    return trimmed(text.substr(begin, at - begin));
  };
  const auto split = [](const std::string& entry, const std::string& by) {
    const std::size_t middle = entry.find(by);
    EXPECT_NE(middle, std::string::npos) << entry.substr(0, 200);
    return std::pair(trimmed(entry.substr(0, middle)), trimmed(entry.substr(middle + by.size())));
  };
  for (std::string entry = line(); entry != ")"; entry = line()) stage.metadata.insert(split(entry, "="));
  EXPECT_EQ(line(), "");
  EXPECT_EQ(line(), "def Points \"particles\"");
  EXPECT_EQ(line(), "{");
  for (std::string entry = line(); entry != "}"; entry = line()) {
    const bool has_metadata = entry.ends_with(" (");
    if (has_metadata) entry.resize(entry.size() - 2);
    std::string value;
    if (entry.find(" = ") != std::string::npos) std::tie(entry, value) = split(entry, " = ");
    const bool has_samples = entry.ends_with(".timeSamples");
    if (has_samples) entry.resize(entry.size() - 12);
    const std::size_t space = entry.rfind(' ');
    Attribute& attribute = stage.attributes[entry.substr(space + 1)];
    attribute.type = entry.substr(0, space);
    if (has_samples) {
      EXPECT_EQ(value, "{");
      for (std::string sample = line(); sample != "}"; sample = line()) {
        EXPECT_TRUE(sample.ends_with("],"));
        const auto [code, array] = split(sample, ": ");
        attribute.samples[code] = numbers_in(array);
      }
    } else {
      attribute.value = value;
    }
    if (has_metadata) {
      attribute.interpolation = split(line(), "=").second;
      EXPECT_EQ(line(), ")");
    }
  }
  return stage;
}

/// As USD keeps it: in single precision.
Numbers flat(const std::vector<Vec3d>& vectors) {
  Numbers numbers;
  for (const Vec3d& v : vectors) {
    for (const double c : {v.x, v.y, v.z}) numbers.push_back(static_cast<double>(static_cast<float>(c)));
  }
  return numbers;
}

Numbers rounded(Numbers numbers) {
  for (double& x : numbers) x = static_cast<double>(static_cast<float>(x));
  return numbers;
}

class ExportUsda : public testing::Test {
 protected:
  Stage exported(const io::RunInfo& info, const std::vector<Snapshot>& snapshots, const Scene* scene) {
    const io::RunReader run = samples::write_run(folder_ / to_string(info.precision), info, snapshots);
    EXPECT_EQ(samples::export_all(run, folder_ / "p.usda", scene).size(), 1U);
    return read_stage(folder_ / "p.usda");
  }

  const samples::TemporaryFolder folder_;
};

TEST_F(ExportUsda, HasASampleASnapshot) {
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    io::RunInfo info = samples::run_info(precision);
    info.materials[0].name = "salt \"sea\"\\\n\u00e4";
    std::vector<Snapshot> snapshots;
    for (const std::int64_t step : {0, 8, 16, 24}) snapshots.push_back(samples::snapshot(step, 3000, precision));
    const Scene scene = samples::scene(info);
    Stage stage = exported(info, snapshots, &scene);

    EXPECT_EQ(stage.metadata, (std::map<std::string, std::string>{{"defaultPrim", "\"particles\""},
                                                                  {"startTimeCode", "0"},
                                                                  {"endTimeCode", "3"},
                                                                  {"framesPerSecond", "25"},
                                                                  {"timeCodesPerSecond", "25"},
                                                                  {"metersPerUnit", "1"},
                                                                  {"upAxis", "\"Z\""}}));
    auto& attributes = stage.attributes;
    EXPECT_EQ(attributes["materialNames"].value, "[\"salt \\\"sea\\\"\\\\\\x0a\u00e4\", \"oil\"]");
    EXPECT_EQ(attributes["points"].type, "point3f[]");
    EXPECT_EQ(attributes["velocities"].type, "vector3f[]");
    EXPECT_EQ(attributes["extent"].type, "float3[]");
    EXPECT_EQ(attributes["ids"].type, "int64[]");
    EXPECT_EQ(attributes["widths"].type, "float[]");
    EXPECT_EQ(attributes["primvars:material"].type, "int[]");
    EXPECT_EQ(attributes["primvars:displayColor"].type, "color3f[]");
    for (std::size_t k = 0; k < snapshots.size(); ++k) {
      const ParticleSet& p = snapshots[k].particles;
      const std::string code = std::to_string(k);
      EXPECT_EQ(rounded(attributes["points"].samples[code]), flat(p.position));
      EXPECT_EQ(rounded(attributes["velocities"].samples[code]), flat(p.velocity));
      const Numbers& extent = attributes["extent"].samples[code];
      ASSERT_EQ(extent.size(), 6U);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double min = 1e9, max = -1e9;
        for (std::size_t i = 0; i < p.size(); ++i) {
          const double x = component(p.position[i], static_cast<int>(axis));
          const double radius = info.materials[p.material[i]].radius;
          min = std::min(min, x - radius);
          max = std::max(max, x + radius);
        }
        EXPECT_NEAR(extent[axis], min, 1e-5);
        EXPECT_NEAR(extent[3 + axis], max, 1e-5);
      }
    }
    // The particles never change, so ids and the like are written once.
    Numbers ids, widths, materials, colors;
    const ParticleSet& p = snapshots[0].particles;
    for (std::size_t i = 0; i < p.size(); ++i) {
      ids.push_back(static_cast<double>(p.id[i]));
      widths.push_back(p.material[i] == 0 ? 0.4 : 0.7);
      materials.push_back(p.material[i]);
      // #2f7fd6 and #ff0080 as linear light.
      const Numbers color = p.material[i] == 0 ? Numbers{0.028426, 0.212231, 0.672443} : Numbers{1, 0, 0.215861};
      colors.insert(colors.end(), color.begin(), color.end());
    }
    EXPECT_EQ(numbers_in(attributes["ids"].value), ids);
    EXPECT_EQ(numbers_in(attributes["widths"].value), widths);
    EXPECT_EQ(numbers_in(attributes["primvars:material"].value), materials);
    const Numbers written = numbers_in(attributes["primvars:displayColor"].value);
    ASSERT_EQ(written.size(), colors.size());
    for (std::size_t i = 0; i < colors.size(); ++i) ASSERT_NEAR(written[i], colors[i], 1e-6);
    for (const char* name : {"widths", "primvars:material", "primvars:displayColor"}) {
      EXPECT_EQ(attributes[name].interpolation, "\"vertex\"");
    }
  }
}

// Readers interpolate between samples: both sides of a change are written.
TEST_F(ExportUsda, SaysWhenTheParticlesBecomeOthers) {
  std::vector<Snapshot> snapshots;
  for (const std::int64_t step : {0, 8, 16, 24, 32, 40}) snapshots.push_back(samples::snapshot(step, 5));
  snapshots[4] = samples::snapshot(32, 3);
  snapshots[5] = samples::snapshot(40, 0);
  Stage stage = exported(samples::run_info(), snapshots, nullptr);
  auto& ids = stage.attributes["ids"];
  EXPECT_EQ(ids.value, "");
  EXPECT_EQ(ids.samples, (std::map<std::string, Numbers>{
                             {"0", {1, 4, 7, 10, 13}}, {"3", {1, 4, 7, 10, 13}}, {"4", {1, 4, 7}}, {"5", {}}}));
  auto& widths = stage.attributes["widths"];
  EXPECT_EQ(widths.interpolation, "\"vertex\"");
  EXPECT_EQ(widths.samples["3"], (Numbers{0.7, 0.4, 0.4, 0.7, 0.4}));
  EXPECT_EQ(widths.samples["4"], (Numbers{0.7, 0.4, 0.4}));
  EXPECT_EQ(stage.attributes["points"].samples.size(), 6U);
  EXPECT_EQ(stage.attributes["points"].samples["5"], Numbers{});
  EXPECT_EQ(stage.attributes["extent"].samples["5"], Numbers(6, 0));
  EXPECT_FALSE(stage.attributes.contains("primvars:displayColor"));
  EXPECT_EQ(stage.metadata["upAxis"], "\"Y\"");
}

TEST_F(ExportUsda, KeepsTimesOfUnevenSnapshots) {
  std::vector<Snapshot> snapshots;
  for (const std::int64_t step : {0, 8, 16, 24, 27}) snapshots.push_back(samples::snapshot(step, 2));
  Stage stage = exported(samples::run_info(), snapshots, nullptr);
  EXPECT_EQ(stage.metadata["timeCodesPerSecond"], "25");
  EXPECT_EQ(stage.metadata["endTimeCode"], "3.375");
  EXPECT_TRUE(stage.attributes["velocities"].samples.contains("3.375"));
}

// Frames of a film: no multiple of 1/24 s but those of whole seconds is a step.
TEST_F(ExportUsda, HasWholeCodesWhereOutputFallsOnTheNextStep) {
  io::RunInfo info = samples::run_info();
  info.time_step = 0.001;
  const OutputCadence cadence{1.0 / 24, 0};
  std::vector<Snapshot> snapshots;
  for (std::int64_t step = 0; step <= 2000; ++step) {
    if (!cadence.is_due(step, info.time_step)) continue;
    snapshots.push_back(samples::snapshot(step, 1));
    snapshots.back().time = static_cast<double>(step) * info.time_step;
  }
  ASSERT_EQ(snapshots.size(), 49U);
  const auto expect_codes = [&](int first, int last) {
    std::filesystem::remove_all(folder_ / to_string(info.precision));
    const Stage stage = exported(info, {snapshots.begin() + first, snapshots.begin() + last + 1}, nullptr);
    EXPECT_EQ(stage.metadata.at("timeCodesPerSecond"), "24");
    for (int code = first; code <= last; ++code) {
      EXPECT_TRUE(stage.attributes.at("points").samples.contains(std::to_string(code))) << code;
    }
  };
  expect_codes(0, 48);
  expect_codes(7, 30);
  // The end of the run is between two frames.
  snapshots.push_back(samples::snapshot(2010, 1));
  snapshots.back().time = 2.01;
  std::filesystem::remove_all(folder_ / to_string(info.precision));
  const Stage stage = exported(info, snapshots, nullptr);
  EXPECT_EQ(stage.metadata.at("timeCodesPerSecond"), "24");
  EXPECT_NEAR(samples::number(stage.metadata.at("endTimeCode")), 48.24, 1e-9);
}

TEST_F(ExportUsda, PutsASingleSnapshotAtItsTime) {
  Stage stage = exported(samples::run_info(), {samples::snapshot(300, 2)}, nullptr);
  EXPECT_EQ(stage.metadata["timeCodesPerSecond"], "24");
  EXPECT_EQ(stage.metadata["startTimeCode"], "36");
  EXPECT_EQ(rounded(stage.attributes["points"].samples["36"]), flat(samples::snapshot(300, 2).particles.position));
}

}  // namespace
}  // namespace hooke
