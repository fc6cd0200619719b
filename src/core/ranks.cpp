// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/ranks.h"

#include <algorithm>
#include <functional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "hooke/base/assert.h"
#include "hooke/base/bytes.h"
#include "hooke/base/format.h"
#include "hooke/base/hash.h"
#include "hooke/base/process_usage.h"
#include "hooke/core/particle_parcels.h"

namespace hooke {
namespace {

constexpr int kLeader = 0;

// Adds the processor time of its scope to a sum. Where there are more ranks than cores, most of the time that passes in
// a message is the other ranks' work.
class Waiting {
 public:
  Waiting(const Communicator& communicator, double& seconds)
      : communicator_(communicator),
        seconds_(seconds),
        start_(communicator.processor_seconds()) {}
  ~Waiting() { seconds_ += communicator_.processor_seconds() - start_; }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  const Communicator& communicator_;
  double& seconds_;
  double start_;
};

template <class T, class Body>
Communicator::Add adding(const Body&) {
  static_assert(std::is_trivially_copyable_v<T> && std::is_empty_v<Body>);
  return [](const void* item, void* sum) { Body{}(*static_cast<const T*>(item), *static_cast<T*>(sum)); };
}

template <class T>
std::vector<Parcel> to_all_others(const Communicator& communicator, const std::vector<T>& values) {
  std::vector<Parcel> out;
  for (int rank = 0; rank < communicator.size(); ++rank) {
    if (rank == communicator.rank() || values.empty()) continue;
    append_bytes(out.emplace_back(Parcel{rank, {}}).bytes, values.data(), values.size());
  }
  return out;
}

template <class T>
std::vector<T> values_of(std::span<const std::byte> bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  take_bytes(bytes, values.data(), values.size());
  return values;
}

}  // namespace

Ranks::Ranks(std::shared_ptr<Communicator> communicator) : communicator_(std::move(communicator)) {
  if (communicator_ && communicator_->size() == 1) communicator_ = nullptr;
  if (communicator_) balance_ = RankBalance(communicator_->size());
}

Ranks::ForcePass::ForcePass(Ranks& ranks, Backend& backend)
    : ranks_(ranks),
      backend_(backend),
      start_(ranks.is_serial() ? 0 : ranks.communicator_->processor_seconds()) {}
Ranks::ForcePass::~ForcePass() {
  if (ranks_.is_serial()) return;
  const double seconds = ranks_.communicator_->processor_seconds() - start_;
  ranks_.balance_.add_step(seconds, static_cast<double>(backend_.shared()->own_count()));
}

template <class T, class Body>
void Ranks::combine(std::span<T> items, const Body& body, const Place& here) {
  const Waiting waiting(*communicator_, waited_);
  expect_all(here);
  communicator_->combine(items.data(), items.size(), sizeof(T), adding<T>(body));
}
template <class T, class Body>
void Ranks::combine(T& item, const Body& body, const Place& here) {
  combine(std::span<T>(&item, 1), body, here);
}

std::vector<Parcel> Ranks::exchange(std::vector<Parcel> out, const Place& here) {
  const Waiting waiting(*communicator_, waited_);
  expect_all(here);
  return communicator_->exchange(std::move(out));
}

// With assertions: ranks that come from different places say so. Without, they wait for each other for ever.
void Ranks::expect_all([[maybe_unused]] const Place& here) {
#if HOOKE_ASSERTIONS
  struct Places {
    std::uint64_t least, most;
  };
  std::string_view file = here.file_name();
  file.remove_prefix(file.rfind('/') + 1);
  const std::uint64_t place = combine64(std::hash<std::string_view>{}(file), here.line());
  Places places{place, place};
  communicator_->combine(&places, 1, sizeof places, adding<Places>([](const Places& a, Places& sum) {
    sum = {std::min(sum.least, a.least), std::max(sum.most, a.most)};
  }));
  if (places.least == places.most) return;
  communicator_->abort(
      formatted("is at line {} of {}, {}(), while another rank is elsewhere", here.line(), file, here.function_name()));
#endif
}

bool Ranks::neighbours_stale(Backend& backend) { return is_serial() ? backend.neighbours_stale() : stale_; }

Condition Ranks::build_neighbours(Backend& backend) {
  if (is_serial()) return backend.build_neighbours();
  SharedParticles& shared = *backend.shared();
  if (shared.has_springs()) share_torn(shared);
  exchange_particles(shared);
  renew_ghosts(shared);
  const Condition found = first(backend.build_neighbours());
  stale_ = !found.good();
  return found;
}

Condition Ranks::follow_motion(Backend& backend, const Condition& here) {
  if (is_serial()) {
    backend.follow_motion();
    return here;
  }
  refresh(*backend.shared());
  backend.follow_motion();
  return decide(backend, *backend.shared(), here);
}

Condition Ranks::first(const Condition& here) {
  if (is_serial()) return here;
  Condition all = here;
  combine(all, [](const Condition& a, Condition& sum) { sum = Condition::first(sum, a); });
  return all;
}

void Ranks::end_interval(std::uint64_t particles) {
  const auto steps = static_cast<double>(balance_.steps());
  RankBalance::Interval all = balance_.interval(particles);
  combine(all, [](const RankBalance::Interval& a, RankBalance::Interval& sum) { sum.add(a); });
  balance_.end_interval(all);
  statistics_.steps += steps;
  statistics_.uneven_particles += steps * all.particles.uneven(communicator_->size());
  statistics_.uneven_time += steps * all.seconds.uneven(communicator_->size());
}

// Everyone to the owner of its place; new boxes where the work has become uneven, more than a cut can help.
void Ranks::exchange_particles(SharedParticles& shared) {
  const std::uint64_t own = shared.own_count();
  end_interval(own);
  RankBalance::Spread loads = RankBalance::Spread::of(static_cast<double>(own) * balance_.slowness());
  combine(loads, [](const RankBalance::Spread& a, RankBalance::Spread& sum) { sum.add(a); });
  // Sums of times may differ between ranks in their last bits.
  bool wanted = balance_.wants_cut(loads);
  combine(wanted, [](const bool& a, bool& sum) { sum = sum || a; });
  if (wanted) cut(shared);
  std::vector<Parcel> out;
  shared.move_out(space_, communicator_->rank(), out);
  shared.move_in(exchange(std::move(out)));
}

// New boxes. What their particles are expected to cost is what they have cost where they were.
void Ranks::cut(SharedParticles& shared) {
  const double start = communicator_->processor_seconds();
  std::vector<WeightedPoint> points;
  shared.sample(points);
  for (WeightedPoint& p : points) p.weight *= balance_.slowness();
  {
    const Waiting waiting(*communicator_, waited_);
    space_.boxes = communicator_->cut(points);
  }
  ++statistics_.cuts;
  struct Share {
    double work = 0, load = 0;
  };
  std::vector<Share> shares(space_.boxes.size());
  for (const WeightedPoint& p : points) {
    const int owner = space_.owner(p.at);
    if (owner == Decomposition::kNobody) continue;
    shares[static_cast<std::size_t>(owner)].load += p.weight;
    shares[static_cast<std::size_t>(owner)].work += p.weight / balance_.slowness();
  }
  combine(std::span(shares), [](const Share& a, Share& sum) {
    sum.work += a.work;
    sum.load += a.load;
  });
  RankBalance::Spread loads;
  for (const Share& share : shares) loads.add(RankBalance::Spread::of(share.load));
  const Share& here = shares[static_cast<std::size_t>(communicator_->rank())];
  balance_.begin_anew(loads, here.work > 0 ? here.load / here.work : 1, here.work,
                      communicator_->processor_seconds() - start);
}

// A spring tears on the ranks that own its ends; the others learn of it before they may own one.
void Ranks::share_torn(SharedParticles& shared) {
  const std::vector<std::uint32_t> here = shared.take_torn();
  for (const Parcel& parcel : exchange(to_all_others(*communicator_, here)))
    shared.tear(values_of<std::uint32_t>(parcel.bytes));
}

std::vector<WantedParticles> Ranks::exchange_wanted(const SharedParticles& shared) {
  std::vector<WantedParticles> wanted;
  for (const Parcel& parcel : exchange(to_all_others(*communicator_, shared.wanted())))
    wanted.push_back({parcel.rank, values_of<std::uint32_t>(parcel.bytes)});
  return wanted;
}

void Ranks::renew_ghosts(SharedParticles& shared) {
  const auto ranks = static_cast<std::size_t>(communicator_->size());
  largest_.assign(ranks, -1);
  largest_[static_cast<std::size_t>(communicator_->rank())] = shared.largest_radius();
  combine(std::span(largest_), [](const double& a, double& sum) { sum = std::max(sum, a); });
  width_ = shared.next_width();
  combine(width_.skin, [](const double& a, double& sum) { sum = std::max(sum, a); });
  std::vector<Parcel> out;
  shared.copy_out(zones(), shared.has_springs() ? exchange_wanted(shared) : std::vector<WantedParticles>(), out);
  std::vector<Communicator::Route> to, from;
  const std::size_t bytes = shared.packed_bytes();
  out_.resize(shared.copied_count() * bytes);
  std::size_t at = 0;
  for (const Parcel& parcel : out) {
    const std::size_t length = parcel.bytes.size() / shared.copy_bytes() * bytes;
    to.push_back({parcel.rank, std::span(out_).subspan(at, length)});
    at += length;
  }
  const std::vector<Parcel> in = exchange(std::move(out));
  shared.take_ghosts(in);
  in_.resize(shared.ghost_count() * bytes);
  at = 0;
  for (const Parcel& parcel : in) {
    const std::size_t length = parcel.bytes.size() / shared.copy_bytes() * bytes;
    from.push_back({parcel.rank, std::span(in_).subspan(at, length)});
    at += length;
  }
  channel_ = communicator_->open(to, from);
  partners_ = to.size();
  middle_ = last_middle_ = {0, 0, 0};
  ++statistics_.exchanges;
  statistics_.ghosts += shared.ghost_count();
}

// Ghosts to where their particles are now.
void Ranks::refresh(SharedParticles& shared) {
  if (stale_) return;  // new ones come
  shared.pack(out_);
  {
    const Waiting waiting(*communicator_, waited_);
    channel_->exchange();
  }
  shared.unpack(in_);
  statistics_.bytes += out_.size();
  statistics_.messages += partners_;
}

// Two particles that know nothing of each other were further apart than they can touch by a skin and a slack. They
// don't touch while no two displacements differ by that. All frames are within 0.495 slacks of a displacement that all
// ranks agree upon beforehand: where the middle of all frames is expected. Particles are within half a skin of their
// frames, or are outliers, which are looked at one by one: those that are further from that displacement than half of
// both may touch something unknown in or near another rank's box, moved by it. Two such outliers, too: boxes tile
// space, so that one of them is then in or near a box that is not its own.
Condition Ranks::decide(Backend& backend, SharedParticles& shared, const Condition& here) {
  struct Decision {
    Condition found;
    FrameDisplacements frames;
    std::int64_t excess;
    bool stale, leaving, lost;
  };
  constexpr double kNear = 0.495;  // slacks
  const Vec3d expected = 2 * middle_ - last_middle_;
  const bool stale_here = stale_ || backend.neighbours_stale();
  Decision all{here,       shared.displacements(),  shared.list_excess(),
               stale_here, shared.has_departures(), !stale_here && shared.has_lost_outlier(zones(), expected)};
  combine(all, [](const Decision& a, Decision& sum) {
    sum.found = Condition::first(sum.found, a.found);
    for (int k = 0; k < 6; ++k) sum.frames.most[k] = std::max(sum.frames.most[k], a.frames.most[k]);
    sum.excess += a.excess;
    sum.stale = sum.stale || a.stale;
    sum.leaving = sum.leaving || a.leaving;
    sum.lost = sum.lost || a.lost;
  });
  last_middle_ = middle_;
  middle_ = all.frames.middle();
  const bool together = all.frames.furthest_from(expected) < kNear * width_.slack;
  stale_ = all.stale || all.lost || all.excess > 0 || !together;
  // What leaves takes along the energy of its contacts, which only a good list tells.
  if (stale_ && all.leaving) {
    build_neighbours(backend);
    shared.find_departures();
  }
  return all.found;
}

// Population
// -----------------------------------------------------------------------------------------------------------

// What is removed takes along the energy of its contacts, which only a good list tells. A list that is not good is due
// in any case; what is wrong with it the next step reports.
RemovalSums Ranks::remove_sunk(Backend& backend) {
  if (!is_serial() && stale_) build_neighbours(backend);
  return backend.remove_sunk();
}

Removal Ranks::remove(Backend& backend, std::span<const std::uint64_t> ids) {
  if (is_serial() || ids.empty()) return backend.remove(ids);
  if (stale_) build_neighbours(backend);
  Removal removal = backend.remove(ids);
  combine(std::span(removal.was_there), [](const std::uint8_t& a, std::uint8_t& sum) { sum = std::max(sum, a); });
  return removal;
}

// Every rank keeps its particles and its box, and learns which ids there still are.
void Ranks::forget_removed_ids(Backend& backend, const Scene& scene) {
  ParticleSet own;
  download(backend, scene.integrator, own);
  std::vector<std::uint64_t> ids = own.id;
  for (const Parcel& parcel : exchange(to_all_others(*communicator_, own.id))) {
    const std::vector<std::uint64_t> theirs = values_of<std::uint64_t>(parcel.bytes);
    ids.insert(ids.end(), theirs.begin(), theirs.end());
  }
  std::sort(ids.begin(), ids.end());
  std::vector<IdRun> runs;
  append_ids(runs, ids);
  backend.shared()->assign_part(own, runs);
  channel_ = nullptr;
  stale_ = true;
}

RemovalSums Ranks::insert(Backend& backend, const Scene& scene, const ParticleSet& newborn) {
  if (is_serial()) return backend.insert(newborn);
  if (newborn.empty()) return {};
  SharedParticles& shared = *backend.shared();
  std::uint64_t count = shared.own_count();
  sum(count);
  // Ids of removed particles stay in the tables until these are mostly theirs.
  if (shared.id_count() + newborn.size() > 4 * count + 65536) forget_removed_ids(backend, scene);
  RemovalSums born = shared.insert_part(newborn, space_, communicator_->rank());
  const auto touches = [&](std::uint16_t m) { return scene.materials[m].interacts || shared.wants_all(); };
  if (std::none_of(newborn.material.begin(), newborn.material.end(), touches)) {
    bool lost = backend.neighbours_stale();  // particles had to move to make room
    combine(lost, [](const bool& a, bool& sum) { sum = sum || a; });
    stale_ = stale_ || lost;
    return born;
  }
  stale_ = true;
  if (!shared.has_cohesion()) return born;
  // Newborn particles overlap no other, but cohesion may reach them.
  if (build_neighbours(backend).good()) shared.add_elastic_of(newborn.id, born.elastic);
  return born;
}

void Ranks::find_inside(const Backend& backend, const Box3d& box, std::vector<Occupant>& out) {
  backend.find_inside(box, out);
  if (is_serial()) return;
  for (const Parcel& parcel : exchange(to_all_others(*communicator_, out))) {
    const std::vector<Occupant> theirs = values_of<Occupant>(parcel.bytes);
    out.insert(out.end(), theirs.begin(), theirs.end());
  }
}

RankCosts Ranks::costs(std::uint64_t particles) {
  if (!is_serial()) end_interval(particles);
  RankCosts costs;
  const auto figure = [](auto here) { return RankFigure{static_cast<double>(here), static_cast<double>(here)}; };
  const double processor = processor_seconds();
  costs.processor = figure(processor - statistics_.processor_before);
  costs.waiting = figure(waited_ - statistics_.waited_before);
  costs.ghosts = figure(statistics_.ghosts);
  costs.messages = figure(statistics_.messages);
  costs.bytes = figure(statistics_.bytes);
  costs.particles = figure(particles);
  costs.peak_bytes = figure(peak_resident_bytes());
  costs.exchanges = statistics_.exchanges;
  costs.cuts = statistics_.cuts;
  if (statistics_.steps > 0) {
    costs.uneven_particles = statistics_.uneven_particles / statistics_.steps;
    costs.uneven_time = statistics_.uneven_time / statistics_.steps;
  }
  statistics_ = {};
  statistics_.processor_before = processor;
  statistics_.waited_before = waited_;
  if (is_serial()) return costs;
  combine(costs, [](const RankCosts& a, RankCosts& sum) {
    sum.ranks += a.ranks;
    for (RankFigure RankCosts::* of :
         {&RankCosts::processor, &RankCosts::waiting, &RankCosts::ghosts, &RankCosts::messages, &RankCosts::bytes,
          &RankCosts::particles, &RankCosts::peak_bytes}) {
      (sum.*of).sum += (a.*of).sum;
      (sum.*of).most = std::max((sum.*of).most, (a.*of).most);
    }
  });
  return costs;
}

void Ranks::sum(LedgerSums& sums) {
  if (is_serial()) return;
  combine(sums, [](const LedgerSums& a, LedgerSums& sum) { sum.add(a); });
}

void Ranks::sum(MeasurementSums& sums) {
  if (is_serial()) return;
  std::vector<Parcel> out;
  if (!leads()) sums.write(out.emplace_back(Parcel{kLeader, {}}).bytes);
  for (const Parcel& parcel : exchange(std::move(out))) sums.add(parcel.bytes);
}

void Ranks::sum(std::uint64_t& count) {
  if (is_serial()) return;
  combine(count, [](const std::uint64_t& a, std::uint64_t& sum) { sum += a; });
}

void Ranks::unite(std::vector<std::uint64_t>& broken_springs) {
  if (is_serial()) return;
  std::vector<Parcel> out;
  if (!leads()) append_bytes(out.emplace_back(Parcel{kLeader, {}}).bytes, broken_springs.data(), broken_springs.size());
  for (const Parcel& parcel : exchange(std::move(out))) {
    const std::vector<std::uint64_t> theirs = values_of<std::uint64_t>(parcel.bytes);
    broken_springs.insert(broken_springs.end(), theirs.begin(), theirs.end());
  }
  std::sort(broken_springs.begin(), broken_springs.end());
  broken_springs.erase(std::unique(broken_springs.begin(), broken_springs.end()), broken_springs.end());
}

void Ranks::sum(SlicesHeader& header) {
  if (is_serial()) return;
  combine(header, [](const SlicesHeader& a, SlicesHeader& sum) {
    sum.count += a.count;
    sum.identity += a.identity;
    sum.accelerated = sum.accelerated || a.accelerated;
  });
}

void Ranks::gather(ParticleSet& particles) {
  if (is_serial()) return;
  std::vector<Parcel> out;
  if (!leads()) {
    append_particles(out.emplace_back(Parcel{kLeader, {}}).bytes, ParticleSlice(particles, 0, particles.size()));
    particles.clear();
  }
  for (const Parcel& parcel : exchange(std::move(out))) take_particles(parcel.bytes, particles);
  particles.sort_by_id();
}

// The ids at which slices of so many of all ranks' particles start, and one that is above all. Found by bisection: how
// many ids are below a number, all ranks know together.
std::vector<std::uint64_t> Ranks::slice_starts(std::span<const std::uint64_t> own_ids, std::size_t rows) {
  const auto below = [&](std::uint64_t id) {
    return static_cast<std::uint64_t>(std::lower_bound(own_ids.begin(), own_ids.end(), id) - own_ids.begin());
  };
  struct Ids {
    std::uint64_t count, end;  // how many; above all of them
  };
  Ids all{own_ids.size(), own_ids.empty() ? 0 : own_ids.back() + 1};
  combine(all, [](const Ids& a, Ids& sum) { sum = {sum.count + a.count, std::max(sum.end, a.end)}; });
  const auto slices = static_cast<std::size_t>((all.count + rows - 1) / rows);
  std::vector<std::uint64_t> starts(slices, 0), least(slices, 0), most(slices, all.end), counts(slices);
  for (std::uint64_t width = all.end; width > 0; width /= 2) {
    for (std::size_t k = 0; k < slices; ++k) counts[k] = below(least[k] + (most[k] - least[k]) / 2);
    combine(std::span(counts), [](const std::uint64_t& a, std::uint64_t& sum) { sum += a; });
    for (std::size_t k = 0; k < slices; ++k) {
      const std::uint64_t middle = least[k] + (most[k] - least[k]) / 2;
      if (least[k] == most[k]) continue;
      if (counts[k] >= k * rows) {
        most[k] = middle;
      } else {
        least[k] = middle + 1;
      }
    }
  }
  starts = std::move(most);
  starts.push_back(all.end);
  return starts;
}

void Ranks::visit(const ParticleSet& own, std::size_t rows, const ParticleSlices::Take& take) {
  const std::vector<std::uint64_t> starts = slice_starts(own.id, rows);
  const auto first_from = [&](std::uint64_t id) {
    return static_cast<std::size_t>(std::lower_bound(own.id.begin(), own.id.end(), id) - own.id.begin());
  };
  ParticleSet slice;
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    const std::size_t first = first_from(starts[k]);
    const ParticleSlice here(own, first, first_from(starts[k + 1]) - first);
    std::vector<std::byte> bytes;
    append_particles(bytes, here);
    std::vector<Parcel> out;
    if (!leads()) out.push_back({kLeader, std::move(bytes)});
    const std::vector<Parcel> in = exchange(std::move(out));
    if (!leads()) continue;
    slice.clear();
    take_particles(bytes, slice);
    for (const Parcel& parcel : in) take_particles(parcel.bytes, slice);
    slice.sort_by_id();
    take(ParticleSlice(slice, 0, slice.size()));
  }
}

}  // namespace hooke
