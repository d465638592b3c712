#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds, runs and tests gmsim on Debian 12, starting from a machine that has none of the tools.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

# What the build needs, nothing taken for granted (docs/dependencies.md says what each is for).
build_packages=(
  cmake ninja-build g++ flex bison
  libfmt-dev libcli11-dev libyaml-cpp-dev libtinyobjloader-dev libhdf5-dev zlib1g-dev
)
# What the tests need on top.
test_packages=(doctest-dev python3 python3-venv)

# Folders of tests that read hostile text; they run once more under ASan and UBSan.
front_end=(tests/unit/syntax tests/unit/check tests/fuzz)

usage() {
  cat <<'END'
./gmsim.sh run scenes/x.yaml           build if needed, then `gmsim scenes/x.yaml`
./gmsim.sh run check my.rule           any gmsim command line may follow `run`
./gmsim.sh build                       build the program: build/release/gmsim
./gmsim.sh test                        build and run all tests but the slow ones
./gmsim.sh test -R golden              what follows `test` goes to ctest

Missing Debian packages are installed with apt-get; nothing else of the system is changed.
END
}

say() { echo "gmsim.sh: $*" >&2; }

# Prints those of the given packages that are not installed.
missing_packages() {
  local package
  for package in "$@"; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
      echo "$package"
  done
}

need_packages() {
  if ! command -v dpkg-query >/dev/null; then
    say "this is no Debian or Ubuntu; the build expects the equivalents of: $*"
    return
  fi
  local missing as_root=()
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]} == 0)) && return
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      say "packages are missing, and there is no sudo; as root, run: apt-get install ${missing[*]}"
      exit 3
    fi
    as_root=(sudo)
  fi
  if ! command -v apt-get >/dev/null; then
    say "packages are missing, and there is no apt-get to install them: ${missing[*]}"
    exit 3
  fi
  say "installing ${missing[*]}"
  "${as_root[@]}" apt-get update -q >&2
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends "${missing[@]}" >&2
}

# configure PRESET [OPTION...]: once; after that ninja notices changed CMake files itself.
configure() {
  [[ -f $root/build/$1/build.ninja ]] || (cd "$root" && cmake --preset "$@")
}

build_release() {
  need_packages "${build_packages[@]}"
  configure release -DGMSIM_TESTS=OFF
  cmake --build "$root/build/release" --target gmsim
}

# Silent when there is nothing to build, so that the program's own output stands alone.
is_up_to_date() {
  [[ -x $root/build/release/gmsim ]] &&
    ninja -C "$root/build/release" -n gmsim 2>/dev/null | grep -q 'no work to do'
}

# The Python packages that tests use, in an environment of their own; made again when they change.
need_venv() {
  local venv=$root/build/venv wanted=$root/tests/requirements.txt
  cmp -s "$wanted" "$venv/installed.txt" && return
  say "installing the Python packages of tests/requirements.txt in build/venv"
  # The system's python3, which python3-venv belongs to, whatever else is first in PATH.
  /usr/bin/python3 -m venv --clear "$venv"
  "$venv/bin/python" -m pip install -q --disable-pip-version-check -r "$wanted"
  cp "$wanted" "$venv/installed.txt"
}

test_front_end_with_sanitizers() {
  local folder folders=()
  for folder in "${front_end[@]}"; do
    [[ -f $root/$folder/CMakeLists.txt ]] && folders+=("$folder")
  done
  configure asan
  cmake --build "$root/build/asan" --target "${folders[@]/%//all}"
  for folder in "${folders[@]}"; do
    ctest --test-dir "$root/build/asan/$folder" --output-on-failure -LE slow
  done
}

run_tests() {
  need_packages "${build_packages[@]}" "${test_packages[@]}"
  need_venv
  export PATH=$root/build/venv/bin:$PATH
  configure dev
  cmake --build "$root/build/dev"
  (($# == 0)) && test_front_end_with_sanitizers
  cd "$root" && ctest --preset dev "$@"
}

case ${1:-} in
  build)
    build_release
    ;;
  run)
    shift
    is_up_to_date || build_release >&2
    exec "$root/build/release/gmsim" "$@"
    ;;
  test)
    shift
    run_tests "$@"
    ;;
  -h | --help)
    usage
    ;;
  *)
    usage >&2
    exit 2
    ;;
esac
