#!/usr/bin/env bash
# build.sh SOURCE FOLDER TARGET...: builds the targets in FOLDER with sanitizers, by Clang, whose libFuzzer the fuzz
# targets need. One process at a time builds there.
set -euo pipefail
source=$1
folder=$2
shift 2
command -v clang++ >/dev/null || { echo "clang++ is missing; packages.txt lists it"; exit 1; }
mkdir -p -- "$folder"
exec 9>"$folder/lock"
flock 9
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
log=$folder/build.log
{ cmake -S "$source" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ -DLIGHTLOOM_SANITIZE=ON \
    "${launcher[@]}" && cmake --build "$folder" --target "$@"; } >"$log" 2>&1 || { tail -n 60 "$log"; exit 1; }
