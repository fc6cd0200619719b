// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <cstdlib>

#include "program.h"

namespace hooke::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Usage : public ProgramTest {
 protected:
  // Expects bad input: status 2, all of the texts on stderr, also under --quiet, and no folder.
  void expect_refused(std::vector<std::string> arguments, const std::vector<std::string>& texts) {
    arguments.insert(arguments.begin(), {"run", "--quiet", "-o", "out"});
    const Outcome outcome = hooke(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    for (const std::string& text : texts) EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(exists("out"));
  }
};

TEST_F(Usage, WithoutArgumentsPrintsHelpAndFails) {
  const Outcome outcome = hooke({});
  EXPECT_EQ(outcome.status, 2);
  for (const char* command : {"run", "check", "bench", "export", "info", "scenes", "schema", "view"}) {
    EXPECT_THAT(outcome.out, HasSubstr(command));
  }
}

TEST_F(Usage, HelpAndVersionSucceed) {
  EXPECT_THAT(hooke_ok({"--version"}), HasSubstr("hooke 0."));
  EXPECT_THAT(hooke_ok({"run", "--help"}), HasSubstr("--checkpoint-every"));
}

TEST_F(Usage, HelpIsACommandToo) {
  EXPECT_EQ(hooke_ok({"help"}), hooke_ok({"--help"}));
  for (const char* command : {"run", "check", "bench", "render", "export", "info", "scenes", "schema", "help"}) {
    EXPECT_EQ(hooke_ok({"help", command}), hooke_ok({command, "--help"}));
  }
  const Outcome refused = hooke({"help", "rnu"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("\"rnu\" is no command; did you mean \"run\"?"));
}

TEST_F(Usage, HelpShowsFlagsAsTheyAreTyped) {
  for (const char* command : {"run", "render"}) {
    const std::string help = hooke_ok({command, "--help"});
    EXPECT_THAT(help, HasSubstr("--no-legend "));
    EXPECT_THAT(help, Not(HasSubstr("{false}")));
  }
}

TEST_F(Usage, ARefusedChoiceNamesTheOthers) {
  EXPECT_THAT(hooke({"export", "r", "-o", "x.csv", "--as", "stress"}).err,
              HasSubstr("--as: stress not in {particles,surface,volume,contacts,cloths,springs}"));
  EXPECT_THAT(hooke({"render", "r", "-o", "x.png", "--color-by", "stress"}).err,
              HasSubstr("--color-by: stress not in {material,speed,"));
}

TEST_F(Usage, ASceneIsNoRun) {
  write("s.json", small_scene());
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"render", "s.json", "-o", "x.png"}, {"export", "s.json", "-o", "x.csv"}, {"info", "s.json"}}) {
    const Outcome outcome = hooke(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr("is no run but a scene; run it first: hooke run s.json -o s, then hooke " +
                                       arguments.front() + " s"));
  }
  hooke_ok({"run", "s.json", "-o", "out", "--steps", "1"});
  EXPECT_THAT(hooke({"render", "out/scene.json", "-o", "x.png"}).err,
              HasSubstr("is one file of a run; give its folder: hooke render out"));
}

TEST_F(Usage, WrongUsageIsStatus2) {
  write("s.json", small_scene());
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"rnu", "s.json"},
           {"run"},
           {"run", "s.json", "--steps", "-1"},
           {"run", "s.json", "--steps", "1.5"},
           {"run", "s.json", "--steps", "3", "--end", "1"},
           {"run", "s.json", "--threads", "0"},
           {"run", "s.json", "--threads", "-2"},
           {"run", "s.json", "--device", "gpu"},
           {"run", "s.json", "--device", "cuda"},
           {"run", "s.json", "--checkpoint-every", "0"},
           {"run", "s.json", "--unknown"},
           {"bench", "s.json", "--steps", "0"},
           {"export", "s.json"},
           {"export", "nowhere", "-o", "x.csv"},
           {"export", "nowhere", "-o", "x.csv", "--all", "--step", "3"},
           {"info", "nowhere"},
           {"info", "s.json"},
       }) {
    const Outcome outcome = hooke(arguments);
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments);
    EXPECT_NE(outcome.err, "") << testing::PrintToString(arguments);
  }
  EXPECT_FALSE(exists("s"));
  EXPECT_THAT(hooke({"run", "s.json", "--device", "tpu"}).err,
              HasSubstr("--device: tpu not in {cpu,cuda,auto,reference}"));
}

// On any machine: one with a GPU is asked to hide it.
TEST_F(Usage, AGpuThatIsNotThereIsRefused) {
  setenv("CUDA_VISIBLE_DEVICES", "-1", 1);
  write("s.json", small_scene());
  const auto says_what_was_looked_for = testing::AnyOf(HasSubstr("NVIDIA driver"), HasSubstr("not in this build"));
  const Outcome cuda = hooke({"run", "s.json", "--device", "cuda"});
  EXPECT_EQ(cuda.status, 2);
  EXPECT_THAT(cuda.err, says_what_was_looked_for);
  EXPECT_FALSE(exists("s"));
  const Outcome automatic = hooke({"run", "s.json", "--device", "auto", "--steps", "3"});
  EXPECT_EQ(automatic.status, 0) << automatic.err;
  EXPECT_THAT(automatic.err + automatic.out, testing::AllOf(HasSubstr("takes the CPU"), says_what_was_looked_for));
  const Outcome devices = hooke({"info", "--devices"});
  EXPECT_EQ(devices.status, 0);
  EXPECT_THAT(devices.out, testing::AllOf(HasSubstr("scalar"), HasSubstr("cuda       none"), says_what_was_looked_for));
  unsetenv("CUDA_VISIBLE_DEVICES");
}

TEST_F(Usage, AnUnknownInstructionSetIsRefused) {
  write("s.json", small_scene());
  setenv("HOOKE_ISA", "sse9", 1);
  expect_refused({"s.json"}, {"sse9", "portable"});
  unsetenv("HOOKE_ISA");
}

TEST_F(Usage, EveryFindingOfASceneAtOnce) {
  std::string scene = small_scene();
  scene.replace(scene.find("\"radius\": 0.2"), 13, "\"raduis\": 0.2");
  scene.replace(scene.find("\"mass\": 1"), 9, "\"mass\": -1");
  write("bad.json", scene);
  expect_refused({"bad.json"}, {"raduis", "radius", "mass", "-1"});
  expect_refused({"missing.json"}, {"missing.json"});
}

TEST_F(Usage, OverridesAreCheckedLikeTheScene) {
  write("s.json", small_scene());
  expect_refused({"s.json", "--set", "materials.water.radius=-1", "--set", "time.stepp=1"}, {"radius", "-1", "stepp"});
  expect_refused({"s.json", "--set", "materials.water.radius"}, {"materials.water.radius"});
  expect_refused({"s.json", "--set", "gravity=[0,1]"}, {"gravity"});
  expect_refused({"s.json", "--end", "nan"}, {"time.end"});
}

TEST_F(Usage, OverridesTakeOneValueEachAndChangeTheScene) {
  write("s.json", small_scene());
  hooke_ok(
      {"run", "--set", "materials.water.mass=2", "--set", "gravity=[0,-1,0]", "s.json", "-o", "out", "--steps", "2"});
  EXPECT_THAT(hooke_ok({"info", "out"}), HasSubstr("mass 2 kg"));
  hooke_ok({"run", "out/scene.json", "-o", "again"});
  EXPECT_EQ(state_hash("again"), state_hash("out"));
}

TEST_F(Usage, BadDestinations) {
  write("s.json", small_scene());
  write("file", "");
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"run", "s.json", "-o", "file"},
           {"run", "s.json", "-o", "file/below"},
           {"run", "s.json", "-o", "/proc/nowhere"},
           {"run", "s.json", "-o", "out", "--report", "nowhere/report.json"},
           {"run", "s.json", "-o", "out", "--report", "."},
           {"run", "s.json", "-o", "out", "--resume", "nowhere.h5"},
           {"run", "s.json", "-o", "out", "--resume", "s.json"},
       }) {
    const Outcome outcome = hooke(arguments);
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments) << outcome.err;
    EXPECT_NE(outcome.err, "");
    EXPECT_FALSE(exists("out")) << testing::PrintToString(arguments);
  }
}

TEST_F(Usage, FullStandardOutputIsAFailure) {
  EXPECT_THAT(hooke_ok({"schema"}), HasSubstr("\"materials\""));
  EXPECT_THAT(hooke_ok({"scenes"}), HasSubstr("water.json"));
  EXPECT_EQ(hooke({"schema"}, 100).status, 3);
}

TEST_F(Usage, CheckSaysWhatTheSceneIs) {
  write("s.json", small_scene());
  const std::string text = hooke_ok({"check", "s.json"});
  for (const char* part : {"216", "MB", "60 steps", "stable step", "overlaps", "single"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  hooke_ok({"check", "--strict", "s.json"});
}

TEST_F(Usage, CheckWarnsOfAnUnstableStepAndStrictRefusesIt) {
  write("s.json", small_scene());
  const Outcome warned = hooke({"check", "s.json", "--set", "time.step=0.1"});
  EXPECT_EQ(warned.status, 0);
  EXPECT_THAT(warned.err, HasSubstr("stable step"));
  const Outcome refused = hooke({"check", "--strict", "s.json", "--set", "time.step=0.1"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("stable step"));
}

TEST_F(Usage, CheckAndRunWarnWhereFloatsAreCoarse) {
  write("s.json", small_scene());
  for (const std::string command : {"check", "run"}) {
    std::vector<std::string> words{command, "s.json", "--set", "domain.max=[100000,6,4]"};
    if (command == "run") words.insert(words.end(), {"--steps", "1", "--overwrite"});
    EXPECT_THAT(hooke(words).err, HasSubstr("set \"precision\": \"double\"")) << command;
    words.insert(words.end(), {"--set", "precision=double"});
    EXPECT_THAT(hooke(words).err, Not(HasSubstr("precision\":"))) << command;
  }
}

}  // namespace
}  // namespace hooke::test
