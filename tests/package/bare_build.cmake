# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# A build of the program without oneTBB, HDF5, OpenVDB, OpenEXR and OpenGL: it computes the same, and says by name what it lacks.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER}
    -D HOOKE_WITH_TBB=OFF -D HOOKE_WITH_HDF5=OFF -D HOOKE_WITH_OPENVDB=OFF -D HOOKE_WITH_OPENEXR=OFF -D HOOKE_WITH_GL=OFF
    -D HOOKE_BUILD_TESTS=OFF -D HOOKE_BUILD_BENCH=OFF)
run(${CMAKE_COMMAND} --build ${WORK}/build --target hooke)
set(bare ${WORK}/build/hooke)
file(REMOVE_RECURSE ${WORK}/run)
file(MAKE_DIRECTORY ${WORK}/kept)
file(WRITE ${WORK}/kept/particles.vtkhdf "what was there")

foreach(program IN ITEMS ${bare} ${BUILD}/hooke)
  run(${program} bench ${SOURCE}/scenes/ball-pit.json --steps 300 --threads 3 --json)
  string(REGEX MATCH "\"state_hash\": \"([0-9a-f]+)\"" found "${output}")
  list(APPEND hashes ${CMAKE_MATCH_1})
endforeach()
list(LENGTH hashes count)
list(REMOVE_DUPLICATES hashes)
list(LENGTH hashes different)
if(NOT count EQUAL 2 OR NOT different EQUAL 1)
  message(FATAL_ERROR "the same scene has other bits in a bare build: ${hashes}")
endif()

# refused(MESSAGE ARGUMENT ...)
function(refused message)
  execute_process(COMMAND ${bare} ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 2 OR NOT output MATCHES "${message}")
    message(FATAL_ERROR "hooke ${ARGN}\nended with ${status}, expected 2 and \"${message}\":\n${output}")
  endif()
endfunction()
set(balls ${SOURCE}/scenes/ball-pit.json)
refused("needs HDF5, which is not in this build" run ${balls} -o ${WORK}/run)
refused("needs HDF5, which is not in this build" run ${balls} -o ${WORK}/kept --overwrite)
refused("needs HDF5, which is not in this build" info ${WORK}/kept)
refused("needs OpenGL, which is not in this build" run ${balls} -o ${WORK}/run --film ${WORK}/film.mp4)
refused("needs OpenVDB, which is not in this build" check ${SOURCE}/scenes/avalanche.json)
file(READ ${WORK}/kept/particles.vtkhdf kept)
if(EXISTS ${WORK}/run OR NOT kept STREQUAL "what was there")
  message(FATAL_ERROR "a refused run left something or took something away")
endif()
