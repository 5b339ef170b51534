#!/usr/bin/env bash
# run.sh SOURCE FOLDER TARGET SECONDS: builds a fuzz target in FOLDER, tries every file of its corpus, then spoilt ones:
# the same ones on every machine, 400 a second, or as many as a slow machine tries in that time. What it finds is left in
# FOLDER/found; new inputs that reach further in FOLDER/corpus.
set -euo pipefail
source=$1
folder=$2
target=$3
seconds=$4
here=$source/tests/sanitize
"$here/build.sh" "$source" "$folder" "${target}_fuzzer"
# shellcheck source=tests/sanitize/options.sh
source "$here/options.sh"
[[ $target == graph_file ]] || slow_unwind
corpus=$source/tests/fuzz/corpus/$target
mkdir -p "$folder/corpus/$target" "$folder/found"
program=$folder/tests/${target}_fuzzer
common=(-rss_limit_mb=1024 -timeout=10 -artifact_prefix="$folder/found/$target-")
"$program" "${common[@]}" -runs=0 "$corpus" >"$folder/found/$target.log" 2>&1 || { tail -n 60 "$folder/found/$target.log"; exit 1; }
"$program" "${common[@]}" -runs="$((seconds * 400))" -max_total_time="$seconds" -reload=0 -max_len=65536 -dict="$source/tests/fuzz/$target.dict" -seed=1 -print_final_stats=1 \
  "$folder/corpus/$target" "$corpus" >"$folder/found/$target.log" 2>&1 || { tail -n 60 "$folder/found/$target.log"; exit 1; }
tail -n 6 "$folder/found/$target.log"
