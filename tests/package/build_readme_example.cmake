# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# Installs Hooke into a folder of its own, and builds and runs the example of README.md against that installation.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(READ ${SOURCE}/README.md readme)
if(NOT readme MATCHES "```cpp\n([^`]+)```")
  message(FATAL_ERROR "README.md has no block of C++")
endif()
file(WRITE ${WORK}/source/main.cpp "${CMAKE_MATCH_1}")
file(COPY_FILE ${SOURCE}/tests/package/consumer.cmake ${WORK}/source/CMakeLists.txt)

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${WORK}/source -B ${WORK}/build -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${WORK}/prefix
    -D CMAKE_CXX_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/example)
string(STRIP "${output}" output)
if(NOT output MATCHES "^[-0-9.e]+ [-0-9.e]+ [-0-9.e]+\n[-0-9.e]+ [-0-9.e]+ [-0-9.e]+$")
  message(FATAL_ERROR "expected the positions of two balls, got:\n${output}")
endif()

# The installed program finds the scenes that were installed with it.
run(${WORK}/prefix/bin/hooke scenes)
if(NOT output MATCHES "In ${WORK}/prefix/share/hooke/scenes:" OR NOT output MATCHES "water.json")
  message(FATAL_ERROR "the installed program lists other scenes:\n${output}")
endif()
