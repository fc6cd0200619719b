#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# Installs what Hooke needs from Debian's own packages; says nothing when all of it is there.
#   tools/setup.sh          to build and run
#   tools/setup.sh test     also to test, which checks the format
#   tools/setup.sh lint     also to lint
#   tools/setup.sh bench    to build and run, to measure and to draw what was measured
#   tools/setup.sh docs     to build and run, and to make the documentation site
#   tools/setup.sh fuzz     also to run fuzzers
#   tools/setup.sh python   to build the Python module, and to install it with pip
#   tools/setup.sh package  to make Debian packages, and to test them in a bare system
#   tools/setup.sh soak     all that soak needs
set -euo pipefail

build_packages=(
  build-essential cmake ninja-build ccache
  libtbb-dev nlohmann-json3-dev libvalijson-dev libcli11-dev libfmt-dev libspdlog-dev libhdf5-dev
  libopenvdb-dev libboost-iostreams-dev libopenmpi-dev openmpi-bin libtrilinos-zoltan-dev
  libgtest-dev libgmock-dev libbenchmark-dev pkg-config
  libepoxy-dev libegl1 libgl1 libgl1-mesa-dri libpng-dev libopenexr-dev libcairo2-dev fonts-dejavu-core ffmpeg
  libglfw3-dev libimgui-dev
  python3)
bench_packages=(lammps python3-h5py python3-numpy python3-matplotlib x11-xserver-utils xauth xdotool xvfb)
python_packages=(python3-dev pybind11-dev python3-numpy python3-pip python3-setuptools python3-wheel)
test_packages=(appstream clang-format-19 desktop-file-utils groff-base lammps mold python3-h5py python3-matplotlib
  python3-vtk9 x11-xserver-utils xauth xdotool xvfb zsh "${python_packages[@]}")
docs_packages=(doxygen mkdocs mkdocs-material)
lint_packages=(clang-19 clang-tidy-19)
cross_packages=(g++-aarch64-linux-gnu googletest qemu-user-static)
package_packages=(debootstrap dpkg-dev)
hosts_packages=(iproute2)
fuzz_packages=(clang-19 libclang-rt-19-dev)

packages=("${build_packages[@]}")
case "${1:-}" in
  package) packages+=("${python_packages[@]}" "${package_packages[@]}") ;;
  python) packages+=("${python_packages[@]}") ;;
  test) packages+=("${test_packages[@]}") ;;
  lint) packages+=("${test_packages[@]}" "${lint_packages[@]}") ;;
  fuzz) packages+=("${test_packages[@]}" "${fuzz_packages[@]}") ;;
  docs) packages+=("${docs_packages[@]}") ;;
  bench) packages+=("${bench_packages[@]}") ;;
  soak) packages+=("${test_packages[@]}" "${lint_packages[@]}" "${bench_packages[@]}" "${cross_packages[@]}"
    "${package_packages[@]}" "${hosts_packages[@]}") ;;
esac

if ! command -v dpkg-query >/dev/null; then
  echo "Not a Debian system: install the likes of ${packages[*]} yourself." >&2
  exit 0
fi

installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null | sort -u || true)
missing=()
for package in "${packages[@]}"; do
  grep -qx "installed $package" <<<"$installed" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then exit 0; fi

as_root=()
if ((EUID != 0)); then as_root=(sudo); fi
echo "Installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
quietly() {
  local log
  log=$(mktemp)
  if ! "$@" >"$log" 2>&1 </dev/null; then
    cat "$log" >&2
    rm -f "$log"
    return 1
  fi
  rm -f "$log"
}
quietly "${as_root[@]}" apt-get -o Acquire::Retries=3 update
quietly "${as_root[@]}" apt-get -o Acquire::Retries=3 install -y --no-install-recommends "${missing[@]}"
