# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# run(COMMAND ...): its output in ${output}; ends the test where it fails.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}\nended with ${status}:\n${output}")
  endif()
  string(STRIP "${output}" output)
  set(output "${output}" PARENT_SCOPE)
endfunction()

# configure(SOURCE BUILD ...): a project that finds the installed Hooke.
macro(configure source build)
  run(${CMAKE_COMMAND} -S ${source} -B ${build} -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${PREFIX}
      -D CMAKE_CXX_COMPILER=${COMPILER} ${ARGN})
endmacro()
