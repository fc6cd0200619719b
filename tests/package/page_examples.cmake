# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# Builds and runs the C++ of README.md and of docs/embedding.md. Checks what else is installed: scenes, man pages, completions,
# what desktops need.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

# The first fenced block of a language in a page.
function(block_of page language)
  file(READ ${SOURCE}/${page} text)
  if(NOT text MATCHES "```${language}[^\n]*\n([^`]+)```")
    message(FATAL_ERROR "${page} has no block of ${language}")
  endif()
  set(block "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

# Builds and runs the program in ${WORK}/NAME.
function(build name)
  configure(${WORK}/${name} ${WORK}/${name}/build)
  run(${CMAKE_COMMAND} --build ${WORK}/${name}/build)
  run(${WORK}/${name}/build/example)
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})

block_of(README.md cpp)
file(WRITE ${WORK}/readme/main.cpp "${block}")
block_of(docs/embedding.md cmake)
file(WRITE ${WORK}/readme/CMakeLists.txt "${block}")
build(readme)
if(NOT output MATCHES "^[-0-9.e]+ [-0-9.e]+ [-0-9.e]+\n[-0-9.e]+ [-0-9.e]+ [-0-9.e]+$")
  message(FATAL_ERROR "expected the positions of two balls, got:\n${output}")
endif()

file(WRITE ${WORK}/embedding/CMakeLists.txt "${block}")
block_of(docs/embedding.md cpp)
file(WRITE ${WORK}/embedding/main.cpp "${block}")
build(embedding)
if(NOT output MATCHES "^[0-9]+ grains at 1[.]06 s; the shot is number [0-9]+\nat 0 s again, state [0-9a-f]+$")
  message(FATAL_ERROR "expected a count of grains and a state, got:\n${output}")
endif()

# The installed program finds the scenes that were installed with it.
run(${PREFIX}/bin/hooke scenes)
if(NOT output MATCHES "In ${PREFIX}/share/hooke/scenes:" OR NOT output MATCHES "water.json")
  message(FATAL_ERROR "the installed program lists other scenes:\n${output}")
endif()

set(share ${PREFIX}/share)
foreach(file man/man1/hooke.1 man/man1/hooke-run.1 man/man1/hooke-view.1 bash-completion/completions/hooke
             zsh/vendor-completions/_hooke)
  if(NOT EXISTS ${share}/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
if(EXISTS ${PREFIX}/bin/hooke-view)
  find_program(DESKTOP_CHECK desktop-file-validate)
  find_program(METAINFO_CHECK appstreamcli)
  if(DESKTOP_CHECK)
    run(${DESKTOP_CHECK} ${share}/applications/org.hooke_authors.hooke.desktop)
  endif()
  if(METAINFO_CHECK)
    run(${METAINFO_CHECK} validate --no-net ${share}/metainfo/org.hooke_authors.hooke.metainfo.xml)
  endif()
endif()
