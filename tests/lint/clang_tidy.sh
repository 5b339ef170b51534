#!/usr/bin/env bash
# clang_tidy.sh BUILD_FOLDER SOURCE...: clang-tidy over the sources, on all cores; prints what it finds and fails then.
set -euo pipefail
build=$1
shift
# Exit status 255 would stop xargs at the first file.
printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" bash -c 'clang-tidy -p "$0" --quiet "$1" 2>/dev/null || exit 1' "$build"
