#!/usr/bin/env bash
# Installs what is missing, builds, and runs lightloom with the arguments given; without arguments, renders the sample
# scene. Paths in the arguments are relative to the current folder, as usual.
set -euo pipefail
root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
# shellcheck source=.ci/setup.sh
source "$root/.ci/setup.sh"

install_packages
build_targets lightloom

if [[ $# -gt 0 ]]; then
  exec "$build/lightloom" "$@"
fi

cd -- "$root"
"$build/lightloom" render graphs/paper.json --scene samples/scenes/atrium.scene.json --frames 0..9 --out out/atrium
say "the last picture is $root/out/atrium/image.0009.png"
