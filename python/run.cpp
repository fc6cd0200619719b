// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "run.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hooke/run/kept_scene.h"
#include "hooke/run/output_check.h"
#include "hooke/run/playback.h"
#include "picture_arguments.h"
#include "process_check.h"

namespace hooke::python {
namespace {

io::RunReader open_reader(const std::filesystem::path& folder) {
  refuse_fork();
  Expected<io::RunReader> reader = [&] {
    const py::gil_scoped_release free;
    return io::RunReader::open(folder);
  }();
  return unwrap(std::move(reader), ErrorClass::input);
}

io::ExportContent to_content(const std::string& name) {
  std::string names;
  for (const io::ExportContent content :
       {io::ExportContent::particles, io::ExportContent::contacts, io::ExportContent::surface,
        io::ExportContent::volume, io::ExportContent::cloths, io::ExportContent::springs}) {
    if (name == to_string(content)) return content;
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", to_string(content));
  }
  raise_input("content", fmt::format("\"{}\" is not known; known are {}", name, names));
}

}  // namespace

PythonRun::PythonRun(const std::filesystem::path& folder) : folder_(folder), reader_(open_reader(folder)) {}

std::size_t PythonRun::pick(std::optional<double> time, std::optional<std::int64_t> step,
                            std::optional<std::int64_t> index) const {
  if (reader_.size() == 0 && !index) raise_input(folder_.string(), "holds no snapshot yet");
  if (static_cast<int>(time.has_value()) + static_cast<int>(step.has_value()) + static_cast<int>(index.has_value()) >
      1) {
    raise_input("snapshot", "takes one of time, step and index");
  }
  const auto count = static_cast<std::int64_t>(reader_.size());
  if (time) {
    const double first = reader_.times().front(), last = reader_.times().back();
    const double rounding = 1e-9 * std::max(1.0, std::abs(last));
    if (!(*time >= first - rounding && *time <= last + rounding)) {
      raise_input("time", fmt::format("{} s is outside of the run, which goes from {} s to {} s", *time, first, last));
    }
    return *reader_.find_time(*time);
  }
  if (step) {
    if (const auto found = reader_.find_step(*step)) return *found;
    raise_input("step", fmt::format("there is no snapshot of step {}; they go from step {} to {}", *step,
                                    reader_.steps().front(), reader_.steps().back()));
  }
  const std::int64_t at = index.value_or(-1);
  if (at < -count || at >= count) throw py::index_error(fmt::format("snapshot {} of {}", at, count));
  return static_cast<std::size_t>(at < 0 ? at + count : at);
}

SnapshotView PythonRun::snapshot(std::size_t index) const {
  refuse_fork();
  auto snapshot = [&] {
    const py::gil_scoped_release free;
    return reader_.read(index);
  }();
  return SnapshotView(std::make_shared<const Snapshot>(unwrap(std::move(snapshot))));
}

const Scene& PythonRun::scene() {
  if (scene_) return *scene_;
  const std::filesystem::path home = std::filesystem::is_directory(folder_) ? folder_ : folder_.parent_path();
  auto loaded = [&] {
    const py::gil_scoped_release free;
    return run::load_kept_scene(home);
  }();
  Scene scene = unwrap(std::move(loaded), ErrorClass::scene).scene;
  unwrap(run::check_materials(reader_, scene));
  if (!scene_) scene_.emplace(std::move(scene));  // another thread may have read it meanwhile, and may draw it
  return *scene_;
}

py::array PythonRun::render(std::optional<double> time, std::pair<int, int> size, const std::string& color_by,
                            const std::optional<std::array<double, 2>>& range, int samples, bool legend, bool alpha) {
  refuse_fork();
  const auto arguments = to_picture_arguments(size, color_by, range, samples, legend, alpha);
  pick(time, {}, {});  // refuses a time outside
  const Scene& drawn = scene();
  auto image = [&]() -> Expected<render::Image> {
    const py::gil_scoped_release free;
    const auto first = reader_.read(0);
    if (!first) return fail(first.error());
    const double last = reader_.times().back();
    const double at = std::clamp(time.value_or(last), reader_.times().front(), last);
    run::Playback playback(reader_, drawn);
    const auto now = playback.at(at);
    if (!now) return fail(now.error());
    const bool has_camera = drawn.camera.eye && drawn.camera.target;
    const auto moments = has_camera ? std::vector<ParticleSet>{} : run::moments_of(reader_);
    if (!moments) return fail(moments.error());
    return pictures_.picture(arguments, drawn, first->particles, has_camera ? nullptr : &*moments, *now, at);
  }();
  return to_array(unwrap(std::move(image)), alpha);
}

std::vector<std::filesystem::path> PythonRun::write(const std::vector<std::size_t>& indices,
                                                    const std::filesystem::path& file, const std::string& content,
                                                    const volumes::SurfaceOptions& surface) {
  io::ExportOptions options;
  options.content = to_content(content);
  options.surface = surface;
  unwrap(run::check_output_file(file, "file"));
  if (std::filesystem::exists(folder_ / io::kSceneFile)) options.scene = &scene();
  auto files = [&] {
    const py::gil_scoped_release free;
    return io::export_run(reader_, indices, file, options);
  }();
  return unwrap(std::move(files));
}

namespace {

std::vector<std::filesystem::path> export_files(const std::filesystem::path& folder, const std::filesystem::path& file,
                                                std::optional<double> time, std::optional<std::int64_t> step, bool all,
                                                const std::string& content, double surface_radius,
                                                double surface_smoothing, double surface_resolution) {
  PythonRun run(folder);
  if (all && (time || step)) raise_input("all", "is for all snapshots, without time and step");
  std::vector<std::size_t> indices{run.pick(time, step, {})};
  if (all) {
    indices.resize(run.reader().size());
    std::iota(indices.begin(), indices.end(), std::size_t{0});
  }
  for (const auto& [name, value] : {std::pair{"surface_radius", surface_radius},
                                    {"surface_smoothing", surface_smoothing},
                                    {"surface_resolution", surface_resolution}}) {
    if (!(value >= 0.1 && value <= 10)) raise_input(name, fmt::format("{} must be 0.1 to 10", value));
  }
  if (surface_resolution > std::min(surface_radius, surface_smoothing)) {
    raise_input("surface_resolution", "must not be above surface_radius and surface_smoothing");
  }
  return run.write(indices, file, content, {surface_radius, surface_smoothing, surface_resolution});
}

py::array steps_of(const PythonRun& run) {
  return to_array(std::vector<std::int64_t>(run.reader().steps().begin(), run.reader().steps().end()));
}
py::array times_of(const PythonRun& run) {
  return to_array(std::vector<double>(run.reader().times().begin(), run.reader().times().end()));
}
py::array counts_of(const PythonRun& run) {
  const auto counts = run.reader().particle_counts();
  return to_array(std::vector<std::uint64_t>(counts.begin(), counts.end()));
}

std::vector<std::string> material_names(const PythonRun& run) {
  std::vector<std::string> names;
  for (const io::MaterialInfo& m : run.reader().info().materials) names.push_back(m.name);
  return names;
}

}  // namespace

void bind_run(py::module_& module) {
  py::class_<PythonRun>(module, "Run",
                        "The folder that a run has written, or is writing: what was there when it was opened.")
      .def(py::init<const std::filesystem::path&>(), py::arg("folder"),
           "Opens a run folder or its particles.vtkhdf. InputError where it is none or damaged.")
      .def("__len__", [](const PythonRun& r) { return r.reader().size(); })
      .def(
          "__getitem__", [](const PythonRun& r, std::int64_t index) { return r.snapshot(r.pick({}, {}, index)); },
          py::arg("index"), "Snapshot by index, from the end where it is below 0.")
      .def(
          "__iter__",
          [](const py::object& run) { return py::reinterpret_steal<py::iterator>(PySeqIter_New(run.ptr())); },
          "Its snapshots, one after another.")
      .def(
          "snapshot",
          [](const PythonRun& r, std::optional<double> time, std::optional<std::int64_t> step,
             std::optional<std::int64_t> index) { return r.snapshot(r.pick(time, step, index)); },
          py::kw_only(), py::arg("time") = py::none(), py::arg("step") = py::none(), py::arg("index") = py::none(),
          "The snapshot nearest to a time (s), of a step, or of an index; without any, the last one. InputError\n"
          "where the time is outside of the run or the step has no snapshot.")
      .def_property_readonly("folder", &PythonRun::folder, "Its path.")
      .def_property_readonly("steps", &steps_of, "Steps of the snapshots: int64 of shape (len(run),).")
      .def_property_readonly("times", &times_of, "Times of the snapshots, s: float64 of shape (len(run),).")
      .def_property_readonly("particle_counts", &counts_of, "Particles of the snapshots: uint64 of shape (len(run),).")
      .def_property_readonly("materials", &material_names, "Names of the materials, which snapshots index.")
      .def_property_readonly(
          "radii", [](const PythonRun& r) { return to_array(radii(r.reader().info().materials)); },
          "Radius of each material, m: float64.")
      .def_property_readonly(
          "masses",
          [](const PythonRun& r) {
            std::vector<double> masses;
            for (const io::MaterialInfo& m : r.reader().info().materials) masses.push_back(m.mass);
            return to_array(masses);
          },
          "Mass of a particle of each material, kg: float64.")
      .def_property_readonly(
          "time_step", [](const PythonRun& r) { return r.reader().info().time_step; }, "The time step, s.")
      .def("render", &PythonRun::render, py::arg("time") = py::none(), py::kw_only(),
           py::arg("size") = std::pair{1280, 720}, py::arg("color_by") = "material", py::arg("range") = py::none(),
           py::arg("samples") = 2, py::arg("legend") = true, py::arg("alpha") = false,
           "The picture at a time of the run (s, between snapshots too), by default its end, as `hooke render`\n"
           "draws it: uint8 of shape (height, width, 3), or 4 with alpha. Options as of Simulation.render().")
      .def("__repr__", [](const PythonRun& r) {
        return fmt::format("<hooke.Run of {} snapshots in {}>", r.reader().size(), r.folder().string());
      });
  module.def(
      "export", &export_files, py::arg("run"), py::arg("file"), py::kw_only(), py::arg("time") = py::none(),
      py::arg("step") = py::none(), py::arg("all") = false, py::arg("content") = "particles",
      py::arg("surface_radius") = 1.0, py::arg("surface_smoothing") = 1.5, py::arg("surface_resolution") = 0.5,
      "Writes snapshots of a run folder in the format that the extension of `file` names, as `hooke export`\n"
      "does: the last one, the one nearest to a time (s), the one of a step, or all. `content`: \"particles\",\n"
      "\"contacts\", \"surface\", \"volume\", \"cloths\", \"springs\". Returns the files written, the one to open\n"
      "first at the front.");
}

}  // namespace hooke::python
