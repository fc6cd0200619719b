# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# Who asks for a part of Hooke is asked for what that part needs, and for nothing else.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})

# use(NAME FIND PACKAGE ...): builds and runs ${program}, for which FIND finds Hooke, where none of the packages is to be found.
function(use name find)
  file(WRITE ${WORK}/${name}/main.cpp "${program}")
  file(WRITE ${WORK}/${name}/CMakeLists.txt "
cmake_minimum_required(VERSION 3.25)
project(${name} LANGUAGES CXX)
${find}
add_executable(${name} main.cpp)
target_link_libraries(${name} PRIVATE hooke::hooke)
")
  set(hidden "")
  foreach(package IN LISTS ARGN)
    list(APPEND hidden -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
  endforeach()
  configure(${WORK}/${name} ${WORK}/${name}/build ${hidden})
  run(${CMAKE_COMMAND} --build ${WORK}/${name}/build)
  run(${WORK}/${name}/build/${name})
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(program [[
#include <hooke/backends/cpu/cpu_backend.h>
#include <hooke/core/simulation.h>
int main() {
  hooke::Scene scene;
  scene.materials = {{.name = "a", .radius = 0.05, .mass = 1, .contact = {.stiffness = 5000, .shear = 1, .damping = 5}}};
  hooke::ParticleSet balls{.id = {1}, .material = {0}, .position = {{.5, .5, .5}}, .velocity = {{}}};
  auto simulation = hooke::Simulation::create(scene, balls, std::move(hooke::make_cpu_backend().value()));
  return simulation && simulation->step(10) ? 0 : 1;
}
]])
use(core "find_package(hooke REQUIRED COMPONENTS core OPTIONAL_COMPONENTS optics)" fmt HDF5 ZLIB OpenVDB PNG PkgConfig nlohmann_json)

set(program [[
#include <hooke/scene/load_scene.h>
#include <iostream>
int main() {
  const char* text = R"({"hooke": 1, "name": "n", "time": {"step": 0.001, "end": 1},
    "domain": {"min": [0, 0, 0], "max": [1, 1, 1]}, "materials": {"a": {"radius": 0.1, "mass": 1, "stiffness": 100}},
    "particles": [{"material": "a", "block": {"min": [0.2, 0.2, 0.2], "max": [0.8, 0.8, 0.8], "spacing": 0.3}}],
    "colliders": [{"shape": {"mesh": {"file": "rock.obj"}}}]})";
  auto loaded = hooke::scene::parse_scene(text, "n", SCENES, {});
  if (loaded) return 1;
  std::cout << loaded.error().text();
}
]])
string(REPLACE "SCENES" "\"${SOURCE}/scenes/meshes\"" program "${program}")
use(scene "find_package(hooke REQUIRED COMPONENTS scene)" HDF5 ZLIB OpenVDB PNG PkgConfig nlohmann_json)
if(NOT output MATCHES "needs OpenVDB")
  message(FATAL_ERROR "a mesh without the component meshes: expected a refusal that names OpenVDB, got:\n${output}")
endif()

# Who asks for more later gets it.
string(REPLACE "if (loaded) return 1;\n  std::cout << loaded.error().text();" "if (!loaded) { std::cout << loaded.error().text(); return 1; }"
  program "${program}")
use(meshes "find_package(hooke REQUIRED COMPONENTS scene)\nfind_package(hooke REQUIRED COMPONENTS scene meshes)" HDF5 PNG PkgConfig)

set(program [[
#include <hooke/run/open_simulation.h>
int main() {
  hooke::run::SceneArguments scene;
  scene.file = SCENE;
  auto opened = hooke::run::open_simulation(scene, {}, {});
  return opened && opened->simulation.step(10) ? 0 : 1;
}
]])
string(REPLACE "SCENE" "\"${SOURCE}/scenes/ball-pit.json\"" program "${program}")
use(run "find_package(hooke REQUIRED COMPONENTS run)" OpenVDB nlohmann_json)

file(WRITE ${WORK}/unknown/CMakeLists.txt "
cmake_minimum_required(VERSION 3.25)
project(unknown LANGUAGES CXX)
find_package(hooke REQUIRED COMPONENTS optics)
")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK}/unknown -B ${WORK}/unknown/build -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${PREFIX} -D CMAKE_CXX_COMPILER=${COMPILER}
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(status EQUAL 0 OR NOT output MATCHES "no[ \n]+component[ \n]+\"optics\"")
  message(FATAL_ERROR "an unknown component: expected a refusal that names it, got:\n${output}")
endif()
