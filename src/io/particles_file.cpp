// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/particles_file.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"
#include "hooke/io/checksum.h"
#include "hooke/io/failure.h"
#include "hooke/io/hdf5.h"
#include "hooke/io/run_info_json.h"
#include "hooke/io/slices.h"
#include "hooke/io/vtkhdf_columns.h"

namespace hooke::io {

namespace {

constexpr std::int64_t kFormat = 2;

/// Row `row` of a column of whole numbers; its first component if it has several.
std::int64_t at(const hdf5::Column& column, hsize_t row) {
  std::int64_t values[4] = {};
  column.read(row, 1, hdf5::memory_type<std::int64_t>(), values);
  return values[0];
}

/// Cuts a column; throws Failure where it has fewer rows, which only a damaged file has.
void cut_to(hdf5::Column& column, hsize_t rows) {
  if (rows > column.rows()) column.fail("a table is shorter than another one says");
  column.resize(rows);
}

void put(hdf5::Column& column, std::int64_t value) { column.append(std::vector<std::int64_t>{value}); }

/// Appends rows of whole numbers from the next chunk on.
void append_rows(hdf5::Column& column, hsize_t count, hid_t type, const void* data) {
  const hsize_t start = column.next_chunk(column.rows());
  column.resize(column.next_chunk(start + count));
  column.write(start, count, type, data);
}

/// The row from which the next ones will be appended.
std::int64_t next_row(const hdf5::Column& column) {
  return static_cast<std::int64_t>(column.next_chunk(column.rows()));
}

/// Appends numbers in the precision of the run; `values` are `count` rows.
template <class Real>
void append_reals(hdf5::Column& column, hsize_t count, std::span<const double> values) {
  std::vector<Real> converted(values.size());
  std::transform(values.begin(), values.end(), converted.begin(), [](double x) { return static_cast<Real>(x); });
  column.append_chunks(converted.data(), count);
}

void append_reals(hdf5::Column& column, hsize_t count, std::span<const double> values, Precision precision) {
  if (precision == Precision::single_precision) {
    append_reals<float>(column, count, values);
  } else {
    append_reals<double>(column, count, values);
  }
}

void append_vectors(hdf5::Column& column, std::span<const Vec3d> values, Precision precision) {
  append_reals(column, values.size(), {components(values), 3 * values.size()}, precision);
}

/// Appends `count` rows of whole numbers that count up from `first`, no more than a slice of them at a time.
void append_counting(hdf5::Column& column, std::int64_t first, std::int64_t count) {
  std::vector<std::int64_t> numbers;
  for (std::int64_t done = 0; done < count; done += static_cast<std::int64_t>(numbers.size())) {
    numbers.resize(std::min(kSliceRows, static_cast<std::size_t>(count - done)));
    std::iota(numbers.begin(), numbers.end(), first + done);
    column.append(numbers);
  }
}

std::size_t count_snapshots(hid_t file) {
  if (!hdf5::exists(file, kVtkGroup)) return 0;
  const hdf5::Handle vtk = hdf5::open_group(file, kVtkGroup);
  if (!hdf5::exists(vtk.get(), "Steps")) return 0;  // before the first snapshot
  const hdf5::Handle steps = hdf5::open_group(vtk.get(), "Steps");
  return static_cast<std::size_t>(std::max<std::int64_t>(hdf5::read_integer_attribute(steps.get(), "NSteps"), 0));
}

void write_info(hid_t group, const RunInfo& info) {
  const std::string text = to_json(info);
  hdf5::write_text(group, "run", text);
  hdf5::set_integer_attribute(group, "run_checksum", static_cast<std::int64_t>(checksum(text)));
}

RunInfo read_info(hid_t file, const std::filesystem::path& path) {
  if (!hdf5::exists(file, kHookeGroup) || !hdf5::exists(file, kVtkGroup)) {
    throw Failure(Error::Kind::bad_input, path, "is an HDF5 file, but holds no run of Hooke's");
  }
  const hdf5::Handle group = hdf5::open_group(file, kHookeGroup);
  const std::int64_t format = hdf5::read_integer_attribute(group.get(), "format");
  if (format != kFormat) {
    throw Failure(Error::Kind::bad_input, path,
                  "is of format " + std::to_string(format) + "; this program reads format " + std::to_string(kFormat));
  }
  const std::string text = hdf5::read_text(group.get(), "run");
  if (hdf5::read_integer_attribute(group.get(), "run_checksum") != static_cast<std::int64_t>(checksum(text))) {
    throw Failure(Error::Kind::bad_input, path, "is damaged: the description of its run is not what was written");
  }
  return parse_run_info(text, path);
}

/// Where a snapshot's rows begin in each table, and how many there are.
struct SnapshotRows {
  std::size_t index;
  std::int64_t step;
  double time = 0;
  hsize_t count, id, material, points, velocity;

  SnapshotRows(const VtkhdfColumns& columns, std::size_t snapshot) : index(snapshot), step(at(columns.step, snapshot)) {
    columns.values.read(index, 1, hdf5::memory_type<double>(), &time);
    const auto row = [&](const hdf5::Column& offsets) { return static_cast<hsize_t>(at(offsets, index)); };
    count = static_cast<hsize_t>(at(columns.number_of_points, row(columns.part_offsets)));
    // A damaged count must not make us allocate more memory than the rows could fill.
    if (count > columns.points.rows()) columns.points.fail("a snapshot is longer than its table");
    id = row(columns.id_offsets);
    material = row(columns.material_offsets);
    points = row(columns.point_offsets);
    velocity = row(columns.velocity_offsets);
  }
};

/// Reads `rows` of a snapshot's particles from its particle `first` on.
void read_slice(const VtkhdfColumns& columns, const SnapshotRows& of, hsize_t first, hsize_t rows, ParticleSet& p) {
  p.resize(rows);
  p.acceleration.clear();
  columns.id.read(of.id + first, rows, hdf5::memory_type<std::int64_t>(), p.id.data());
  columns.material.read(of.material + first, rows, hdf5::memory_type<std::uint16_t>(), p.material.data());
  columns.points.read(of.points + first, rows, hdf5::memory_type<double>(), p.position.data());
  columns.velocity.read(of.velocity + first, rows, hdf5::memory_type<double>(), p.velocity.data());
}

void check_sum(const VtkhdfColumns& columns, const SnapshotRows& of, const SnapshotChecksum& sum) {
  if (at(columns.checksum, of.index) == static_cast<std::int64_t>(sum.value())) return;
  columns.checksum.fail("snapshot " + std::to_string(of.index) + " is not what was written");
}

Snapshot read_snapshot(const VtkhdfColumns& columns, std::size_t index, Precision precision) {
  const SnapshotRows rows(columns, index);
  Snapshot snapshot{rows.step, rows.time, {}};
  read_slice(columns, rows, 0, rows.count, snapshot.particles);
  SnapshotChecksum sum(rows.step, rows.time, rows.count, precision);
  sum.add(ParticleSlice(snapshot.particles, 0, rows.count));
  check_sum(columns, rows, sum);
  return snapshot;
}

/// Reads a snapshot to see whether it is sound; returns ParticleSlices::identity() of it.
std::uint64_t identity_of(const VtkhdfColumns& columns, const SnapshotRows& rows, Precision precision) {
  std::uint64_t identity = 0;
  SnapshotChecksum sum(rows.step, rows.time, rows.count, precision);
  ParticleSet p;
  for (hsize_t first = 0; first < rows.count; first += kSliceRows) {
    read_slice(columns, rows, first, std::min<hsize_t>(kSliceRows, rows.count - first), p);
    const ParticleSlice slice(p, 0, p.size());
    identity += slice.identity();
    sum.add(slice);
  }
  check_sum(columns, rows, sum);
  return identity;
}

}  // namespace

struct ParticlesFile::Columns : VtkhdfColumns {
  explicit Columns(VtkhdfColumns columns) : VtkhdfColumns(std::move(columns)) {}

  // Of the last snapshot: data that the next one may refer to.
  std::uint64_t last_count = 0, last_identity = 0;  // of its particles; ParticleSlices::identity()
  std::int64_t last_id_offset = 0, last_material_offset = 0, last_radius_offset = 0;
  std::int64_t part = -1;        // -1: none yet
  std::int64_t cell_offset = 0;  // its first vertex

  /// How many particles are appended at a time: whole chunks, so that none is written twice.
  std::size_t slice_rows() const;
  void choose_part(std::int64_t particles);
  void append_identity(const ParticleSlice& particles, const RunInfo& info);
};

std::size_t ParticlesFile::Columns::slice_rows() const {
  const hsize_t chunk = points.chunk_rows();
  for (const hdf5::Column* column : {&velocity, &id, &material, &radius}) {
    if (column->chunk_rows() != chunk) column->fail("its chunks are not as long as those of the points");
  }
  return chunk * std::max<hsize_t>(1, kSliceRows / chunk);
}

// Selects the list of vertices for this many particles: the last one, or a new one.
void ParticlesFile::Columns::choose_part(std::int64_t particles) {
  const std::int64_t before = part < 0 ? 0 : at(number_of_points, static_cast<hsize_t>(part));
  if (part >= 0 && before == particles) return;
  cell_offset += before;
  part = static_cast<std::int64_t>(number_of_points.rows());
  put(number_of_points, particles);
  for (VtkTopology& topology : topologies) {
    const bool vertices = &topology == &topologies.front();
    const std::int64_t cells = vertices ? particles : 0;
    put(topology.number_of_cells, cells);
    put(topology.number_of_connectivity_ids, cells);
    append_counting(topology.offsets, 0, cells + 1);
    // Vertex i is particle i in every part, so one list, as long as the longest part, serves all.
    const auto listed = static_cast<std::int64_t>(topology.connectivity.rows());
    if (listed < cells) append_counting(topology.connectivity, listed, cells - listed);
  }
}

void ParticlesFile::Columns::append_identity(const ParticleSlice& p, const RunInfo& info) {
  std::vector<double> radii(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) radii[i] = info.materials.at(p.material[i]).radius;
  append_rows(id, p.size(), hdf5::memory_type<std::int64_t>(), p.id.data());
  append_rows(material, p.size(), hdf5::memory_type<std::uint16_t>(), p.material.data());
  append_reals(radius, p.size(), radii, info.precision);
}

ParticlesFile::ParticlesFile(hdf5::File file, const RunInfo& info)
    : info_(info),
      file_(std::make_unique<hdf5::File>(std::move(file))) {}

ParticlesFile::~ParticlesFile() {
  const auto held = hdf5::lock();
  columns_.reset();
  file_.reset();
}

ParticlesFile::ParticlesFile(ParticlesFile&&) noexcept = default;
ParticlesFile& ParticlesFile::operator=(ParticlesFile&&) noexcept = default;

ParticlesFile ParticlesFile::create(const std::filesystem::path& path, const RunInfo& info) {
  const std::filesystem::path unfinished = unfinished_name(path);
  ParticlesFile created(hdf5::File(unfinished, JournaledFile::Mode::create), info);
  const hid_t root = created.file_->id();
  const hdf5::Handle vtk = hdf5::create_group(root, kVtkGroup);
  hdf5::write_integer_attribute(vtk.get(), "Version", {2, 0});
  hdf5::write_text_attribute(vtk.get(), "Type", "PolyData");
  const hdf5::Handle hooke = hdf5::create_group(root, kHookeGroup);
  hdf5::write_integer_attribute(hooke.get(), "format", {kFormat}, true);
  hdf5::write_integer_attribute(hooke.get(), "run_checksum", {0}, true);
  write_info(hooke.get(), info);
  created.file_->commit();
  publish(path);
  created.file_->bytes().set_path(path);
  return created;
}

ParticlesFile ParticlesFile::update(const std::filesystem::path& path, const RunInfo& info, std::int64_t end_step) {
  ParticlesFile opened(hdf5::File(path, JournaledFile::Mode::update), info);
  const hid_t root = opened.file_->id();
  const RunInfo before = read_info(root, path);
  if (before.precision != info.precision || before.materials.size() != info.materials.size()) {
    throw Failure(Error::Kind::bad_input, path, "is of another run: its precision or its materials differ");
  }
  const hdf5::Handle hooke = hdf5::open_group(root, kHookeGroup);
  if (before != info) {
    hdf5::remove(hooke.get(), "run");
    write_info(hooke.get(), info);
  }
  if (const std::size_t snapshots = count_snapshots(root)) {
    opened.columns_ = std::make_unique<Columns>(VtkhdfColumns::open(root));
    std::size_t kept = 0;
    while (kept < snapshots && at(opened.columns_->step, kept) < end_step) ++kept;
    opened.cut(kept);
  }
  opened.file_->check_reads();  // before anything is cut for good
  opened.file_->commit();
  return opened;
}

void ParticlesFile::cut(std::size_t snapshots) {
  Columns& c = *columns_;
  const hdf5::Handle steps = hdf5::open_group(file_->id(), "VTKHDF/Steps");
  hdf5::set_integer_attribute(steps.get(), "NSteps", static_cast<std::int64_t>(snapshots));
  for (hdf5::Column* column :
       {&c.values, &c.part_offsets, &c.number_of_parts, &c.point_offsets, &c.cell_offsets, &c.connectivity_offsets,
        &c.velocity_offsets, &c.id_offsets, &c.material_offsets, &c.radius_offsets, &c.step, &c.checksum}) {
    cut_to(*column, snapshots);
  }
  hsize_t particles = 0;
  if (snapshots > 0) {
    const SnapshotRows last(c, snapshots - 1);
    particles = last.count;
    last_step_ = last.step;
    c.last_count = last.count;
    c.last_identity = identity_of(c, last, info_.precision);
    c.last_id_offset = at(c.id_offsets, snapshots - 1);
    c.last_material_offset = at(c.material_offsets, snapshots - 1);
    c.last_radius_offset = at(c.radius_offsets, snapshots - 1);
    c.part = at(c.part_offsets, snapshots - 1);
    c.cell_offset = at(c.cell_offsets, snapshots - 1);
  }
  // Offsets never decrease, so no rows beyond the last snapshot's are needed.
  const auto end_of = [&](const hdf5::Column& column, const hdf5::Column& offsets) {
    if (snapshots == 0) return hsize_t{0};
    const auto start = static_cast<hsize_t>(at(offsets, snapshots - 1));
    if (start > column.rows()) column.fail("a snapshot begins behind its table");
    return column.next_chunk(start + particles);
  };
  cut_to(c.points, end_of(c.points, c.point_offsets));
  cut_to(c.velocity, end_of(c.velocity, c.velocity_offsets));
  cut_to(c.id, end_of(c.id, c.id_offsets));
  cut_to(c.material, end_of(c.material, c.material_offsets));
  cut_to(c.radius, end_of(c.radius, c.radius_offsets));
  const auto parts = static_cast<hsize_t>(c.part) + 1;
  cut_to(c.number_of_points, parts);
  for (VtkTopology& topology : c.topologies) {
    const bool vertices = &topology == &c.topologies.front();
    cut_to(topology.number_of_cells, parts);
    cut_to(topology.number_of_connectivity_ids, parts);
    cut_to(topology.offsets, vertices && parts > 0 ? static_cast<hsize_t>(c.cell_offset) + particles + parts : parts);
  }
}

void ParticlesFile::append(std::int64_t step, double time, const ParticleSlices& particles) {
  HOOKE_ASSERT(!last_step_ || step > *last_step_, step, *last_step_);
  try {
    write_snapshot(step, time, particles);
    file_->commit();
    last_step_ = step;
  } catch (const std::exception&) {
    file_->bytes().trim();
    // HDF5 may have failed over bytes missing on the disk; then report the disk's error.
    file_->check_writes();
    throw;
  }
}

void ParticlesFile::write_snapshot(std::int64_t step, double time, const ParticleSlices& particles) {
  const std::uint64_t n = particles.size();
  if (!columns_) {
    columns_ = std::make_unique<Columns>(VtkhdfColumns::create(file_->id(), n, info_.precision));
  }
  Columns& c = *columns_;
  c.choose_part(static_cast<std::int64_t>(n));
  const std::uint64_t identity = particles.identity();
  const bool are_new = c.step.rows() == 0 || n != c.last_count || identity != c.last_identity;
  if (are_new) {
    c.last_id_offset = next_row(c.id);
    c.last_material_offset = next_row(c.material);
    c.last_radius_offset = next_row(c.radius);
    c.last_count = n;
    c.last_identity = identity;
  }
  const std::int64_t point_offset = next_row(c.points), velocity_offset = next_row(c.velocity);
  SnapshotChecksum checksum(step, time, n, info_.precision);
  visit_slices(particles, c.slice_rows(), [&](const ParticleSlice& p) {
    if (are_new) c.append_identity(p, info_);
    append_vectors(c.points, p.position, info_.precision);
    append_vectors(c.velocity, p.velocity, info_.precision);
    checksum.add(p);
  });

  c.values.append(std::vector<double>{time});
  put(c.part_offsets, c.part);
  put(c.number_of_parts, 1);
  put(c.point_offsets, point_offset);
  c.cell_offsets.append(std::vector<std::int64_t>{c.cell_offset, 0, 0, 0});
  c.connectivity_offsets.append(std::vector<std::int64_t>{0, 0, 0, 0});
  put(c.velocity_offsets, velocity_offset);
  put(c.id_offsets, c.last_id_offset);
  put(c.material_offsets, c.last_material_offset);
  put(c.radius_offsets, c.last_radius_offset);
  put(c.step, step);
  put(c.checksum, static_cast<std::int64_t>(checksum.value()));
  const hdf5::Handle steps = hdf5::open_group(file_->id(), "VTKHDF/Steps");
  hdf5::set_integer_attribute(steps.get(), "NSteps", static_cast<std::int64_t>(c.step.rows()));
}

void ParticlesFile::sync() const { file_->bytes().sync(); }

ParticlesContents read_particles_contents(const std::filesystem::path& path) {
  const hdf5::File file(path, JournaledFile::Mode::read);
  ParticlesContents contents;
  contents.info = read_info(file.id(), path);
  const std::size_t n = count_snapshots(file.id());
  file.check_reads();
  if (n == 0) return contents;
  const VtkhdfColumns columns = VtkhdfColumns::open(file.id());
  contents.steps = columns.step.read_all<std::int64_t>();
  contents.times = columns.values.read_all<double>();
  const auto parts = columns.part_offsets.read_all<std::int64_t>();
  const auto counts = columns.number_of_points.read_all<std::int64_t>();
  if (contents.steps.size() != n || contents.times.size() != n || parts.size() != n) {
    throw Failure(Error::Kind::bad_input, path, "is damaged: its tables of steps differ in length");
  }
  if (!is_ascending(contents.steps) || !std::is_sorted(contents.times.begin(), contents.times.end())) {
    throw Failure(Error::Kind::bad_input, path, "is damaged: its snapshots are out of order");
  }
  for (const std::int64_t part : parts) {
    if (part < 0 || static_cast<std::size_t>(part) >= counts.size() || counts[static_cast<std::size_t>(part)] < 0) {
      throw Failure(Error::Kind::bad_input, path, "is damaged: a snapshot has no particle count");
    }
    contents.particles.push_back(static_cast<std::uint64_t>(counts[static_cast<std::size_t>(part)]));
  }
  file.check_reads();
  return contents;
}

Snapshot read_particles(const std::filesystem::path& path, std::size_t index) {
  const hdf5::File file(path, JournaledFile::Mode::read);
  const RunInfo info = read_info(file.id(), path);
  if (index >= count_snapshots(file.id())) {
    throw Failure(Error::Kind::bad_input, path, "has no snapshot " + std::to_string(index));
  }
  Snapshot snapshot = read_snapshot(VtkhdfColumns::open(file.id()), index, info.precision);
  const auto is_lost = [](const Vec3d& x) { return !std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z); };
  const std::vector<Vec3d>& position = snapshot.particles.position;
  if (!is_ascending(snapshot.particles.id) || std::any_of(position.begin(), position.end(), is_lost)) {
    throw Failure(Error::Kind::bad_input, path,
                  "is damaged: ids do not ascend, or a particle is at no finite position");
  }
  for (const std::uint16_t material : snapshot.particles.material) {
    if (material >= info.materials.size()) {
      throw Failure(Error::Kind::bad_input, path, "is damaged: a particle is of a material that the run does not have");
    }
  }
  file.check_reads();
  return snapshot;
}

}  // namespace hooke::io
