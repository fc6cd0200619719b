// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/comm/mpi/mpi_communicator.h"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <new>
#include <thread>
#include <utility>

#include "hooke/base/format.h"
#include "hooke/base/printable.h"
#include "hooke/base/process_usage.h"
#include "hooke/comm/mpi/zoltan_cuts.h"

namespace hooke {
namespace {

constexpr int kLeader = 0;
constexpr int kRunFailed = 3;  // exit status
enum Tag : int { kOfExchange = 1, kOfChannel = 2 };

// What MPI adds up at the moment. Its operations get no context, and call on the thread that calls combine().
thread_local Communicator::Add adding = nullptr;

extern "C" void add_items(void* items, void* sums, int* count, MPI_Datatype* type) {
  int bytes = 0;
  MPI_Type_size(*type, &bytes);
  const auto* item = static_cast<const std::byte*>(items);
  auto* sum = static_cast<std::byte*>(sums);
  for (int i = 0; i < *count; ++i, item += bytes, sum += bytes) adding(item, sum);
}

// Waits for what may take long, as for the next order while rank 0 writes a file: looks all the time at first, and then
// now and again, so that the core is free for others.
void nap_until_done(MPI_Request request) {
  using std::chrono::microseconds;
  constexpr microseconds kWatchful(50), kLongestNap(1000);
  const auto start = std::chrono::steady_clock::now();
  microseconds nap(20);
  for (;;) {
    int done = 0;
    MPI_Request_get_status(request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return;
    if (std::chrono::steady_clock::now() - start < kWatchful) continue;
    std::this_thread::sleep_for(nap);
    nap = std::min(2 * nap, kLongestNap);
  }
}

// Calls each(first byte, count) for pieces that MPI can count.
template <class Each>
void in_pieces(std::span<std::byte> bytes, std::size_t most, const Each& each) {
  while (!bytes.empty()) {
    const std::size_t length = std::min(bytes.size(), most);
    each(bytes.data(), static_cast<int>(length));
    bytes = bytes.subspan(length);
  }
}

// Persistent requests, as MPI calls them: set up once, started at each exchange.
class MpiChannel final : public Communicator::Channel {
 public:
  MpiChannel(std::span<const Communicator::Route> out, std::span<const Communicator::Route> in, std::size_t most) {
    for (const Communicator::Route& route : in) {
      in_pieces(route.bytes, most, [&](std::byte* at, int count) {
        MPI_Recv_init(at, count, MPI_BYTE, route.rank, kOfChannel, MPI_COMM_WORLD, &requests_.emplace_back());
      });
    }
    for (const Communicator::Route& route : out) {
      in_pieces(route.bytes, most, [&](std::byte* at, int count) {
        MPI_Send_init(at, count, MPI_BYTE, route.rank, kOfChannel, MPI_COMM_WORLD, &requests_.emplace_back());
      });
    }
  }
  ~MpiChannel() override {
    for (MPI_Request& request : requests_) MPI_Request_free(&request);
  }
  MpiChannel(const MpiChannel&) = delete;
  MpiChannel& operator=(const MpiChannel&) = delete;

  void exchange() override {
    if (requests_.empty()) return;
    MPI_Startall(static_cast<int>(requests_.size()), requests_.data());
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  }

 private:
  std::vector<MPI_Request> requests_;
};

class MpiCommunicator final : public Communicator {
 public:
  explicit MpiCommunicator(const MpiOptions& options) : largest_message_(options.largest_message) {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Op_create(add_items, 1, &add_);
  }
  ~MpiCommunicator() override {
    cuts_.reset();
    for (auto& [bytes, type] : item_types_) MPI_Type_free(&type);
    MPI_Op_free(&add_);
    MPI_Finalize();
  }
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void combine(void* items, std::size_t count, std::size_t bytes, Add add) override {
    if (count == 0 || bytes == 0) return;
    adding = add;
    MPI_Allreduce(MPI_IN_PLACE, items, static_cast<int>(count), item_type(bytes), add_, MPI_COMM_WORLD);
  }

  void broadcast(std::vector<std::byte>& data) override {
    std::uint64_t length = data.size();
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(&length, 1, MPI_UINT64_T, kLeader, MPI_COMM_WORLD, &request);
    nap_until_done(request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
    in_memory([&] { data.resize(length); });
    in_pieces(data, largest_message_,
              [](std::byte* at, int count) { MPI_Bcast(at, count, MPI_BYTE, kLeader, MPI_COMM_WORLD); });
  }

  std::vector<Parcel> exchange(std::vector<Parcel> out) override {
    std::vector<Parcel> in;
    std::vector<MPI_Request> requests;
    in_memory([&] { in = unpacked(tell_lengths(out)); });
    for (Parcel& parcel : in) {
      if (parcel.rank == rank_) continue;
      in_pieces(parcel.bytes, largest_message_, [&](std::byte* at, int count) {
        MPI_Irecv(at, count, MPI_BYTE, parcel.rank, kOfExchange, MPI_COMM_WORLD, &requests.emplace_back());
      });
    }
    for (Parcel& parcel : out) {
      if (parcel.rank == rank_) {
        keep_own(parcel, in);
        continue;
      }
      in_pieces(parcel.bytes, largest_message_, [&](std::byte* at, int count) {
        MPI_Isend(at, count, MPI_BYTE, parcel.rank, kOfExchange, MPI_COMM_WORLD, &requests.emplace_back());
      });
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    return in;
  }

  std::unique_ptr<Channel> open(std::span<const Route> out, std::span<const Route> in) override {
    return std::make_unique<MpiChannel>(out, in, largest_message_);
  }

  std::vector<Box3d> cut(std::span<const WeightedPoint> points) override {
    if (!cuts_) cuts_ = std::make_unique<ZoltanCuts>();
    return cuts_->cut(points, size_);
  }

  double processor_seconds() const override { return thread_processor_seconds(); }

  [[noreturn]] void abort(const std::string& why) override {
    std::fprintf(stderr, "hooke: rank %d: %s\n", rank_, printable(why, 1000).c_str());
    std::fflush(stderr);
    MPI_Abort(MPI_COMM_WORLD, kRunFailed);
    std::abort();
  }

 private:
  // Where the others wait for what this rank has no memory to take, there is no going on.
  template <class Body>
  void in_memory(const Body& body) {
    try {
      body();
    } catch (const std::bad_alloc&) {
      abort("out of memory");
    }
  }

  MPI_Datatype item_type(std::size_t bytes) {
    const auto [at, is_new] = item_types_.try_emplace(bytes, MPI_DATATYPE_NULL);
    if (is_new) {
      MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &at->second);
      MPI_Type_commit(&at->second);
    }
    return at->second;
  }

  // How many bytes each rank sends here, by rank.
  std::vector<std::uint64_t> tell_lengths(const std::vector<Parcel>& out) const {
    const auto ranks = static_cast<std::size_t>(size_);
    std::vector<std::uint64_t> going(ranks, 0), coming(ranks, 0);
    for (const Parcel& parcel : out) going[static_cast<std::size_t>(parcel.rank)] = parcel.bytes.size();
    MPI_Alltoall(going.data(), 1, MPI_UINT64_T, coming.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
    return coming;
  }

  // Parcels to be filled; that from this rank itself is moved.
  std::vector<Parcel> unpacked(const std::vector<std::uint64_t>& lengths) const {
    std::vector<Parcel> in;
    for (int rank = 0; rank < size_; ++rank) {
      const std::uint64_t length = lengths[static_cast<std::size_t>(rank)];
      if (length > 0) in.push_back({rank, std::vector<std::byte>(rank == rank_ ? 0 : length)});
    }
    return in;
  }

  void keep_own(Parcel& parcel, std::vector<Parcel>& in) const {
    const auto own = std::ranges::find(in, rank_, &Parcel::rank);
    if (own != in.end()) own->bytes = std::move(parcel.bytes);
  }

  std::size_t largest_message_;
  int rank_ = 0, size_ = 1;
  MPI_Op add_ = MPI_OP_NULL;
  std::map<std::size_t, MPI_Datatype> item_types_;  // by bytes
  std::unique_ptr<ZoltanCuts> cuts_;
};

}  // namespace

Expected<std::shared_ptr<Communicator>> join_ranks(int launched, const MpiOptions& options) {
  int level = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
  std::shared_ptr<Communicator> communicator = std::make_shared<MpiCommunicator>(options);
  if (const int size = communicator->size(); size != launched) {
    return fail(Error::Kind::bad_input, "mpi",
                formatted("{} ranks were started, but MPI knows of {}: the launcher is of another MPI, or srun needs "
                          "--mpi=pmix",
                          launched, size));
  }
  return communicator;
}

}  // namespace hooke
