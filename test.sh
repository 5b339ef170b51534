#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test. Arguments go to ctest, e.g. ./test.sh -L everyday -R graph
set -euo pipefail
root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
# shellcheck source=.ci/setup.sh
source "$root/.ci/setup.sh"

install_packages
build_targets all

exec ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel 2 "$@" </dev/null
