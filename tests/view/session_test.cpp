// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "session.h"

#include <gmock/gmock.h>

#include <cmath>
#include <thread>

#include "replay.h"
#include "view_scene.h"

namespace hooke::test {
namespace {

using namespace view;
using testing::HasSubstr;

class Sessions : public ViewTest {
 protected:
  static std::unique_ptr<Session> opened(const SessionOptions& options) {
    auto session = Session::open(options);
    if (!session) throw std::runtime_error(session.error().text());
    return std::move(*session);
  }
  static void advance(Session& session, std::int64_t steps) {
    session.step(steps);
    session.wait();
  }
  // What a user might do in some minutes, with every kind of action.
  static void play(Session& session) {
    advance(session, 25);
    session.act(AddBall{"blue", {1, 1.7, 0.4}, 0.15, {0, -1, 0}});
    advance(session, 10);
    session.act(HoldCollider{"ball", {0, 0, 0}});
    session.act(Lead{{0, -0.3, -0.4}});
    advance(session, 120);
    session.act(LetGo{});
    session.act(HoldParticles{{5, 6, 7, 8}});
    session.act(Lead{{0.1, 0.4, 0}});
    advance(session, 33);
    scene::Json text = *session.wanted();
    text["materials"]["red"]["stiffness"] = 300;
    session.change_scene(text);
    advance(session, 20);
    session.act(LetGo{});
    text["gravity"] = {1, -5, 0};
    session.change_scene(text);
    advance(session, 20);
    text["time"]["step"] = 0.0008;
    session.change_scene(text);
    advance(session, 20);
    session.act(CutSprings{{40, 41, 42}});
    advance(session, 30);
    session.go_back(17);
    session.wait();
    advance(session, 40);
    session.undo();
    advance(session, 9);
    session.act(Scatter{3});
    advance(session, 30);
    session.act(Reset{});
    advance(session, 31);
  }
  static std::string messages(Session& session) {
    std::string all;
    for (std::string next = session.next_message(); !next.empty(); next = session.next_message()) all += next + "\n";
    return all;
  }
};

TEST_F(Sessions, AreReplayedWithTheSameBitsByAnyNumberOfThreads) {
  SessionOptions recorded = options();
  recorded.record = path("a.record");
  std::uint64_t hash = 0;
  {
    const auto session = opened(recorded);
    play(*session);
    EXPECT_EQ(messages(*session), "");
    hash = session->finish();
  }
  const auto record = read_record(path("a.record"));
  ASSERT_TRUE(record) << record.error().text();
  for (const int threads : {1, 2}) {
    run::DeviceArguments device;
    device.threads = threads;
    const auto end = replay(*record, recorded.scene, device);
    ASSERT_TRUE(end) << end.error().text();
    EXPECT_FALSE(end->report.diverged) << "at step " << *end->report.diverged;
    EXPECT_EQ(end->state_hash, hash) << threads << " threads";
    EXPECT_GT(end->report.compared, 30);
  }
  // In a session, as the window replays it.
  SessionOptions again = options(1);
  again.replay = record->entries;
  const auto session = opened(again);
  session->run(true);
  session->set_speed(std::numeric_limits<double>::infinity());
  for (int i = 0; i < 3000 && session->readings().replay.running; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_FALSE(session->readings().replay.running);
  EXPECT_FALSE(session->readings().replay.diverged);
}

TEST_F(Sessions, SayWhereAReplayDiverges) {
  SessionOptions recorded = options();
  recorded.record = path("a.record");
  {
    const auto session = opened(recorded);
    advance(*session, 15);
    session->act(AddBall{"blue", {1, 1.7, 0.4}, 0.15, {0, -1, 0}});
    advance(*session, 20);
    session->finish();
  }
  auto record = read_record(path("a.record"));
  ASSERT_TRUE(record);
  for (RecordEntry& entry : record->entries) {
    if (auto* action = std::get_if<Action>(&entry.what)) std::get<AddBall>(*action).velocity.y = -1.0000001;
  }
  const auto end = replay(*record, recorded.scene, {});
  ASSERT_TRUE(end);
  ASSERT_TRUE(end->report.diverged);
  EXPECT_EQ(*end->report.diverged, 20);
  EXPECT_EQ(end->report.last_equal, 10);
}

TEST_F(Sessions, GoBackToTheSameBits) {
  const auto session = opened(options());
  const auto hash = [&] { return session->finish(); };
  advance(*session, 20);
  session->act(AddBall{"red", {1, 1.2, 0.4}, 0.1, {0, 0, 0}});
  advance(*session, 10);
  const std::uint64_t then = hash();
  advance(*session, 23);
  session->go_back(23);
  session->wait();
  EXPECT_EQ(session->readings().steps, 30);
  EXPECT_EQ(hash(), then);
  session->go_back(11);  // before the ball
  session->wait();
  EXPECT_EQ(session->readings().steps, 19);
  const std::uint64_t without = session->readings().particles;
  advance(*session, 11);
  EXPECT_EQ(session->readings().particles, without);
  session->go_back(1'000'000);
  session->wait();
  EXPECT_EQ(session->readings().steps, 0);
}

TEST_F(Sessions, ChangeTheSceneUndoAndRedo) {
  const auto session = opened(options());
  scene::Json text = *session->wanted();
  text["materials"]["red"]["mass"] = 0.3;
  session->change_scene(text);
  session->wait();
  EXPECT_EQ(session->scene()->materials[0].mass, 0.3);
  text["colliders"][0]["motion"] = scene::Json{{"velocity", {0.1, 0, 0}}};
  session->change_scene(text);
  advance(*session, 10);
  EXPECT_TRUE(std::holds_alternative<SteadyMotion>(session->scene()->colliders[0].motion));
  session->undo();
  session->undo();
  session->wait();
  EXPECT_EQ(session->scene()->materials[0].mass, 0.1);
  EXPECT_FALSE(session->can_undo());
  session->redo();
  session->wait();
  EXPECT_EQ(session->scene()->materials[0].mass, 0.3);
  EXPECT_EQ(messages(*session), "");
}

TEST_F(Sessions, RefuseWhatCanNotBeAndStayAsTheyWere) {
  const auto session = opened(options());
  const std::uint64_t before = session->finish();
  scene::Json text = *session->wanted();
  text["materials"]["red"]["radius"] = -1;
  session->change_scene(text);
  session->wait();
  EXPECT_THAT(messages(*session), HasSubstr("materials.red.radius"));
  EXPECT_EQ((*session->wanted())["materials"]["red"]["radius"], 0.05);
  session->act(AddBall{"gold", {1, 1, 1}, 0.1, {}});
  session->act(AddBall{"red", {100, 1, 1}, 0.1, {}});
  session->act(AddBall{"red", {1, 1, 1}, 1e9, {}});
  session->act(HoldCollider{"nothing", {}});
  session->act(HoldParticles{{987654}});
  session->act(CutSprings{{987654}});
  session->act(LoadCheckpoint{path("missing.h5").string()});
  session->wait();
  const std::string said = messages(*session);
  for (const char* part : {"gold", "no room", "too large", "nothing", "987654", "missing.h5"}) {
    EXPECT_THAT(said, HasSubstr(part));
  }
  EXPECT_EQ(session->finish(), before);
}

TEST_F(Sessions, OfferTheStateBeforeAFailure) {
  const auto session = opened(options());
  advance(*session, 40);
  scene::Json text = *session->wanted();
  text["time"]["step"] = 0.2;  // far from stable
  session->change_scene(text);
  session->step(100);
  session->wait();
  EXPECT_THAT(session->readings().failure, HasSubstr("time.step"));
  session->go_back(session->readings().reach);
  session->wait();
  EXPECT_EQ(session->readings().failure, "");
  advance(*session, 10);
  EXPECT_EQ(session->readings().failure, "");
}

TEST_F(Sessions, SaveWhatTheyAreAndGoOnFromIt) {
  const auto session = opened(options());
  session->act(HoldCollider{"ball", {0, 0, 0}});
  session->act(Lead{{0, -0.2, 0}});
  advance(*session, 200);
  session->act(LetGo{});
  session->save_checkpoint(path("here.h5"));
  session->wait();
  EXPECT_THAT(messages(*session), HasSubstr("saved"));
  write("saved.json", scene::pretty(session->text_to_save()));
  SessionOptions later = options();
  later.scene.file = path("saved.json");
  later.resume = path("here.h5");
  const auto other = opened(later);
  EXPECT_EQ(other->finish(), session->finish());
  advance(*session, 20);
  advance(*other, 20);
  EXPECT_EQ(other->finish(), session->finish()) << "the collider was saved where it was led";
}

TEST_F(Sessions, ShowFramesThatFitTheirParticles) {
  const auto session = opened(options());
  const auto next_frame = [&](const ColorRequest& color, const auto& is_right) {
    for (int i = 0; i < 3000; ++i) {
      const auto frame = session->frame(color);
      if (frame && is_right(*frame)) return frame;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return std::shared_ptr<const ViewFrame>();
  };
  advance(*session, 10);
  ColorRequest color;
  color.by = Coloring::height;
  color.low = 0;
  color.high = 2;
  const auto frame = next_frame(color, [](const ViewFrame& f) { return f.step_count == 10; });
  ASSERT_TRUE(frame);
  const auto snapshot = session->snapshot();
  ASSERT_EQ(frame->particles.size(), snapshot->particles.size());
  for (std::size_t i = 0; i < frame->particles.size(); ++i) {
    const Vec3d x = snapshot->particles.position[i] - frame->origin;
    EXPECT_NEAR(frame->particles[i].y, x.y, 1e-6);
    EXPECT_EQ(frame->particles[i].tag >> 16, snapshot->particles.material[i]);
    EXPECT_NEAR((frame->particles[i].tag & 0xffff) / 65535.0, snapshot->particles.position[i].y / 2, 1e-4);
  }
  color.by = Coloring::contacts;
  color.high = 12;
  const auto counted = next_frame(color, [](const ViewFrame& f) { return f.highest >= 1; });
  ASSERT_TRUE(counted) << "contacts are counted on another thread and arrive";
  EXPECT_EQ(frame->step_count, 10) << "a frame that is kept does not change";
}

TEST_F(Sessions, TellAParticleAndItsContacts) {
  const auto session = opened(options());
  advance(*session, 200);
  session->inspect(1);
  ColorRequest color;
  for (int i = 0; i < 1000 && !session->inspection(); ++i) {
    session->frame(color);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ASSERT_TRUE(session->inspection());
  EXPECT_EQ(session->inspection()->particle.id, 1u);
  ASSERT_FALSE(session->inspection()->contacts.empty()) << "it lies on the floor";
  EXPECT_THAT(session->inspection()->contacts.back().partner, HasSubstr("wall"));
}

TEST_F(Sessions, TakeScenesWithoutParticles) {
  write("scene.json", R"({"hooke": 1, "time": {"step": 0.01, "end": 1}, "domain": {"min": [0, 0, 0], "max": [1, 1, 1]},
    "materials": {"sand": {"radius": 0.02, "mass": 1, "stiffness": 100}}, "particles": []})");
  const auto session = opened(options());
  advance(*session, 5);
  session->act(Scatter{1});
  session->act(AddBall{"sand", {0.5, 0.5, 0.5}, 0.1, {}});
  advance(*session, 5);
  EXPECT_GT(session->readings().particles, 10u);
  session->go_back(7);
  session->wait();
  EXPECT_EQ(session->readings().particles, 0u);
  EXPECT_THAT(messages(*session), HasSubstr("no particle may be moved"));
}

// A grid of balls 10,000 km from 0, a metre apart, where floats lie a metre apart.
TEST_F(Sessions, ShowParticlesOfFarScenesWhereTheyAre) {
  write("far.json", R"({
    "hooke": 1, "precision": "double", "time": { "step": 0.001, "end": 1 }, "gravity": [0, 0, 0],
    "domain": { "min": [1e7, 0, 0], "max": [10000010, 10, 10] },
    "materials": { "ball": { "radius": 0.3, "mass": 1, "stiffness": 100 } },
    "particles": [ { "material": "ball", "block": { "min": [10000001.25, 1, 1], "max": [10000008.25, 9, 1], "spacing": 1 } } ] })");
  SessionOptions far = options();
  far.scene.file = path("far.json");
  const auto session = opened(far);
  const auto frame = [&] {
    while (true) {
      if (auto ready = session->frame({})) return ready;
      session->wait();
    }
  }();
  ASSERT_GT(frame->particles.size(), 20u);
  for (const render::LiveParticle& p : frame->particles) {
    const double x = session->origin().x + static_cast<double>(p.x) - 10000001.25;
    EXPECT_NEAR(x, std::round(x), 1e-5);
  }
  EXPECT_LT(frame->particles[0].x, frame->particles[1].x);
}

}  // namespace
}  // namespace hooke::test
