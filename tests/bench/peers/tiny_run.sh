#!/bin/sh
# The whole comparison at a tiny size: tiny_run.sh LIGHTLOOM SOURCE_DIR FOLDER. Exits with 77 where there is no Blender.
set -eu
if ! command -v blender >/dev/null; then
  echo "SKIPPED, NOTHING COMPARED: blender is not installed (Debian: apt-get install blender embree-tools)"
  exit 77
fi
rm -rf "$3"
mkdir -p "$3"
"$2/tests/bench/peers/peers.py" --lightloom "$1" --scene "$2/samples/scenes/atrium.scene.json" --size 48x36 --paths 2 \
  --rounds 2 --samples 1,2 --frames 1,2 --reference-samples 4 --set resolution=24 --work "$3" \
  --picture "$3/picture.png" --json "$3/figures.json"
test -s "$3/picture.png"
grep -q '"cycles"' "$3/figures.json"
