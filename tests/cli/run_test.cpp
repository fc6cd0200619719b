// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "program.h"

namespace hooke::test {
namespace {

using testing::HasSubstr;

class RunCommand : public ProgramTest {
 protected:
  void SetUp() override { write("s.json", small_scene()); }
};

TEST_F(RunCommand, LeavesAFolderThatCanBeRead) {
  EXPECT_THAT(hooke_ok({"run", "s.json"}), HasSubstr("216 particles, 60 steps"));
  for (const char* file : {"scene.json", "particles.vtkhdf", "series.csv", "checkpoint.h5", "log.txt", "report.json"}) {
    EXPECT_TRUE(exists(std::string("s/") + file)) << file;
  }
  const std::string info = hooke_ok({"info", "s"});
  EXPECT_THAT(info, HasSubstr("snapshots   10"));  // 0, 7, .. 56, and the end
  EXPECT_THAT(info, HasSubstr("checkpoint  step 60"));
  EXPECT_THAT(hooke_ok({"info", "s/checkpoint.h5"}), HasSubstr("step 60"));

  const std::string all = export_all("s");
  EXPECT_EQ(all.substr(0, all.find('\n')), "step,t,id,material,x,y,z,vx,vy,vz");
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 1 + 10 * 216);
  hooke_ok({"export", "s", "-o", "last.csv"});
  hooke_ok({"export", "s", "--step", "60", "-o", "step.csv"});
  hooke_ok({"export", "s", "--time", "0.31", "-o", "time.csv"});
  EXPECT_EQ(read("last.csv"), read("step.csv"));
  EXPECT_EQ(read("last.csv"), read("time.csv"));
  EXPECT_THAT(all, HasSubstr(read("last.csv").substr(35)));

  const Outcome missing = hooke({"export", "s", "--step", "8", "-o", "x.csv"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("the nearest is 7"));
  EXPECT_EQ(hooke({"export", "s", "-o", "x.unknown"}).status, 2);
  EXPECT_FALSE(exists("x.unknown"));
}

TEST_F(RunCommand, ReportHoldsTheFields) {
  hooke_ok({"run", "s.json", "--report", "r.json", "--quiet"});
  const auto report = nlohmann::json::parse(read("r.json"));
  EXPECT_EQ(report.at("particles"), 216);
  EXPECT_EQ(report.at("steps"), 60);
  EXPECT_EQ(report.at("state_hash").get<std::string>().size(), 16U);
  EXPECT_EQ(report.at("state_hash"), state_hash("s"));
}

// No time of day is in them.
TEST_F(RunCommand, EqualRunsWriteEqualFiles) {
  hooke_ok({"run", "s.json", "-o", "a"});
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  hooke_ok({"run", "s.json", "-o", "b"});
  for (const std::string file : {"scene.json", "particles.vtkhdf", "series.csv", "checkpoint.h5"})
    EXPECT_TRUE(read("a/" + file) == read("b/" + file)) << file;
}

TEST_F(RunCommand, EndAndStepsSayWhenToStop) {
  hooke_ok({"run", "s.json", "--steps", "20", "-o", "steps"});
  hooke_ok({"run", "s.json", "--end", "0.1", "-o", "end"});
  EXPECT_EQ(state_hash("steps"), state_hash("end"));
  hooke_ok({"run", "s.json", "--steps", "0", "-o", "none"});
  EXPECT_THAT(hooke_ok({"info", "none"}), HasSubstr("snapshots   1"));
}

TEST_F(RunCommand, QuietPrintsNothing) {
  const Outcome outcome = hooke({"run", "s.json", "--quiet"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(RunCommand, RefusesAFolderThatHoldsARun) {
  hooke_ok({"run", "s.json", "-o", "out", "--steps", "10"});
  const std::string before = state_hash("out");
  const Outcome refused = hooke({"run", "s.json", "-o", "out", "--steps", "20"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("--overwrite"));
  EXPECT_EQ(state_hash("out"), before);
  write("out/notes.txt", "mine");
  hooke_ok({"run", "s.json", "-o", "out", "--steps", "20", "--overwrite"});
  EXPECT_NE(state_hash("out"), before);
  EXPECT_EQ(read("out/notes.txt"), "mine");
}

TEST_F(RunCommand, ARunGoneBadIsStatus3AndKeepsItsCheckpoint) {
  // Stable while the cube falls; a stiff floor throws it apart when it lands.
  const Outcome bad = hooke({"run", "s.json", "--set", "materials.water.stiffness=1e7", "--set",
                             "particles[0].velocity=[0,-3,0]", "--checkpoint-every", "0.01", "--steps", "2000"});
  EXPECT_EQ(bad.status, 3) << bad.err;
  EXPECT_THAT(bad.err, HasSubstr("step "));
  EXPECT_THAT(bad.err, HasSubstr("stable step"));
  EXPECT_THAT(bad.err, HasSubstr("last good checkpoint"));
  EXPECT_THAT(read("s/log.txt"), HasSubstr("stable step"));
  EXPECT_THAT(hooke_ok({"info", "s"}), HasSubstr("checkpoint"));
  EXPECT_THAT(export_all("s"), testing::Not(HasSubstr("nan")));
}

TEST_F(RunCommand, AFullDiskIsStatus3AndWhatWasWrittenStaysReadable) {
  const Outcome full = hooke({"run", "s.json", "--steps", "5000", "--set", "output.every_steps=1"}, 400'000);
  EXPECT_EQ(full.status, 3) << full.err;
  EXPECT_NE(full.err, "");
  EXPECT_THAT(hooke_ok({"info", "s"}), HasSubstr("snapshots"));
  EXPECT_THAT(export_all("s"), HasSubstr("step,t,id"));
}

TEST_F(RunCommand, AFolderHasOneWriter) {
  Program first = start({"run", "s.json", "-o", "out", "--steps", "100000000", "--quiet"});
  ASSERT_TRUE(wait_until([&] { return exists("out/checkpoint.h5"); }));
  const std::vector<std::vector<std::string>> ways{{"--overwrite"},
                                                   {"--resume", "out/checkpoint.h5", "--steps", "100000000"}};
  for (const std::vector<std::string>& more : ways) {
    std::vector<std::string> arguments{"run", "s.json", "-o", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome second = hooke(arguments);
    EXPECT_EQ(second.status, 2) << second.err;
    EXPECT_THAT(second.err, HasSubstr("out: is being written by process "));
  }
  EXPECT_THAT(hooke_ok({"info", "out"}), HasSubstr("snapshots"));
  first.send(SIGINT);
  EXPECT_EQ(first.wait().status, 130);
  EXPECT_FALSE(exists("out/.hooke.lock"));
}

TEST_F(RunCommand, ReportsGoToPipesAndLinks) {
  const Outcome outcome = hooke({"run", "s.json", "--report", "/dev/stdout", "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, read("s/report.json"));
  write("target", "old");
  std::filesystem::create_symlink("target", path("link"));
  hooke_ok({"run", "s.json", "--report", "link", "--overwrite"});
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(read("target"), read("s/report.json"));
}

TEST_F(RunCommand, ReferenceBackEndAgreesInDouble) {
  hooke_ok({"run", "s.json", "--set", "precision=double", "-o", "fast"});
  hooke_ok({"run", "s.json", "--set", "precision=double", "-o", "slow", "--device", "reference"});
  EXPECT_EQ(state_hash("fast"), state_hash("slow"));
  EXPECT_EQ(export_all("fast"), export_all("slow"));
}

TEST_F(RunCommand, NoParticlesAtAll) {
  hooke_ok({"run", "s.json", "--set", "particles=[]", "--steps", "20"});
  EXPECT_EQ(export_all("s"), "step,t,id,material,x,y,z,vx,vy,vz\n");
}

}  // namespace
}  // namespace hooke::test
