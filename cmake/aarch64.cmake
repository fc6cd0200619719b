# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# Debian's cross compiler for 64-bit Arm; what it builds runs under qemu. The engine needs nothing else.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static)
set(CMAKE_FIND_ROOT_PATH /usr/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Programs that load Debian's C library for Arm hang in qemu 7.2 where they make a thread; those that contain it don't.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
