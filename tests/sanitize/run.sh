#!/usr/bin/env bash
# run.sh SOURCE FOLDER: builds what needs no device with address and undefined behaviour sanitizers, and runs its tests.
set -euo pipefail
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
folder=$2
programs=(test_base test_graph test_image test_scene)
"$here/build.sh" "$1" "$folder" "${programs[@]}" fuzz_graph
# shellcheck source=tests/sanitize/options.sh
source "$here/options.sh"
failed=0
# check PROGRAM FILTER: its tests that the filter keeps; what they print is shown if one fails.
check() {
  local log=$folder/$1.log
  echo "== $1 $2"
  timeout 900 "$folder/tests/$1" --gtest_brief=1 --gtest_filter="$2" >"$log" 2>&1 || { failed=1; tail -n 80 "$log"; }
  tail -n 1 "$log"
}
# Large scenes take six times as long where stacks are unwound slowly, which is for the decoders of small pictures.
large='SharedScenes.*:TexturePages.Sponza*:Limits.*:Claims.*:Broken.DeepNesting*'
check test_base '*'
check test_graph '*'
check test_scene "$large"
slow_unwind
check test_image '*'
check test_scene "-$large"
echo "== fuzz_graph"
source "$here/options.sh"
timeout 300 "$folder/tests/fuzz_graph" 20 3 || failed=1
exit "$failed"
