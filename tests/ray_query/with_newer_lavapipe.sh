#!/usr/bin/env bash
# with_newer_lavapipe.sh FOLDER COMMAND...: runs a command on Mesa's lavapipe of the Debian backports, which has ray
# queries, as that of Debian 12 itself has not. The driver is fetched once from the mirror that the system's own packages
# come from and unpacked into FOLDER; nothing is installed, and all else keeps the system's driver. Where it cannot be
# had (no network, no backports there), the command runs on what there is.
set -euo pipefail

folder=$1
shift
manifest=$folder/lvp_icd.json

say() { printf 'newer lavapipe: %s\n' "$*" >&2; }

release() {
  sed -n -E 's/^VERSION_CODENAME="?([^"]*)"?$/\1/p' /etc/os-release
}

# Derives the source of backports from the system's own sources; writes it to $1.sources or $1.list and prints which.
write_source() {
  local file
  for file in /etc/apt/sources.list.d/*.sources; do
    [[ -r $file ]] || continue
    # The first paragraph whose suites name the release itself.
    awk -v release="$(release)" 'BEGIN { RS = ""; FS = "\n" }
      { found = 0
        for (i = 1; i <= NF; ++i) if ($i ~ "^Suites:.*[ \t]" release "([ \t]|$)") found = 1
        if (!found) next
        for (i = 1; i <= NF; ++i) {
          if ($i ~ /^#/) continue
          if ($i ~ /^Suites:/) $i = "Suites: " release "-backports"
          if ($i ~ /^Components:/) $i = "Components: main"
          print $i
        }
        exit }' "$file" >"$1.sources"
    [[ ! -s $1.sources ]] || { printf '%s' "$1.sources" && return 0; }
  done
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [[ -r $file ]] || continue
    awk -v release="$(release)" '$1 == "deb" {
        for (i = 3; i <= NF; ++i) if ($i == release) {
          line = $1
          for (j = 2; j < i; ++j) line = line " " $j
          print line, release "-backports", "main"
          exit
        } }' "$file" >"$1.list"
    [[ ! -s $1.list ]] || { printf '%s' "$1.list" && return 0; }
  done
  return 1
}

# Fetches and unpacks into $1.
fetch() {
  local work=$1 source suite options package
  mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/debs" "$work/root"
  source=$(write_source "$work/backports") || return 1
  suite=$(release)-backports
  options=(-q -o "Dir::Etc::sourcelist=$source" -o Dir::Etc::sourceparts=- -o "Dir::State::lists=$work/lists"
    -o "Dir::Cache=$work/cache" -o "APT::Sandbox::User=$(id -un)" -o Acquire::http::Timeout=20 -o Acquire::Retries=1)
  timeout 60 apt-get "${options[@]}" update || return 1
  (cd -- "$work/debs" && timeout 90 apt-get "${options[@]}" download "mesa-vulkan-drivers/$suite" "libdrm2/$suite") ||
    return 1
  for package in "$work"/debs/*.deb; do dpkg -x "$package" "$work/root" || return 1; done
  mkdir -p "$work/driver"
  cp -P "$work"/root/usr/lib/*/libvulkan_lvp.so "$work"/root/usr/lib/*/libdrm.so.* "$work/driver/" || return 1
  if LD_LIBRARY_PATH=$work/driver ldd "$work/driver/libvulkan_lvp.so" | grep 'not found'; then return 1; fi
}

provide() {
  local work log
  mkdir -p -- "$folder"
  # Tests run side by side; one fetches.
  exec 9>"$folder/.lock"
  flock 9
  [[ ! -e $manifest && ! -e $folder/unavailable ]] || return 0
  work=$(mktemp -d)
  log=$work/log
  if command -v apt-get >/dev/null && fetch "$work" >"$log" 2>&1; then
    cp -P "$work"/driver/* "$folder/"
    printf '{ "file_format_version": "1.0.0", "ICD": { "library_path": "%s", "api_version": "1.3.0" } }\n' \
      "$folder/libvulkan_lvp.so" >"$manifest.new"
    mv -- "$manifest.new" "$manifest"
  else
    say "the driver cannot be had from the backports of this system's package mirror: $(tail -n 1 -- "$log" 2>/dev/null)"
    # Asked once in an hour, not once a test.
    touch -- "$folder/unavailable"
  fi
  rm -rf -- "$work"
}

find "$folder" -maxdepth 1 -name unavailable -mmin +60 -delete 2>/dev/null || true
[[ -e $manifest ]] || (provide)
if [[ -e $manifest ]]; then
  export VK_DRIVER_FILES=$manifest LD_LIBRARY_PATH=$folder${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
  unset LIGHTLOOM_DEVICE
else
  say "not there; what needs ray queries is skipped unless another device has them"
fi
exec "$@"
