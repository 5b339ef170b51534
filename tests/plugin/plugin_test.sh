#!/usr/bin/env bash
# Installs Lightloom into a new folder, builds samples/plugin outside the tree against it, renders with its pass in the
# place of the paper's, and sees a plug-in of another interface refused.
# Usage: plugin_test.sh SOURCE_FOLDER BUILD_FOLDER
set -euo pipefail
source_folder=$1
build_folder=$2
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

fail() {
  echo "plugin_test: $*" >&2
  exit 1
}

build_plugin() { # build_plugin FOLDER PREFIX
  cmake -S "$work/plugin" -B "$1" -DCMAKE_PREFIX_PATH="$2" -G Ninja >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "configuring"; }
  ninja -C "$1" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "building"; }
}

cmake --install "$build_folder" --prefix "$work/installed" >/dev/null
cp -r -- "$source_folder/samples/plugin" "$work/plugin"
build_plugin "$work/built" "$work/installed"

lightloom=$work/installed/bin/lightloom
scene=$source_folder/samples/scenes/atrium.scene.json
render() { # render NAME OPTION...
  local out=$work/$1
  shift
  "$lightloom" render "$work/installed/share/lightloom/graphs/paper.json" --scene "$scene" --size 80x60 --trace-size 40x30 \
    --set resolution=32 --validate --out "$out" "$@" 2>"$work/messages" >/dev/null || { cat "$work/messages" >&2; fail "rendering"; }
  ! grep -q 'validation:' "$work/messages" || fail "validation: $(cat "$work/messages")"
}
render own --plugin "$work/built/sky_light.so" --swap trace=sky_light_trace
render paper
! cmp -s "$work/own/radiance.0000.exr" "$work/paper/radiance.0000.exr" || fail "the plug-in's picture is the paper's"
grep -q '"name": "sky_light"' "$work/own/run.json" || fail "run.json does not name the plug-in"
grep -q '"type": "sky_light_trace"' "$work/own/run.json" || fail "run.json does not name the pass"

# The effect on the picture: with amount 0 the picture is what it would be without, else it is another.
sharpened() { # sharpened NAME OPTION...
  local out=$work/$1
  shift
  "$lightloom" render "$work/plugin/sharpened.json" --scene "$scene" --size 80x60 --set voxelize.resolution=32 \
    --set trace.paths=1 --plugin "$work/built/sharpen.so" --validate --out "$out" "$@" 2>"$work/messages" >/dev/null ||
    { cat "$work/messages" >&2; fail "sharpening"; }
  ! grep -q 'validation:' "$work/messages" || fail "validation: $(cat "$work/messages")"
}
sharpened plain --disable sharpen
sharpened zero --set sharpen.amount=0
sharpened sharp
cmp -s "$work/plain/image.0000.png" "$work/zero/image.0000.png" || fail "an amount of 0 changes the picture"
! cmp -s "$work/plain/image.0000.png" "$work/sharp/image.0000.png" || fail "an amount of 1 changes nothing"

# Skeletons as they come out: the plug-in, and the shader alone, which do the same.
(cd "$work" && "$lightloom" new pass glow >"$work/next" && "$lightloom" new pass glimmer --compute >/dev/null)
grep -q -- "-DCMAKE_PREFIX_PATH=$work/installed" "$work/next" || fail "it does not say where Lightloom is: $(cat "$work/next")"
grep '^  cmake' "$work/next" | (cd "$work" && bash -e) >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "building the skeleton"; }
skeleton() { # skeleton NAME OPTION...
  "$lightloom" render "$work/$1/$1.json" --scene "$scene" --size 80x60 --set voxelize.resolution=32 --set trace.paths=1 \
    --validate --out "$work/$1.out" "${@:2}" 2>"$work/messages" >/dev/null || { cat "$work/messages" >&2; fail "rendering $1"; }
  ! grep -q 'validation:' "$work/messages" || fail "validation: $(cat "$work/messages")"
}
skeleton glow --plugin "$work/glow/build/glow_pass.so"
skeleton glimmer
cmp -s "$work/glow.out/image.0000.png" "$work/glimmer.out/image.0000.png" || fail "the two skeletons differ"
! cmp -s "$work/glow.out/image.0000.png" "$work/plain/image.0000.png" || fail "the skeletons do nothing"

# Named by the environment, and known to the other commands.
# The lists go through files: "grep -q" would close a pipe at its first match, before all of the list is written.
LIGHTLOOM_PLUGINS=$work/built/sky_light.so "$lightloom" passes >"$work/with"
grep -q sky_light_trace "$work/with" || fail "passes does not list it"
LIGHTLOOM_PLUGINS=$work/built/sky_light.so "$lightloom" schema graph --out "$work/schema"
grep -q type_sky_light_trace "$work/schema" || fail "the schema lacks it"
"$lightloom" passes >"$work/without"
! grep -q sky_light_trace "$work/without" || fail "it is there without being loaded"

# Built against other headers.
sed -i 's/kPluginRevision = [0-9]*/kPluginRevision = 999999/' "$work/installed/include/lightloom/framework/graph/plugin.hpp"
build_plugin "$work/other" "$work/installed"
status=0
"$lightloom" --plugin "$work/other/sky_light.so" passes >"$work/out" 2>"$work/messages" || status=$?
[[ $status -eq 3 ]] || fail "a plug-in of another interface ends with exit code $status, not 3"
grep -q 'was built against Lightloom .* with another interface' "$work/messages" || fail "the refusal says: $(cat "$work/messages")"
[[ ! -s $work/out ]] || fail "a refused plug-in still gives results"
