#!/usr/bin/env bash
# Tests the kernels on another architecture: compiles them and what they need for aarch64 and runs their tests under
# qemu. Debian's libraries for aarch64 are unpacked into the build folder. On the machine itself, only a cross-compiler
# and qemu are installed.
#
# Usage: aarch64.sh [GoogleTest flags]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source ./packages.sh

build=$PWD/build/aarch64
root=$build/root
libraries=(libeigen3-dev libfftw3-dev libgmock-dev libgtest-dev libhwy-dev librandom123-dev)

# The code from a sea's spectrum to traced rays. The rest of the generator needs more libraries.
sources=(sea/*.cc sea/{correlation,quadrature,response,spectra}/*.cc generator/{math,surface,kernels}/*.cc
         generator/monte_carlo/slope_moments.cc
         tests/generator/{math,surface,kernels}/*_test.cc tests/generator/kernels/normal_lanes.cc
         tests/sea/response/refraction_test.cc)

# Needs no root: apt-get keeps its lists of the other architecture in our own folder.
unpack_libraries() {
  [[ ! -e $root/complete || $(<"$root/complete") != "${libraries[*]}" ]] || return 0
  echo "== Fetching ${#libraries[@]} Debian packages for aarch64"
  local apt=$build/apt
  rm -rf "$apt" "$root"
  mkdir -p "$apt"/{state/lists,cache/archives}/partial "$apt/packages" "$root"
  : >"$apt/state/status"
  local get=(apt-get -qq -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Acquire::Retries=3
             -o "Dir::State=$apt/state" -o "Dir::State::status=$apt/state/status" -o "Dir::Cache=$apt/cache"
             -o "APT::Sandbox::User=$(id -un)")
  "${get[@]}" update
  # The name of Highway's shared library differs between versions of Debian.
  local highway
  highway=$(apt-cache "${get[@]:2}" show libhwy-dev | sed -nE 's/^Depends:.*\b(libhwy1[a-z0-9]*).*/\1/p')
  (cd "$apt/packages" && "${get[@]}" download "${libraries[@]}" "$highway")
  local package
  for package in "$apt"/packages/*.deb; do dpkg-deb --extract "$package" "$root"; done
  echo "${libraries[*]}" >"$root/complete"
}

# With the flags of cmake/house_rules.cmake and generator/CMakeLists.txt.
compile() {
  local object=$build/${1%.cc}.o
  mkdir -p "$(dirname "$object")"
  ccache aarch64-linux-gnu-g++ -std=c++20 -O3 -march=armv8-a+crypto \
    -Wall -Wextra -Wpedantic -Wshadow -Werror -Wno-psabi \
    "-D$instruction_sets" \
    -I. -isystem "$root/usr/include" -isystem "$root/usr/include/eigen3" -c "$1" -o "$object"
}
instruction_sets=$(grep -o 'HWY_DISABLED_TARGETS=[^"]*' cmake/house_rules.cmake)
export -f compile
export build root instruction_sets

install_packages aarch64
unpack_libraries
echo "== Building for aarch64"
printf '%s\n' "${sources[@]}" | xargs -P "$(nproc)" -I{} bash -c 'compile "$1"' compile {}
objects=("${sources[@]%.cc}")
objects=("${objects[@]/#/$build/}")
aarch64-linux-gnu-g++ "${objects[@]/%/.o}" -L "$root/usr/lib/aarch64-linux-gnu" -lgtest_main -lgtest -lfftw3 -lhwy \
  -o "$build/kernels_test"

echo "== Testing on aarch64, emulated"
# Highway is a shared library in our folder; the libraries of the compiler are in its own folder.
qemu-aarch64-static -L /usr/aarch64-linux-gnu -E "LD_LIBRARY_PATH=$root/usr/lib/aarch64-linux-gnu" \
  "$build/kernels_test" --gtest_brief=1 "$@"
