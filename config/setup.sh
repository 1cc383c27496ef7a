# Sourced by ./run and ./test: installs missing Debian packages, configures and builds.
# Says what it does, and is quick when nothing changed.

say() { printf 'palace: %s\n' "$*" >&2; }

# missing_packages FILE: the packages of the list that are not installed, one a line.
missing_packages() {
  local name
  while read -r name; do
    case "$name" in '' | '#'*) continue ;; esac
    dpkg-query -W -f='${Status}' "$name" 2>/dev/null | grep -q 'ok installed' || printf '%s\n' "$name"
  done <"$1"
}

# install_packages FILE...: installs what is missing, as root or through sudo.
install_packages() {
  local missing=() file name as_root=()
  for file in "$@"; do
    while read -r name; do missing+=("$name"); done < <(missing_packages "$file")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  if ! command -v apt-get >/dev/null 2>&1; then
    say "these packages are missing and this is no Debian system: ${missing[*]}"
    exit 1
  fi
  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null 2>&1 && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
      as_root=(sudo)
    else
      say "packages are missing and this user cannot install them. As root, run:"
      printf '  apt-get update && apt-get install -y --no-install-recommends %s\n' "${missing[*]}" >&2
      exit 1
    fi
  fi
  say "installing ${#missing[@]} Debian packages: ${missing[*]}"
  local log
  log=$(mktemp)
  if ! "${as_root[@]}" apt-get update >"$log" 2>&1 ||
    ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
      "${missing[@]}" >>"$log" 2>&1 </dev/null; then
    tail -n 20 "$log" >&2
    say "the installation failed; the whole output is in $log"
    exit 1
  fi
  rm -f "$log"
}

# Under continuous integration warnings stop the build. A user's compiler may know warnings that
# ours do not, and stops at errors only.
in_ci() { case "${CI:-}" in '' | 0 | false | no) return 1 ;; esac; }

# needs_configuring FOLDER: there is no build there yet, or it would let warnings pass in CI.
needs_configuring() {
  [ -f "$1/build.ninja" ] || return 0
  in_ci && ! grep -q '^PALACE_WARNINGS_AS_ERRORS:BOOL=ON' "$1/CMakeCache.txt"
}

# build PRESET [TARGET...]: configures once, builds what changed.
build() {
  local preset=$1
  shift
  local log=build/$preset/build.log
  mkdir -p "build/$preset"
  if needs_configuring "build/$preset"; then
    local options=()
    in_ci && options=(-DPALACE_WARNINGS_AS_ERRORS=ON)
    say "configuring preset $preset${options[*]:+ with ${options[*]}}"
    if ! cmake --preset "$preset" "${options[@]+"${options[@]}"}" >"$log" 2>&1; then
      tail -n 30 "$log" >&2
      exit 1
    fi
  fi
  say "building preset $preset (only what changed)"
  local targets=()
  [ $# -gt 0 ] && targets=(--target "$@")
  if ! cmake --build --preset "$preset" "${targets[@]+"${targets[@]}"}" >"$log" 2>&1; then
    grep -E 'error|FAILED|undefined' "$log" | head -n 30 >&2
    say "the build failed; the whole output is in $log"
    exit 1
  fi
}

# skip_reasons LOG: of every test that CTest's log of the last run shows as skipped, its name and why,
# one a line, with a tab between.
skip_reasons() {
  awk '
    /^[0-9]+\/[0-9]+ Testing: / { name = $3; told = 0 }
    reason_follows && !told { print name "\t" $0; told = 1 }
    { reason_follows = /: Skipped$/ }' "$1"
}

# say_skipped LOG: what was not tested, and why. Tests without their reference data are counted, in
# one line (the words are those of tests/support/reference_data.h).
say_skipped() {
  local name reason without=0 folder
  while IFS=$'\t' read -r name reason; do
    case "$reason" in
      'runs with reference data in '*)
        without=$((without + 1))
        folder=$(dirname "${reason#runs with reference data in }")
        ;;
      *) say "skipped $name: $reason" ;;
    esac
  done < <(skip_reasons "$1")
  [ "$without" -eq 0 ] || say "skipped $without tests for want of reference data, which would lie in $folder"
}

# run_tests PRESET: all tests of a build, then what was skipped.
run_tests() {
  local result=0
  ctest --preset "$1" -j2 || result=$?
  say_skipped "build/$1/Testing/Temporary/LastTest.log"
  [ "$result" -eq 0 ] || exit "$result"
}
