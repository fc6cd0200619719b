// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <pybind11/pybind11.h>

#include "hooke/scene/load_scene.h"
#include "run.h"
#include "scene_source.h"
#include "simulation.h"
#include "snapshot.h"

PYBIND11_MODULE(_hooke, module) {
  module.doc() = "The engine: hooke is its face.";
  hooke::python::bind_snapshot(module);
  hooke::python::bind_simulation(module);
  hooke::python::bind_run(module);
  module.def(
      "schema", [] { return hooke::python::parse_json(std::string(hooke::scene::scene_schema())); },
      "The JSON Schema of scene files: keys, units, ranges, defaults.");
  module.attr("__version__") = HOOKE_VERSION;
}
