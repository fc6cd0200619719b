// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Contacts of a snapshot, found by core/contacts.h. CSV: one row per contact. VTK: a line from centre to centre, or
// from a centre to the wall or the collider, with the contact's quantities.
#include <fmt/format.h>

#include <algorithm>

#include "hooke/core/contacts.h"
#include "hooke/io/checkpoint.h"
#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/polydata_file.h"
#include "hooke/io/write_rows.h"

namespace hooke::io {

namespace {

namespace fs = std::filesystem;

/// The scene of the job's run.
const Scene& scene_of(const ExportJob& job) {
  if (!job.options.scene) {
    throw Failure(Error::Kind::bad_input, job.file, "contacts follow from the law: the run's scene is needed for them");
  }
  const Scene& scene = *job.options.scene;
  if (describe_run(scene, job.run.info().precision).materials != job.run.info().materials) {
    throw Failure(Error::Kind::bad_input, job.run.file(), "has other materials than the scene that is given for it");
  }
  return scene;
}

/// The broken springs of the run, from its checkpoint; needed only if some springs keep particles from touching.
std::vector<std::uint64_t> broken_springs(const ExportJob& job, const Scene& scene) {
  if (!scene.structure || scene.structure->springs.empty()) return {};
  const std::vector<std::uint8_t>& contact = scene.structure->springs.contact;
  if (std::find(contact.begin(), contact.end(), 0) == contact.end()) return {};
  return take(read_checkpoint(job.run.file().parent_path())).state.broken_springs;
}

template <class Real>
void append_row(std::string& text, const std::string& instant, const Contact& c, const Scene& scene,
                const ParticleSet& particles) {
  text += instant;
  append_number(text, particles.id[c.a]);
  text += ',';
  if (c.b == Contact::kCollider) {
    text += csv_field("collider:" + scene.colliders[c.collider].name);
  } else if (c.face == Face::none) {
    append_number(text, particles.id[c.b]);
  } else {
    text += "wall:";
    text += to_string(c.face);
  }
  for (const std::int32_t s : c.image) {
    text += ',';
    append_number(text, std::int64_t{s});
  }
  for (const double value : {c.overlap, c.force.x, c.force.y, c.force.z}) {
    text += ',';
    append_number(text, static_cast<Real>(value));
  }
  text += '\n';
}

template <class Real>
void write_csv(const ExportJob& job, const Scene& scene) {
  const std::vector<std::uint64_t> broken = broken_springs(job, scene);
  OutputFile out(job.file);
  out.write("step,t,id_a,id_b,image_x,image_y,image_z,overlap,fx,fy,fz\n");
  for (const std::size_t index : job.indices) {
    const Snapshot snapshot = take(job.run.read(index));
    std::string instant;
    append_number(instant, snapshot.step);
    instant += ',';
    append_number(instant, snapshot.time);
    instant += ',';
    const std::vector<Contact> contacts = find_contacts(scene, snapshot.particles, {snapshot.time, broken});
    write_rows(out, contacts.size(), [&](std::string& text, std::size_t n) {
      append_row<Real>(text, instant, contacts[n], scene, snapshot.particles);
    });
  }
  out.finish();
}

/// The end of the contact's line: the centre of the touching particle b, in its image, or the nearest point of the wall
/// or of the collider.
Vec3d far_end(const Contact& c, const Scene& scene, const ParticleSet& particles) {
  if (c.b == Contact::kCollider) return c.point;
  const Domain& domain = scene.domain;
  Vec3d end = particles.position[c.face == Face::none ? c.b : c.a];
  if (c.face == Face::none) {
    for (int axis = 0; axis < 3; ++axis) {
      component(end, axis) += c.image[static_cast<std::size_t>(axis)] * domain.length(axis);
    }
  } else {
    const int face = static_cast<int>(c.face) - static_cast<int>(Face::x_min);
    component(end, face / 2) = component(face % 2 == 0 ? domain.min : domain.max, face / 2);
  }
  return end;
}

template <class Real>
void write_vtp(const Snapshot& snapshot, const Scene& scene, const std::vector<std::uint64_t>& broken,
               const fs::path& file) {
  const ParticleSet& p = snapshot.particles;
  const std::vector<Contact> contacts = find_contacts(scene, p, {snapshot.time, broken});
  std::vector<Vec3d> ends, force;
  std::vector<std::int64_t> id_a, id_b, collider;
  std::vector<std::uint8_t> face;
  std::vector<Real> overlap;
  for (const Contact& c : contacts) {
    ends.push_back(p.position[c.a]);
    ends.push_back(far_end(c, scene, p));
    force.push_back(c.force);
    id_a.push_back(static_cast<std::int64_t>(p.id[c.a]));
    const bool of_two = c.b < p.size();
    id_b.push_back(of_two ? static_cast<std::int64_t>(p.id[c.b]) : -1);
    collider.push_back(c.b == Contact::kCollider ? static_cast<std::int64_t>(c.collider) : -1);
    face.push_back(static_cast<std::uint8_t>(c.face));
    overlap.push_back(static_cast<Real>(c.overlap));
  }
  PolyDataFile out(PolyDataFile::Cells::lines, ends.size(), snapshot.time);
  out.add_cell_data("id_a", id_a);
  out.add_cell_data("id_b", id_b);
  out.add_cell_data("face", face);
  out.add_cell_data("collider", collider);
  out.add_cell_data("overlap", overlap);
  out.add_cell_data("force", flatten<Real>(force), 3);
  out.set_points(flatten<Real>(ends));
  out.write(file);
}

}  // namespace

std::vector<fs::path> export_contacts_csv(const ExportJob& job) {
  const Scene& scene = scene_of(job);
  const bool is_single = job.run.info().precision == Precision::single_precision;
  (is_single ? write_csv<float> : write_csv<double>)(job, scene);
  return {job.file};
}

std::vector<fs::path> export_contacts_vtp(const ExportJob& job) {
  const Scene& scene = scene_of(job);
  const auto write = job.run.info().precision == Precision::single_precision ? write_vtp<float> : write_vtp<double>;
  const std::vector<std::uint64_t> broken = broken_springs(job, scene);
  return export_polydata(
      job, [&](std::size_t index, const fs::path& file) { write(take(job.run.read(index)), scene, broken, file); });
}

}  // namespace hooke::io
