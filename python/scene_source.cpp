// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "scene_source.h"

#include <fmt/format.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>

#include "hooke/base/printable.h"

namespace hooke::python {
namespace {

// JSON of a Python value, numpy's numbers and arrays included.
std::string json_text(const py::handle& value) {
  return py::module_::import("hooke._json").attr("dumps")(value).cast<std::string>();
}

scene::LoadOptions load_options(const SceneOptions& options) {
  scene::LoadOptions load;
  for (const auto& [path, value] : options.set) {
    if (!py::isinstance<py::str>(path)) raise_input("set", "its keys must be paths like \"time.step\"");
    load.overrides.push_back(path.cast<std::string>() + "=" + json_text(value));
  }
  load.allow_outside = options.allow_outside;
  load.with_particles = !options.resume;
  return load;
}

std::size_t material_index(const py::handle& value, const std::vector<std::string>& names) {
  if (py::isinstance<py::str>(value)) {
    const auto name = value.cast<std::string>();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    std::string known;
    for (const std::string& each : names) known += fmt::format("{}\"{}\"", known.empty() ? "" : ", ", printable(each));
    raise_input("material", fmt::format("there is no \"{}\"; there are {}", printable(name), known));
  }
  if (PyIndex_Check(value.ptr()) != 0 && !py::isinstance<py::bool_>(value)) {
    const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    const long long index = whole ? PyLong_AsLongLong(whole.ptr()) : -1;
    if (PyErr_Occurred() == nullptr && index >= 0 && static_cast<std::size_t>(index) < names.size()) {
      return static_cast<std::size_t>(index);
    }
    PyErr_Clear();
    raise_input("material",
                fmt::format("{} is no index of the {} materials", py::str(value).cast<std::string>(), names.size()));
  }
  raise_input("material", fmt::format("expected a name or an index, got {}", Py_TYPE(value.ptr())->tp_name));
}

}  // namespace

scene::LoadedScene read_scene(const std::filesystem::path& file, const SceneOptions& options) {
  const scene::LoadOptions load = load_options(options);
  Expected<scene::LoadedScene> loaded;
  {
    const py::gil_scoped_release free;
    loaded = scene::load_scene(file, load);
  }
  return unwrap(std::move(loaded), ErrorClass::scene);
}

scene::LoadedScene read_scene(const py::dict& scene, const std::filesystem::path& folder, const SceneOptions& options) {
  const std::string text = json_text(scene);
  const scene::LoadOptions load = load_options(options);
  Expected<scene::LoadedScene> loaded;
  {
    const py::gil_scoped_release free;
    loaded = scene::parse_scene(text, "scene", folder, load);
  }
  return unwrap(std::move(loaded), ErrorClass::scene);
}

std::vector<std::string> material_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) names.push_back(material.name);
  return names;
}

std::vector<std::size_t> to_materials(const py::object& material, std::size_t count,
                                      const std::vector<std::string>& names) {
  if (material.is_none()) {
    if (names.size() == 1) return std::vector<std::size_t>(count, 0);
    raise_input("material", fmt::format("must be given: the scene has {} materials", names.size()));
  }
  // Every array of numpy has an index's method, but only one without dimensions is one.
  const bool is_array = py::isinstance<py::array>(material);
  const bool is_list = is_array && py::reinterpret_borrow<py::array>(material).ndim() > 0;
  if (!is_list && (is_array || py::isinstance<py::str>(material) || PyIndex_Check(material.ptr()) != 0)) {
    return std::vector<std::size_t>(count, material_index(material, names));
  }
  if (!is_list && !py::isinstance<py::sequence>(material)) material_index(material, names);  // raises
  std::vector<std::size_t> indices;
  const py::tuple values(material);  // keeps what an array makes of its numbers
  for (const py::handle value : values) {
    indices.push_back(material_index(value, names));
  }
  if (indices.size() != count) {
    raise_input("material", fmt::format("{} materials for {} particles", indices.size(), count));
  }
  return indices;
}

void add_particles(scene::LoadedScene& scene, const ParticleArrays& arrays) {
  const std::vector<Vec3d> x = to_vectors(arrays.positions, "x");
  const std::size_t count = x.size();
  const std::vector<Vec3d> v = arrays.velocities.is_none() ? std::vector<Vec3d>(count, Vec3d{0, 0, 0})
                                                           : to_vectors(arrays.velocities, count, "v");
  const std::vector<std::size_t> materials = to_materials(arrays.material, count, material_names(scene.scene));
  ParticleSet& particles = scene.particles;
  std::vector<std::uint64_t> ids;
  if (!arrays.ids.is_none()) {
    ids = to_ids(arrays.ids, "id");
    if (ids.size() != count) raise_input("id", fmt::format("{} ids for {} particles", ids.size(), count));
  } else {
    const std::uint64_t next = particles.empty() ? 1 : particles.id.back() + 1;
    for (std::size_t i = 0; i < count; ++i) ids.push_back(next + i);
  }
  for (std::size_t i = 0; i < count; ++i) {
    particles.id.push_back(ids[i]);
    particles.material.push_back(static_cast<std::uint16_t>(materials[i]));
    particles.position.push_back(x[i]);
    particles.velocity.push_back(v[i]);
  }
  particles.sort_by_id();
}

py::object parse_json(const std::string& text) { return py::module_::import("json").attr("loads")(text); }

}  // namespace hooke::python
