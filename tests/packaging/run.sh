#!/usr/bin/env bash
# Builds a plugin and a target in their own CMake projects against an installed Candela, and uses them: list, describe, render,
# remove.
#   run.sh BUILD_DIR SCRATCH_DIR CMAKE CXX
set -euo pipefail
build=$1 scratch=$2 cmake=$3 cxx=$4
here=$(cd "$(dirname "$0")" && pwd)

say() { printf '== %s\n' "$*"; }
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
expect() { grep -qF -- "$2" "$1" || { cat "$1" >&2; fail "'$2' is not in the output of $3"; }; }

rm -rf "$scratch"
mkdir -p "$scratch"

say "install, and move the installation, which must be relocatable"
"$cmake" --install "$build" --prefix "$scratch/first" >/dev/null
mv "$scratch/first" "$scratch/prefix"
candela=$scratch/prefix/bin/candela
before=$(sha256sum "$scratch/prefix/lib/libcandela_core.so")

say "build a plugin with only the installation"
cp -r "$here/cel" "$scratch/cel"
"$cmake" -G Ninja -S "$scratch/cel" -B "$scratch/cel/build" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_PREFIX_PATH="$scratch/prefix" >"$scratch/configure.log" 2>&1 ||
    { cat "$scratch/configure.log" >&2; fail "configuring the plugin"; }
"$cmake" --build "$scratch/cel/build" >"$scratch/build.log" 2>&1 || { cat "$scratch/build.log" >&2; fail "building the plugin"; }
plugin=$scratch/cel/build/reflection-cel
[ -f "$plugin.so" ] && [ -f "$plugin.json" ] || fail "no plugin was built"
exported=$(nm -D --defined-only "$plugin.so" | awk '{ print $NF }' | grep -v '^candela_' || true)
[ -z "$exported" ] || fail "the plugin exports more than candela_*: $exported"

say "it is listed, described and renders by name"
mkdir "$scratch/plugins"
cp "$plugin.so" "$plugin.json" "$scratch/plugins/"
export CANDELA_PLUGIN_PATH=$scratch/plugins
"$candela" list reflection >"$scratch/out"
expect "$scratch/out" "Brightness in steps" "candela list"
"$candela" describe reflection/cel >"$scratch/out"
expect "$scratch/out" "steps of brightness" "candela describe"
expect "$scratch/out" "version 1.2.3" "candela describe"
"$candela" schema >"$scratch/out"
expect "$scratch/out" "cel: steps of brightness (an integer, 1 to 16)" "candela schema"
"$candela" render --reflection cel --set object.cube.material.bands=2 -o "$scratch/cel.ppm" 2>"$scratch/out"
"$candela" render -o "$scratch/phong.ppm" 2>"$scratch/out"
cmp -s "$scratch/cel.ppm" "$scratch/phong.ppm" && fail "cel looks like Phong"
# Two bands without a highlight, but still 1/r^2 from the lamp: the picture is neither constant nor black.
[ "$(tail -c +16 "$scratch/cel.ppm" | od -An -v -tu1 -w3 | sort -u | wc -l)" -gt 20 ] || fail "the cel picture is empty"

say "a program is generated with its formula, and renders the same as Candela"
"$candela" generate --target cpp --reflection cel -o "$scratch/program" 2>"$scratch/out"
grep -q "Brightness in steps, as in cartoons" "$scratch/program/scene.cpp" || fail "the kernel is not in the program"
"$candela" verify --target cpp --program "$scratch/program" --reflection cel --width 160 --height 160 >"$scratch/out" 2>&1 &&
    fail "a program for another size passed as the same picture"
"$candela" verify --target cpp --reflection cel --width 160 --height 160 >"$scratch/out" 2>&1 || { cat "$scratch/out" >&2; fail "verify"; }
expect "$scratch/out" "match" "candela verify"

say "a target is built in the same way, is listed and described, writes a scene and conforms"
cp -r "$here/csv" "$scratch/csv"
"$cmake" -G Ninja -S "$scratch/csv" -B "$scratch/csv/build" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_PREFIX_PATH="$scratch/prefix" >"$scratch/configure.log" 2>&1 ||
    { cat "$scratch/configure.log" >&2; fail "configuring the target"; }
"$cmake" --build "$scratch/csv/build" >"$scratch/build.log" 2>&1 || { cat "$scratch/build.log" >&2; fail "building the target"; }
csv=$scratch/csv/build
"$candela" list target --plugin-dir "$csv" >"$scratch/out"
expect "$scratch/out" "for spreadsheets" "candela list target"
"$candela" describe target/csv --plugin-dir "$csv" >"$scratch/out"
expect "$scratch/out" "CSV (target/csv), version 1.0.0" "candela describe"
"$candela" generate --target csv --plugin-dir "$csv" -o "$scratch/tables" 2>"$scratch/out"
expect "$scratch/tables/lights.csv" ",point,intensity,2.5" "candela generate"
expect "$scratch/tables/objects.csv" "cube,cube,phong,phong,1" "candela generate"
[ "$(wc -l <"$scratch/tables/meshes/triangles.csv")" -eq 13 ] || fail "a cube has twelve triangles"
printf 'v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n' >"$scratch/red.obj"
printf 'version = 1\n[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n[[light]]\ntype = "ambient"\n[[object]]\ntype = "mesh"\nfile = "red.obj"\n' >"$scratch/red.toml"
code=0
"$candela" generate --defaults --target csv --plugin-dir "$csv" "$scratch/red.toml" -o "$scratch/red" 2>"$scratch/out" || code=$?
[ "$code" -eq 1 ] || fail "exit code $code for vertex colours that the target does not support"
expect "$scratch/out" "has vertex colours, which this target does not support" "candela generate"
[ ! -e "$scratch/red" ] || fail "a refused scene left output"
code=0
"$candela" verify --target csv --plugin-dir "$csv" 2>"$scratch/out" || code=$?
[ "$code" -eq 2 ] || fail "exit code $code for a target that draws nothing"
expect "$scratch/out" "target/csv does not draw a picture" "candela verify"
code=0
"$candela" generate --target csw --plugin-dir "$csv" 2>"$scratch/out" || code=$?
expect "$scratch/out" "unknown target 'csw'; did you mean 'csv'? (possible: cpp, csv, gltf, opengl, povray, three, webgl)" "candela generate"
"$candela" plugin test "$csv/target-csv.so" >"$scratch/out" || { cat "$scratch/out" >&2; fail "the target does not conform"; }

say "a plugin with its own library and files finds both, wherever the three are moved"
cp -r "$here/companion" "$scratch/companion"
"$cmake" -G Ninja -S "$scratch/companion" -B "$scratch/companion/build" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_PREFIX_PATH="$scratch/prefix" >"$scratch/configure.log" 2>&1 ||
    { cat "$scratch/configure.log" >&2; fail "configuring the plugin with companions"; }
"$cmake" --build "$scratch/companion/build" >"$scratch/build.log" 2>&1 || { cat "$scratch/build.log" >&2; fail "building it"; }
readelf -d "$scratch/companion/build/reflection-companion.so" >"$scratch/out"
if grep -E 'R(UN)?PATH.*(\[:|::|:\])' "$scratch/out" >&2; then fail "the loader would search the current folder"; fi
mkdir "$scratch/copied"
cp -r "$scratch"/companion/build/{*.so,*.json,reflection-companion} "$scratch/copied"
"$cmake" --install "$scratch/companion/build" --prefix "$scratch/elsewhere" >"$scratch/out"
rm -r "$scratch/companion"
mv "$scratch/copied" "$scratch/moved"
mv "$scratch/elsewhere" "$scratch/installed"
for plugins in "$scratch/moved" "$scratch/installed/lib/candela/plugins"; do
    "$candela" plugin test "$plugins/reflection-companion.so" >"$scratch/out" || { cat "$scratch/out" >&2; fail "it does not conform in $plugins"; }
    "$candela" render --plugin-dir "$plugins" --reflection companion -o "$scratch/companion.ppm" 2>"$scratch/out" ||
        { cat "$scratch/out" >&2; fail "it does not render in $plugins"; }
done
rm "$scratch/moved/reflection-companion/share.txt"
if "$candela" render --plugin-dir "$scratch/moved" --reflection companion -o "$scratch/no.ppm" 2>"$scratch/out"; then
    fail "the files of another folder are used"
fi
expect "$scratch/out" "moved/reflection-companion/share.txt" "candela render"
rm -r "$scratch/moved" "$scratch/installed"

say "with the directory flag, and wrong values are explained"
unset CANDELA_PLUGIN_PATH
"$candela" render --plugin-dir "$scratch/plugins" --reflection cel -o "$scratch/flag.ppm" 2>"$scratch/out"
code=0
"$candela" render --plugin-dir "$scratch/plugins" --reflection cel --set object.cube.material.bands=99 \
    -o "$scratch/no.ppm" 2>"$scratch/out" || code=$?
[ "$code" -eq 3 ] || fail "exit code $code for bands = 99"
expect "$scratch/out" "1 to 16" "bands = 99"
[ ! -e "$scratch/no.ppm" ] || fail "a picture was written in spite of the error"

say "once removed, its name is unknown"
code=0
"$candela" render --reflection cel -o "$scratch/no.ppm" 2>"$scratch/out" || code=$?
[ "$code" -eq 3 ] || fail "exit code $code for an unknown model"
expect "$scratch/out" "no reflection plugin is called 'cel'" "candela render"
[ "$(sha256sum "$scratch/prefix/lib/libcandela_core.so")" = "$before" ] || fail "the core was modified"
say "all well"
