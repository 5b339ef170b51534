# Set-up shared by run.sh and test.sh, to be sourced. Everything it says goes to standard error.
# shellcheck shell=bash disable=SC2154 # root is set by who sources this

# Where it is built; LIGHTLOOM_BUILD names another folder.
build=${LIGHTLOOM_BUILD:-$root/build}

say() { printf 'lightloom: %s\n' "$*" >&2; }

give_up() {
  say "$@"
  exit 1
}

# The lines of packages.txt that name a package which is not installed.
missing_packages() {
  local wanted installed
  mapfile -t wanted < <(sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$root/packages.txt")
  # dpkg-query fails for names it does not know; those are simply not in its answer.
  installed=$(dpkg-query --show --showformat '${binary:Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null |
    sed -n -e 's/:[^ ]*//' -e 's/ installed$//p') || true
  printf '%s\n' "${wanted[@]}" | grep -vxF -f <(printf '%s\n' "$installed") || true
}

# Runs a command; its output is shown only if it fails.
quietly() {
  local log status=0
  log=$(mktemp)
  "$@" >"$log" 2>&1 </dev/null || status=$?
  [[ $status -eq 0 ]] || cat -- "$log" >&2
  rm -f -- "$log"
  return "$status"
}

as_root() {
  local sudo=()
  if [[ $EUID -ne 0 ]]; then
    sudo=(sudo)
    # Without a terminal nobody could type a password.
    [[ -t 0 ]] || sudo=(sudo -n)
  fi
  quietly "${sudo[@]}" "$@"
}

install_packages() {
  local missing
  command -v dpkg-query >/dev/null ||
    give_up "this is no Debian system (there is no dpkg-query), so install what packages.txt lists by other means and build with CMake"
  mapfile -t missing < <(missing_packages)
  [[ ${#missing[@]} -gt 0 ]] || return 0
  if [[ $EUID -ne 0 ]] && ! command -v sudo >/dev/null; then
    give_up "these packages are missing and can be installed only as root or with sudo: ${missing[*]}"
  fi
  say "installing ${#missing[@]} Debian packages: ${missing[*]}"
  # One call, so that sudo asks once. Lists that cannot be updated are reported only if the packages cannot be had either:
  # another source in the system's list may be dead.
  # shellcheck disable=SC2016 # expanded by the inner shell
  as_root env DEBIAN_FRONTEND=noninteractive sh -c '
    apt-get --yes -o DPkg::Lock::Timeout=300 update
    exec apt-get --yes -o DPkg::Lock::Timeout=300 install --no-install-recommends "$@"' sh "${missing[@]}" ||
    give_up "these packages are missing and cannot be installed: ${missing[*]}"
}

# build_targets TARGET...: a Release build in $build, quiet unless it fails.
build_targets() {
  local fresh=() launcher=()
  mkdir -p -- "$build" || give_up "cannot make the folder $build"
  # Two builds at the same time would write the same files.
  exec 9>"$build/.lock"
  flock 9
  if [[ ! -f $build/build.ninja ]] || ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt"; then
    [[ ! -f $build/CMakeCache.txt ]] || fresh=(--fresh)
    ! command -v ccache >/dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    say "configuring in $build"
    quietly cmake "${fresh[@]}" -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release "${launcher[@]}" ||
      give_up "CMake cannot configure the build"
  fi
  [[ -x $build/lightloom ]] || say "building (the first build takes some minutes)"
  quietly ninja -C "$build" --quiet "$@" || give_up "the build failed"
  exec 9>&-
}
