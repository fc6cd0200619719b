// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What `check` and `run` say of particles that overlap walls and colliders at the start, or are inside of solids.

#include <gmock/gmock.h>

#include "program.h"

namespace hooke::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Starts : public ProgramTest {
 protected:
  static std::string scene(const std::string& collider) {
    return R"({"hooke":1,"name":"start","time":{"step":0.001,"steps":0},"precision":"double",
      "domain":{"min":[0,0,0],"max":[2,2,2]},"materials":{"water":{"radius":0.05,"mass":0.02,"stiffness":400}},
      "particles":[{"material":"water","block":{"min":[0.03,1,1],"max":[1.93,1,1],"spacing":0.1}}],
      "colliders":[{"name":"ball",)" +
           collider + "}]}";
  }
};

TEST_F(Starts, CountAndNameOverlaps) {
  write("s.json", scene(R"("shape":{"sphere":{"center":[1.03,1.34,1],"radius":0.3}})"));
  const Outcome checked = hooke({"check", "s.json"});
  EXPECT_EQ(checked.status, 0);
  EXPECT_THAT(checked.out,
              HasSubstr("1 particle overlaps the wall x-min at the start, particle 1 most, by 40 % of its radius"));
  EXPECT_THAT(checked.out,
              HasSubstr("1 particle overlaps collider \"ball\" at the start, particle 11 most, by 20 % of its radius"));
  EXPECT_EQ(checked.err, "");
  const Outcome ran = hooke({"run", "s.json", "--report", "r.json"});
  EXPECT_EQ(ran.err, "");
  EXPECT_THAT(read("s/log.txt"), HasSubstr("overlaps collider \"ball\" at the start"));
  EXPECT_THAT(read("r.json"), HasSubstr("\"max_overlap_ratio\": 0.4"));
}

TEST_F(Starts, NameEntriesThatAreOverlappedDeeply) {
  write("s.json", scene(R"("shape":{"sphere":{"center":[1.03,1.31,1],"radius":0.3}})"));
  const std::string warning =
      "colliders[0]: 3 particles overlap collider \"ball\" at the start, particle 11 most, by 80 % of its radius";
  EXPECT_THAT(hooke({"check", "s.json"}).err, HasSubstr(warning));
  EXPECT_THAT(hooke({"run", "s.json"}).err, HasSubstr(warning));
}

TEST_F(Starts, NameSolidsThatHoldParticles) {
  const std::string shape = R"("shape":{"box":{"min":[0.5,0.5,0.5],"max":[1.5,1.5,1.5]}})";
  write("s.json", scene(shape));
  const std::string warning =
      "colliders[0]: 10 particles are inside collider \"ball\", a solid, which pushes them out; with \"hollow\": true "
      "it "
      "is a shell that holds them";
  EXPECT_THAT(hooke({"check", "s.json"}).err, HasSubstr(warning));
  EXPECT_THAT(hooke({"run", "s.json"}).err, HasSubstr(warning));
  EXPECT_THAT(hooke({"check", "s.json", "--set", "colliders[0].hollow=true"}).err, Not(HasSubstr("solid")));
}

TEST_F(Starts, OfAResumedRunAreNoStart) {
  write("s.json", scene(R"("shape":{"box":{"min":[0.5,0.5,0.5],"max":[1.5,1.5,1.5]}})"));
  hooke({"run", "s.json", "--steps", "1", "-q"});
  EXPECT_EQ(hooke({"run", "s.json", "--resume", "s/checkpoint.h5", "--steps", "2"}).err, "");
}

}  // namespace
}  // namespace hooke::test
