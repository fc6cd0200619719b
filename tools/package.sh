#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# tools/package.sh         makes the Debian packages, in build/packages
# tools/package.sh test    installs them in a bare system, in a folder of its own, and runs a scene, the C++ example of
#                          docs/embedding.md and an example of Python there; needs root and Debian's archive
set -euo pipefail
cd "$(dirname "$0")/.."

make_packages() {
  cmake --preset release >/dev/null
  cmake --build --preset release -j "$(nproc)"
  rm -rf build/packages
  cpack --config build/CPackConfig.cmake -B build/packages >build/cpack.log || { cat build/cpack.log >&2; exit 1; }
  rm -rf build/packages/_CPack_Packages
  ls -sh build/packages/*.deb
}

test_packages() {
  if ((EUID != 0)); then
    echo "needs root: it makes a system in a folder" >&2
    exit 2
  fi
  root=$(mktemp -d)  # for the trap too, which runs when this function's own variables are gone
  # Nothing of the folder is kept, and nothing may stay mounted in it.
  trap 'umount "$root/proc" 2>/dev/null || true; rm -rf "$root"' EXIT
  echo "== a bare system"
  debootstrap --variant=minbase "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$root" >build/debootstrap.log || {
    tail -20 build/debootstrap.log >&2
    exit 1
  }
  mount -t proc proc "$root/proc"
  mkdir "$root/packages" "$root/trial"
  cp build/packages/*.deb "$root/packages/"
  cp -r examples/python "$root/trial/"
  block_of() { awk -v start='^```'"$1" '$0 ~ start { on = 1; next } on && /^```$/ { exit } on' docs/embedding.md; }
  in_it() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
  install() { in_it sh -c "apt-get install -y --no-install-recommends $* >/tmp/log 2>&1 || { tail -20 /tmp/log; exit 1; }"; }

  echo "== hooke"
  install /packages/hooke_*.deb
  in_it hooke check /usr/share/hooke/scenes/ball-pit.json
  in_it hooke run /usr/share/hooke/scenes/ball-pit.json -o /trial/balls --set time.end=0.2 --report /trial/report.json
  in_it test -s /usr/share/man/man1/hooke.1
  if in_it hooke render /trial/balls -o /trial/balls.png 2>build/refused.txt; then
    echo "a picture was drawn without OpenGL" >&2
    exit 1
  fi
  grep -q OpenGL build/refused.txt
  install libegl1 libgl1 libgl1-mesa-dri fonts-dejavu-core
  in_it hooke render /trial/balls -o /trial/balls.png

  echo "== hooke-mpi"
  install /packages/hooke-mpi_*.deb
  in_it mpirun --allow-run-as-root --oversubscribe -np 2 hooke run /usr/share/hooke/scenes/ball-pit.json -o /trial/ranks --set time.end=0.2
  in_it cmp /trial/balls/checkpoint.h5 /trial/ranks/checkpoint.h5

  echo "== libhooke-dev"
  install /packages/libhooke-dev_*.deb g++ cmake make
  in_it sh -ec '
    cd /trial
    mkdir core && cd core
    cat >main.cpp <<"CPP"
#include <hooke/backends/cpu/cpu_backend.h>
#include <hooke/core/simulation.h>
int main() { return hooke::make_cpu_backend() ? 0 : 1; }
CPP
    printf "cmake_minimum_required(VERSION 3.25)\nproject(core CXX)\nfind_package(hooke REQUIRED COMPONENTS core)\nadd_executable(core main.cpp)\ntarget_link_libraries(core hooke::hooke)\n" >CMakeLists.txt
    cmake -S . -B build >/dev/null && cmake --build build >/dev/null && build/core'
  install libfmt-dev libhdf5-dev zlib1g-dev libcairo2-dev libepoxy-dev libopenexr-dev libpng-dev pkg-config libopenvdb-dev libboost-iostreams-dev
  mkdir "$root/trial/embedding"
  block_of cpp >"$root/trial/embedding/main.cpp"
  block_of cmake >"$root/trial/embedding/CMakeLists.txt"
  in_it sh -ec '
    cd /trial/embedding
    cmake -S . -B build >/dev/null && cmake --build build >/dev/null && build/example'

  echo "== python3-hooke"
  install /packages/python3-hooke_*.deb
  in_it sh -ec 'cd /trial && python3 python/bouncing_balls.py'
  echo "the packages are good"
}

case "${1:-}" in
  "") make_packages ;;
  test) test_packages ;;
  *)
    echo "usage: tools/package.sh [test]" >&2
    exit 2
    ;;
esac
