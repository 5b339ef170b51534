#!/usr/bin/env bash
# run.sh SOURCE FOLDER: builds what needs no device with address and undefined behaviour sanitizers, and runs its tests.
set -euo pipefail
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
folder=$2
programs=(test_base test_graph test_image test_scene)  # the last two decode pictures
"$here/build.sh" "$1" "$folder" "${programs[@]}" fuzz_graph
# shellcheck source=tests/sanitize/options.sh
source "$here/options.sh"
failed=0
for program in "${programs[@]}"; do
  echo "== $program"
  if [[ $program == test_image ]]; then slow_unwind; fi
  log=$folder/$program.log
  timeout 900 "$folder/tests/$program" --gtest_brief=1 >"$log" 2>&1 || { failed=1; tail -n 80 "$log"; }
  tail -n 1 "$log"
done
echo "== fuzz_graph"
source "$here/options.sh"
timeout 300 "$folder/tests/fuzz_graph" 20 3 || failed=1
exit "$failed"
