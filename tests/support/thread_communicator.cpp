// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "support/thread_communicator.h"

#include <algorithm>
#include <barrier>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <utility>
#include <vector>

namespace hooke::test {
namespace {

// What the ranks have in common. Between two meetings, each writes its own entries, or reads the others'.
struct Room {
  explicit Room(int ranks) : meeting(ranks), memory(static_cast<std::size_t>(ranks)), parcels(memory.size()) {}

  std::barrier<> meeting;
  std::vector<std::vector<std::byte>> memory;  // by rank
  std::vector<std::vector<Parcel>> parcels;    // by sender
};

class ThreadCommunicator final : public Communicator {
 public:
  ThreadCommunicator(std::shared_ptr<Room> room, int rank, BoxCost cost)
      : room_(std::move(room)),
        rank_(rank),
        cost_(std::move(cost)) {}

  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(room_->memory.size()); }

  void combine(void* items, std::size_t count, std::size_t bytes, Add add) override {
    const auto* const own = static_cast<const std::byte*>(items);
    mine().assign(own, own + count * bytes);
    meet();
    // Everyone adds up for itself, each in another order: sums must not depend on it.
    std::vector<std::byte> sum = mine();
    for (int k = 1; k < size(); ++k) {
      const std::vector<std::byte>& theirs = room_->memory[static_cast<std::size_t>((rank_ + k) % size())];
      for (std::size_t i = 0; i < count; ++i) add(theirs.data() + i * bytes, sum.data() + i * bytes);
    }
    meet();
    std::memcpy(items, sum.data(), sum.size());
  }

  void broadcast(std::vector<std::byte>& data) override {
    if (rank_ == 0) mine() = data;
    meet();
    data = room_->memory[0];
    meet();
  }

  std::vector<Parcel> exchange(std::vector<Parcel> out) override {
    room_->parcels[static_cast<std::size_t>(rank_)] = std::move(out);
    meet();
    std::vector<Parcel> in;
    for (int from = 0; from < size(); ++from) {
      for (const Parcel& parcel : room_->parcels[static_cast<std::size_t>(from)]) {
        if (parcel.rank == rank_) in.push_back({from, parcel.bytes});
      }
    }
    meet();
    return in;
  }

  std::unique_ptr<Channel> open(std::span<const Route> out, std::span<const Route> in) override {
    return std::make_unique<Mailing>(*this, out, in);
  }

  // Halves of halves: all points, sorted along the longest axis of their box, and the box cut between two of them.
  std::vector<Box3d> cut(std::span<const WeightedPoint> points) override {
    const auto* const own = reinterpret_cast<const std::byte*>(points.data());
    mine().assign(own, own + points.size_bytes());
    meet();
    std::vector<WeightedPoint> all;
    for (const std::vector<std::byte>& part : room_->memory) {
      const std::size_t before = all.size();
      all.resize(before + part.size() / sizeof(WeightedPoint));
      if (!part.empty()) std::memcpy(all.data() + before, part.data(), part.size());
    }
    meet();
    std::vector<Box3d> boxes;
    const double far = HUGE_VAL;
    halve(all, {{-far, -far, -far}, {far, far, far}}, size(), boxes);
    own_box_ = boxes[static_cast<std::size_t>(rank_)];
    return boxes;
  }

  double processor_seconds() const override {
    if (cost_) seconds_ += cost_(own_box_);
    return seconds_;
  }

  [[noreturn]] void abort(const std::string& why) override {
    std::fprintf(stderr, "rank %d: %s\n", rank_, why.c_str());
    std::abort();
  }

 private:
  class Mailing final : public Channel {
   public:
    Mailing(ThreadCommunicator& of, std::span<const Route> out, std::span<const Route> in)
        : of_(of),
          out_(out.begin(), out.end()),
          in_(in.begin(), in.end()) {}
    void exchange() override {
      std::vector<Parcel> parcels;
      for (const Route& route : out_) parcels.push_back({route.rank, {route.bytes.begin(), route.bytes.end()}});
      const std::vector<Parcel> came = of_.exchange(std::move(parcels));
      for (const Route& route : in_) {
        const auto from = std::find_if(came.begin(), came.end(), [&](const Parcel& p) { return p.rank == route.rank; });
        if (from == came.end() || from->bytes.size() != route.bytes.size()) of_.abort("a message is missing");
        std::memcpy(route.bytes.data(), from->bytes.data(), route.bytes.size());
      }
    }

   private:
    ThreadCommunicator& of_;
    std::vector<Route> out_, in_;
  };

  static void halve(std::span<WeightedPoint> points, const Box3d& box, int ranks, std::vector<Box3d>& boxes) {
    if (ranks == 1) {
      boxes.push_back(box);
      return;
    }
    Box3d around = Box3d::none();
    for (const WeightedPoint& p : points) around.add(p.at);
    int axis = 0;
    for (int a = 1; a < 3 && !points.empty(); ++a) {
      if (component(around.extent(), a) > component(around.extent(), axis)) axis = a;
    }
    const int left = ranks / 2;
    std::sort(points.begin(), points.end(), [axis](const WeightedPoint& a, const WeightedPoint& b) {
      return component(a.at, axis) < component(b.at, axis);
    });
    double weight = 0, below = 0;
    for (const WeightedPoint& p : points) weight += p.weight;
    std::size_t middle = 0;
    while (middle + 1 < points.size() && below + points[middle].weight <= weight * left / ranks)
      below += points[middle++].weight;
    const double at =
        points.empty() ? std::max(component(box.min, axis), -1e6) + 1 : component(points[middle].at, axis);
    Box3d low = box, high = box;
    component(low.max, axis) = component(high.min, axis) = at;
    halve(points.first(middle), low, left, boxes);
    halve(points.subspan(middle), high, ranks - left, boxes);
  }

  std::vector<std::byte>& mine() { return room_->memory[static_cast<std::size_t>(rank_)]; }
  void meet() { room_->meeting.arrive_and_wait(); }

  std::shared_ptr<Room> room_;
  int rank_;
  BoxCost cost_;
  Box3d own_box_;
  mutable double seconds_ = 0;
};

}  // namespace

void run_ranks(int ranks, const std::function<void(std::shared_ptr<Communicator>)>& body, const BoxCost& cost) {
  const auto room = std::make_shared<Room>(ranks);
  std::vector<std::thread> threads;
  for (int rank = 1; rank < ranks; ++rank)
    threads.emplace_back([&, rank] { body(std::make_shared<ThreadCommunicator>(room, rank, cost)); });
  body(std::make_shared<ThreadCommunicator>(room, 0, cost));
  for (std::thread& thread : threads) thread.join();
}

}  // namespace hooke::test
