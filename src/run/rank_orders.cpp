// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/rank_orders.h"

#include <string_view>
#include <utility>
#include <vector>

#include "hooke/base/bytes.h"
#include "hooke/base/format.h"
#include "hooke/base/hash.h"

namespace hooke::run {
namespace {

constexpr int kLeader = 0;

using Bytes = std::vector<std::byte>;
using BytesLeft = std::span<const std::byte>;

void append_text(Bytes& to, std::string_view text) {
  append_bytes(to, text.size());
  append_bytes(to, text.data(), text.size());
}
std::string take_text(BytesLeft& from) {
  std::size_t length = 0;
  take_bytes(from, length);
  std::string text(length, '\0');
  take_bytes(from, text.data(), length);
  return text;
}

template <class T>
T take(BytesLeft& from) {
  T value{};
  take_bytes(from, value);
  return value;
}

Bytes packed(const Expected<RankReadiness>& readiness) {
  Bytes bytes;
  append_bytes(bytes, readiness.has_value());
  if (readiness) {
    append_bytes(bytes, *readiness);
    return bytes;
  }
  append_bytes(bytes, readiness.error().kind);
  append_bytes(bytes, readiness.error().findings.size());
  for (const Finding& finding : readiness.error().findings) {
    append_text(bytes, finding.where);
    append_text(bytes, finding.message);
  }
  return bytes;
}

Expected<RankReadiness> unpacked(BytesLeft from) {
  if (take<bool>(from)) return take<RankReadiness>(from);
  Error error{take<Error::Kind>(from), {}};
  error.findings.resize(take<std::size_t>(from));
  for (Finding& finding : error.findings) {
    finding.where = take_text(from);
    finding.message = take_text(from);
  }
  return fail(std::move(error));
}

// What another rank says of itself, as rank 0 reports it.
Error named(Error error, int rank) {
  for (Finding& finding : error.findings)
    finding.where = formatted("rank {}{}{}", rank, finding.where.empty() ? "" : ": ", finding.where);
  return error;
}

// The threads in all, if everyone is ready and has the same scene as rank 0.
Expected<int> compare(const Expected<RankReadiness>& leader, const std::vector<Parcel>& others) {
  if (!leader) return fail(leader.error());
  int threads = leader->threads;
  for (const Parcel& parcel : others) {
    const auto other = unpacked(parcel.bytes);
    if (!other) return fail(named(other.error(), parcel.rank));
    if (other->scene != leader->scene) {
      return fail(Error::Kind::bad_input, formatted("rank {}", parcel.rank),
                  "reads another scene from this file than rank 0, or is of another version of hooke");
    }
    threads += other->threads;
  }
  return threads;
}

}  // namespace

void give_order(Communicator& communicator, const RankOrder& order) {
  Bytes bytes;
  append_bytes(bytes, order.kind);
  append_bytes(bytes, order.status);
  append_text(bytes, order.scene.file.string());
  append_bytes(bytes, order.scene.overrides.size());
  for (const std::string& override : order.scene.overrides) append_text(bytes, override);
  append_bytes(bytes, order.scene.allow_outside);
  append_text(bytes, order.device.device);
  append_bytes(bytes, order.device.threads);
  communicator.broadcast(bytes);
}

RankOrder take_order(Communicator& communicator) {
  Bytes bytes;
  communicator.broadcast(bytes);
  BytesLeft from = bytes;
  RankOrder order;
  order.kind = take<RankOrder::Kind>(from);
  order.status = take<int>(from);
  order.scene.file = take_text(from);
  order.scene.overrides.resize(take<std::size_t>(from));
  for (std::string& override : order.scene.overrides) override = take_text(from);
  order.scene.allow_outside = take<bool>(from);
  order.device.device = take_text(from);
  order.device.threads = take<int>(from);
  return order;
}

std::uint64_t hash_of_scene(const std::string& resolved) {
  std::uint64_t hash = 0;
  for (const std::string_view text : {std::string_view(resolved), std::string_view(HOOKE_VERSION)}) {
    for (const char letter : text) hash = combine64(hash, static_cast<unsigned char>(letter));
  }
  return hash;
}

Expected<int> agree(Communicator& communicator, const Expected<RankReadiness>& here) {
  const bool leads = communicator.rank() == kLeader;
  std::vector<Parcel> out;
  if (!leads) out.push_back({kLeader, packed(here)});
  const std::vector<Parcel> others = communicator.exchange(std::move(out));
  Expected<int> all = leads ? compare(here, others) : Expected<int>(0);
  Bytes verdict;
  append_bytes(verdict, all.has_value());
  communicator.broadcast(verdict);
  BytesLeft from = verdict;
  if (take<bool>(from) || leads) return all;
  return here ? fail(Error::Kind::bad_input, "ranks", "another one is not ready") : fail(here.error());
}

}  // namespace hooke::run
