// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The three contacts of a snapshot, worked out by hand, in each format.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "hooke/core/contacts.h"
#include "hooke/io/export.h"
#include "samples.h"
#include "source_dir.h"

namespace hooke {
namespace {

// Two balls touch through a periodic face, and one of them touches a wall.
class ExportContacts : public testing::Test {
 protected:
  ExportContacts() {
    scene_.materials = {{"water", 0.5, 1, {1000, 0, 8}, 0, ""}};
    scene_.domain = {{0, 0, 0}, {10, 10, 10}, {Boundary::periodic, Boundary::spring, Boundary::open}};
    scene_.precision = Precision::double_precision;
    ParticleSet& p = snapshot_.particles;
    p.id = {3, 12};
    p.material = {0, 0};
    p.position = {{0.25, 0.25, 5}, {9.5, 0.5, 5}};
    p.position[1].y = 0.25;
    p.velocity = {{0, 0, 0}, {1, 0, 0}};  // towards each other
    snapshot_.step = 40;
    snapshot_.time = 0.2;
  }

  Expected<std::vector<std::filesystem::path>> exported(const char* name, const Scene* scene) {
    io::ExportOptions options;
    options.content = io::ExportContent::contacts;
    options.scene = scene;
    const io::RunInfo info = io::describe_run(scene_, Precision::double_precision);
    const io::RunReader run = samples::write_run(folder_ / "run", info, {snapshot_});
    return io::export_run(run, std::vector<std::size_t>{0}, folder_ / name, options);
  }

  const samples::TemporaryFolder folder_;
  Scene scene_;
  Snapshot snapshot_;
};

TEST_F(ExportContacts, AsATable) {
  ASSERT_TRUE(exported("c.csv", &scene_));
  // The second ball's image is at -0.5, so the balls overlap by 0.25; the spring gives 250 N and the dashpot 8.
  EXPECT_EQ(samples::read_file(folder_ / "c.csv"),
            "step,t,id_a,id_b,image_x,image_y,image_z,overlap,fx,fy,fz\n"
            "40,0.2,3,12,-1,0,0,0.25,258,0,0\n"
            "40,0.2,3,wall:y-min,0,0,0,0.25,0,250,0\n"
            "40,0.2,12,wall:y-min,0,0,0,0.25,-8,250,0\n");
}

TEST_F(ExportContacts, AsLinesThatVtkReads) {
  const auto files = exported("c.vtp", &scene_);
  ASSERT_TRUE(files) << files.error().text();
  // Both ends, then collider, face, force, id_a, id_b, overlap.
  EXPECT_EQ(samples::output_of(fmt::format("/usr/bin/python3 '{}/tests/io/read_lines.py' '{}'", HOOKE_SOURCE_DIR,
                                           files->front().string())),
            "0.25 0.25 5.0 -0.5 0.25 5.0 -1.0 0.0 258.0 0.0 0.0 3.0 12.0 0.25\n"
            "0.25 0.25 5.0 0.25 0.0 5.0 -1.0 3.0 0.0 250.0 0.0 3.0 -1.0 0.25\n"
            "9.5 0.25 5.0 9.5 0.0 5.0 -1.0 3.0 -8.0 250.0 0.0 12.0 -1.0 0.25\n");
}

// A ball on a plate that has risen by 0.25 m when the snapshot is taken; the plate's name has to be quoted.
TEST_F(ExportContacts, WithCollidersNameThem) {
  Collider plate;
  plate.name = "plate, steel";
  plate.shape = PlaneShape{{0, -0.25, 0}, {0, 1, 0}};
  plate.motion = SteadyMotion{{0, 1.25, 0}, {0, 0, 0}, {}};
  scene_.domain.boundary[1] = Boundary::open;
  scene_.colliders = {plate};
  snapshot_.particles.resize(1);
  ASSERT_TRUE(exported("c.csv", &scene_));
  // The plate is at 0, 0.25 below the centre: the spring gives 250 N, the dashpot 8 * 1.25.
  EXPECT_EQ(samples::read_file(folder_ / "c.csv"),
            "step,t,id_a,id_b,image_x,image_y,image_z,overlap,fx,fy,fz\n"
            "40,0.2,3,\"collider:plate, steel\",0,0,0,0.25,0,260,0\n");
  std::filesystem::remove_all(folder_ / "run");
  const auto files = exported("c.vtp", &scene_);
  ASSERT_TRUE(files) << files.error().text();
  EXPECT_EQ(samples::output_of(fmt::format("/usr/bin/python3 '{}/tests/io/read_lines.py' '{}'", HOOKE_SOURCE_DIR,
                                           files->front().string())),
            "0.25 0.25 5.0 0.25 0.0 5.0 0.0 0.0 0.0 260.0 0.0 3.0 -1.0 0.25\n");
}

TEST_F(ExportContacts, HaveARowForEachThatIsFound) {
  scene_.domain.boundary[0] = Boundary::open;
  snapshot_ = samples::snapshot(8, 400, Precision::double_precision);
  for (std::size_t i = 0; i < snapshot_.particles.size(); ++i) {
    snapshot_.particles.material[i] = 0;
    snapshot_.particles.position[i] = {double(i % 8) * 0.9, double(i / 8 % 8) * 0.95, double(i / 64) * 0.8};
  }
  const auto contacts = find_contacts(scene_, snapshot_.particles);
  ASSERT_GT(contacts.size(), 900U);
  ASSERT_TRUE(exported("c.csv", &scene_));
  std::istringstream in(samples::read_file(folder_ / "c.csv"));
  std::string line;
  std::getline(in, line);
  for (const Contact& c : contacts) {
    ASSERT_TRUE(std::getline(in, line));
    std::replace(line.begin(), line.end(), ',', ' ');
    const auto words = samples::words(line);
    ASSERT_EQ(words.size(), 11U);
    EXPECT_EQ(words[2], std::to_string(snapshot_.particles.id[c.a]));
    EXPECT_EQ(words[3], c.face == Face::none ? std::to_string(snapshot_.particles.id[c.b])
                                             : std::string("wall:") + to_string(c.face));
    EXPECT_EQ(samples::number(words[7]), c.overlap);
    EXPECT_EQ((Vec3d{samples::number(words[8]), samples::number(words[9]), samples::number(words[10])}), c.force);
  }
  EXPECT_FALSE(std::getline(in, line));
}

TEST_F(ExportContacts, NeedTheSceneOfTheRun) {
  const auto without = exported("c.csv", nullptr);
  ASSERT_FALSE(without);
  EXPECT_EQ(without.error().kind, Error::Kind::bad_input);
  EXPECT_NE(without.error().text().find("the run's scene is needed"), std::string::npos);
  std::filesystem::remove_all(folder_ / "run");
  Scene other = scene_;
  other.materials[0].radius = 0.6;
  const auto wrong = exported("c.vtp", &other);
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().kind, Error::Kind::bad_input);
  EXPECT_NE(wrong.error().text().find("other materials"), std::string::npos);
  EXPECT_EQ(samples::files_in(folder_.path()), std::vector<std::string>{"run"});
}

}  // namespace
}  // namespace hooke
