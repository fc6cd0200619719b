# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# Flags that every target of Hooke's own is built with.
add_library(hooke_compiler_flags INTERFACE)
target_compile_options(hooke_compiler_flags INTERFACE
  # Contraction off: a * b + c must be rounded twice on every machine, or the same scene gives other bits
  # where the processor has fused multiply-add (docs/determinism.md).
  -ffp-contract=off
  # sqrt sets no errno and no trap is looked at: lets the compiler use the instruction; changes no value.
  -fno-math-errno -fno-trapping-math
  -Wall -Wextra -Wconversion -Wshadow
  # libstdc++ 12's own stable_sort calls what it declares deprecated, which Clang 19 says of whoever calls stable_sort.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>
  # At -O3 GCC 12 sees overlapping copies in std::string's operator+ (its bug 105651).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:Release>>:-Wno-restrict>
  $<$<BOOL:${HOOKE_WARNINGS_AS_ERRORS}>:-Werror>
  # Without it the compiler cache can't serve what is built with a precompiled header.
  $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)

# A fast linker where there is one, for the builds that are linked again and again.
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT CMAKE_CROSSCOMPILING)
  find_program(HOOKE_MOLD mold DOC "Fast linker; builds work without it")
  if(HOOKE_MOLD)
    add_link_options(-fuse-ld=mold)
  endif()
endif()
# Checks of indices in the headers of the C++ library; Hooke's own assertions: src/base/assert.h.
target_compile_definitions(hooke_compiler_flags INTERFACE $<$<BOOL:${HOOKE_ASSERTIONS}>:_GLIBCXX_ASSERTIONS>)

# GCC takes what the sanitizers add for reads of uninitialised values, in the standard library's headers too.
if((HOOKE_SANITIZE_ADDRESS OR HOOKE_SANITIZE_THREAD) AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(hooke_compiler_flags INTERFACE -Wno-maybe-uninitialized)
endif()
if(HOOKE_SANITIZE_ADDRESS)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
if(HOOKE_BUILD_FUZZERS)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
if(HOOKE_SANITIZE_THREAD)
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
endif()
