// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// LAMMPS itself reads its formats back: read_data and read_dump, then write_dump with all digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "samples.h"

namespace hooke {
namespace {

/// LAMMPS's state after it has read a file.
struct Lammps {
  std::vector<std::string> box_bounds;  ///< the line's words after "ITEM: BOX BOUNDS", then min and max of each axis
  std::vector<std::vector<std::string>> rows;  ///< id type radius mass x y z vx vy vz
};

class ExportLammps : public testing::TestWithParam<Precision> {
 protected:
  ExportLammps() { info_.materials[0].name = "salt \"sea\"\n#1 \u00e4%" + std::string(100, '!'); }

  /// Writes all snapshots, and returns the files.
  std::vector<std::filesystem::path> exported(const std::string& name, const Scene* scene) {
    return samples::export_all(samples::write_run(folder_ / "run", info_, snapshots_), folder_ / name, scene);
  }

  /// LAMMPS's particles after `commands`.
  Lammps run_lammps(const std::string& boundary, const std::string& commands) {
    samples::write_file(folder_ / "in.lammps",
                        "units si\natom_style sphere\nboundary " + boundary + "\n" + commands +
                            "\nwrite_dump all custom out.dump id type radius mass x y z vx vy vz "
                            "modify sort id format float %.17g\n");
    // Open MPI makes a folder for each of its processes below one of the user's, which two that begin at the same
    // moment can't both make.
    samples::output_of(fmt::format("cd '{0}' && OMPI_MCA_orte_tmpdir_base='{0}' lmp -in in.lammps -log none",
                                   folder_.path().string()));
    std::istringstream in(samples::read_file(folder_ / "out.dump"));
    Lammps lammps;
    std::string line;
    while (std::getline(in, line) && !line.starts_with("ITEM: ATOMS")) {
      if (!line.starts_with("ITEM: BOX BOUNDS ")) continue;
      lammps.box_bounds = samples::words(line.substr(17));
      for (int axis = 0; axis < 3 && std::getline(in, line); ++axis) {
        for (const std::string& bound : samples::words(line)) lammps.box_bounds.push_back(bound);
      }
    }
    while (std::getline(in, line)) lammps.rows.push_back(samples::words(line));
    return lammps;
  }

  void expect_particles(const Lammps& lammps, const ParticleSet& p, bool with_sizes) {
    ASSERT_EQ(lammps.rows.size(), p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto& row = lammps.rows[i];
      // LAMMPS reads doubles; the shortest digits give the run's numbers in the run's own type.
      const auto number = [&](std::size_t column) {
        const double x = samples::number(row[column]);
        return GetParam() == Precision::single_precision ? static_cast<double>(static_cast<float>(x)) : x;
      };
      ASSERT_EQ(row[0], std::to_string(p.id[i]));
      ASSERT_EQ(row[1], std::to_string(p.material[i] + 1));
      ASSERT_EQ((Vec3d{number(4), number(5), number(6)}), p.position[i]);
      ASSERT_EQ((Vec3d{number(7), number(8), number(9)}), p.velocity[i]);
      if (!with_sizes) continue;
      const io::MaterialInfo& material = info_.materials[p.material[i]];
      ASSERT_EQ(samples::number(row[2]), material.radius);
      ASSERT_NEAR(samples::number(row[3]), material.mass, 1e-15);
    }
  }

  const samples::TemporaryFolder folder_;
  io::RunInfo info_ = samples::run_info(GetParam());
  std::vector<Snapshot> snapshots_{samples::snapshot(0, 3000, GetParam()), samples::snapshot(8, 0, GetParam()),
                                   samples::snapshot(16, 2000, GetParam())};
};

TEST_P(ExportLammps, ReadsDataFilesBack) {
  const Scene scene = samples::scene(info_);
  const auto files = exported("w.data", &scene);
  ASSERT_EQ(files.size(), 3U);
  for (std::size_t k = 0; k < files.size(); ++k) {
    const Lammps lammps = run_lammps("f p f", "read_data " + files[k].filename().string());
    expect_particles(lammps, snapshots_[k].particles, true);
    EXPECT_EQ(samples::number(lammps.box_bounds.at(3)), -110);
    EXPECT_EQ(samples::number(lammps.box_bounds.at(8)), 105.5);
  }
  const std::string text = samples::read_file(files[0]);
  EXPECT_NE(text.find("\n# type 1 salt%20%22sea%22%0A%231%20%C3%A4%25!!!"), std::string::npos);
  EXPECT_NE(text.find("\n# type 2 oil\n"), std::string::npos);
}

TEST_P(ExportLammps, ReadsDumpsBack) {
  const Scene scene = samples::scene(info_);
  const auto files = exported("w.dump", &scene);
  ASSERT_EQ(files.size(), 1U);
  for (const Snapshot& snapshot : snapshots_) {
    const Lammps lammps =
        run_lammps("f p f", fmt::format("region box block 0 1 0 1 0 1\ncreate_box 2 box\n"
                                        "read_dump w.dump {} x y z vx vy vz box yes add keep replace no purge yes",
                                        snapshot.step));
    expect_particles(lammps, snapshot.particles, false);
    EXPECT_EQ(std::vector(lammps.box_bounds.begin(), lammps.box_bounds.begin() + 3),
              (std::vector<std::string>{"ff", "pp", "ff"}));
    EXPECT_EQ(samples::number(lammps.box_bounds.at(6)), 100);
    EXPECT_EQ(samples::number(lammps.box_bounds.at(7)), -120);
  }
}

TEST_P(ExportLammps, DumpSaysWhatLammpsCanNotTakeFromIt) {
  const auto files = exported("w.lammpstrj", nullptr);
  std::istringstream in(samples::read_file(files.at(0)));
  std::string line;
  const auto next = [&] { return std::getline(in, line) ? line : "the end"; };
  EXPECT_EQ(next(), "ITEM: UNITS");
  EXPECT_EQ(next(), "si");
  for (const Snapshot& snapshot : snapshots_) {
    EXPECT_EQ(next(), "ITEM: TIME");
    EXPECT_EQ(samples::number(next()), snapshot.time);
    EXPECT_EQ(next(), "ITEM: TIMESTEP");
    EXPECT_EQ(next(), std::to_string(snapshot.step));
    EXPECT_EQ(next(), "ITEM: NUMBER OF ATOMS");
    EXPECT_EQ(next(), std::to_string(snapshot.particles.size()));
    EXPECT_EQ(next(), "ITEM: BOX BOUNDS ss ss ss");
    for (int axis = 0; axis < 3; ++axis) {
      const auto bounds = samples::words(next());
      for (std::size_t i = 0; i < snapshot.particles.size(); ++i) {
        const double radius = info_.materials[snapshot.particles.material[i]].radius;
        const double x = component(snapshot.particles.position[i], axis);
        ASSERT_LE(samples::number(bounds.at(0)), x - radius);
        ASSERT_GE(samples::number(bounds.at(1)), x + radius);
      }
    }
    EXPECT_EQ(next(), "ITEM: ATOMS id type element radius mass x y z vx vy vz");
    for (std::size_t i = 0; i < snapshot.particles.size(); ++i) {
      const auto row = samples::words(next());
      ASSERT_EQ(row.size(), 11U);
      const io::MaterialInfo& material = info_.materials[snapshot.particles.material[i]];
      ASSERT_EQ(row[2].substr(0, 4), material.name.substr(0, 4));
      ASSERT_EQ(samples::number(row[3]), material.radius);
      ASSERT_EQ(samples::number(row[4]), material.mass);
    }
  }
  EXPECT_EQ(next(), "the end");
}

TEST_P(ExportLammps, LosesNoParticleBeyondAWall) {
  Scene scene = samples::scene(info_);
  scene.domain.min = {-50, -100, -50};
  scene.domain.max = snapshots_[0].particles.position[5];  // a particle exactly on a face
  scene.domain.max.y = 100;
  const auto files = exported("w.lmp", &scene);
  expect_particles(run_lammps("f p f", "read_data " + files[0].filename().string()), snapshots_[0].particles, true);
}

INSTANTIATE_TEST_SUITE_P(Both, ExportLammps, testing::Values(Precision::single_precision, Precision::double_precision),
                         [](const auto& p) { return to_string(p.param); });

}  // namespace
}  // namespace hooke
