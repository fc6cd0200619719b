# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# All installed headers compile, and so does each example in their comments: lines of code there are indented by four and more
# spaces; formulas, which are too, have no semicolon.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})
string(REPLACE "," ";" headers "${PUBLIC_HEADERS}")
set(includes "")
set(examples "")
set(count 0)
foreach(header IN LISTS headers)
  string(APPEND includes "#include <hooke/${header}>\n")

  # The lines of code of a header, all in one function: an example is at most one a header.
  file(STRINGS ${PREFIX}/include/hooke/${header} lines REGEX "^ *///     ")
  set(code "")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^ *///     " "  " line "${line}")
    string(APPEND code "${line}\n")
  endforeach()
  if(code MATCHES ";")
    math(EXPR count "${count} + 1")
    string(APPEND examples "// ${header}\nint example_${count}() {\n${code}  return 0;\n}\n\n")
  endif()
endforeach()
if(count LESS 2)
  message(FATAL_ERROR "found ${count} examples in the comments of public headers")
endif()
file(WRITE ${WORK}/source/examples.cpp "${includes}
// What examples take as given.
hooke::Scene scene;
hooke::ParticleSet particles;
extern hooke::Simulation simulation;
struct Window { bool is_open() { return false; } } window;
struct Hand { bool pulls() { return false; } } hand;
const std::uint64_t id = 1;
const hooke::Vec3d pull{0, 1, 0};
int complain(const hooke::Error&) { return 1; }
void draw(const hooke::Vec3d&) {}
void draw(const hooke::ParticleSet&) {}

${examples}")
file(WRITE ${WORK}/source/CMakeLists.txt [[
cmake_minimum_required(VERSION 3.25)
project(headers LANGUAGES CXX)
find_package(hooke REQUIRED)
add_library(headers OBJECT examples.cpp)
target_compile_options(headers PRIVATE -fsyntax-only -Wall -Wextra -Werror -Wno-unused-function)
target_link_libraries(headers PRIVATE hooke::hooke)
]])
configure(${WORK}/source ${WORK}/build)
run(${CMAKE_COMMAND} --build ${WORK}/build)
