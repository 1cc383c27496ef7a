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

# build PRESET [TARGET...]: configures once, builds what changed.
build() {
  local preset=$1
  shift
  local log=build/$preset/build.log
  mkdir -p "build/$preset"
  if [ ! -f "build/$preset/build.ninja" ]; then
    say "configuring preset $preset"
    if ! cmake --preset "$preset" >"$log" 2>&1; then
      tail -n 30 "$log" >&2
      exit 1
    fi
  fi
  say "building preset $preset (only what changed)"
  local targets=()
  [ $# -gt 0 ] && targets=(--target "$@")
  if ! cmake --build --preset "$preset" "${targets[@]}" >"$log" 2>&1; then
    grep -E 'error|FAILED|undefined' "$log" | head -n 30 >&2
    say "the build failed; the whole output is in $log"
    exit 1
  fi
}
