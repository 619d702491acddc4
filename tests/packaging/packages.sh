#!/usr/bin/env bash
# Makes the Debian packages of a build, installs them into their own root, renders and writes a plugin with them,
# removes them, and checks that nothing is left. Writes nothing outside SCRATCH_DIR, and does not need root.
#   packages.sh BUILD_DIR SCRATCH_DIR CMAKE CXX
# Exit code 77: it cannot run here; it prints the reason.
set -euo pipefail
build=$1 scratch=$2 cmake=$3 cxx=$4
here=$(cd "$(dirname "$0")" && pwd)
say() { printf '== %s\n' "$*"; }
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
skip() { printf 'SKIPPED: %s\n' "$*"; exit 77; }
quiet() { "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "$*"; }; }

for tool in dpkg dpkg-deb dpkg-query dpkg-shlibdeps file lintian; do
    command -v "$tool" >/dev/null || skip "$tool is not installed"
done
for package in g++ cmake make catch2; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
        skip "candela-dev needs $package, which is not installed as a package here"
done
rm -rf "$scratch"
mkdir -p "$scratch/bin"
ln -s /bin/true "$scratch/bin/ldconfig"

say "make the packages"
quiet "$(dirname "$cmake")/cpack" --config "$build/CPackConfig.cmake" -B "$scratch/packages"
runtime=("$scratch"/packages/candela_*.deb)
formats=("$scratch"/packages/candela-openimageio_*.deb)
development=("$scratch"/packages/candela-dev_*.deb)
python=()
[ ! -e "$build/lib/python3/dist-packages/candela/__init__.py" ] || python=("$scratch"/packages/python3-candela_*.deb)
for package in "${runtime[0]}" "${formats[0]}" "${development[0]}" "${python[@]}"; do
    [ -f "$package" ] || fail "not all packages were made: $package is missing"
    [ "$(dpkg-deb -f "$package" Version)" = "$(dpkg-deb -f "${runtime[0]}" Version)" ] || fail "versions differ"
done
dpkg-deb -f "${runtime[0]}" Depends | grep -q libtbb || fail "the core's libraries are not among the dependencies"
if dpkg-deb -f "${runtime[0]}" Depends | grep -qi 'openimageio\|openexr'; then
    fail "candela depends on OpenImageIO, which only candela-openimageio should"
fi
dpkg-deb -f "${formats[0]}" Depends | grep -q libopenimageio || fail "candela-openimageio does not depend on OpenImageIO"
say "lintian finds no errors"
# As root it needs an option to run; it only reads the packages.
lintian --allow-root --fail-on error --tag-display-limit 0 "$scratch"/packages/*.deb >"$scratch/log" 2>&1 ||
    { cat "$scratch/log" >&2; fail "lintian has found errors"; }
for package in "${runtime[0]}" "${formats[0]}" "${development[0]}"; do
    # Two spaces would mean preformatted text.
    if dpkg-deb -f "$package" Description | grep -q '^  '; then fail "the description of $package is indented"; fi
done

# A root with the machine's list of packages, so that dpkg itself decides whether all dependencies are met. CPack's scripts,
# which call ldconfig, run outside of it (it has no shell), and neither they nor triggers may write the machine's own cache of
# libraries.
root=$scratch/root
mkdir -p "$root/var/lib/dpkg/info" "$root/var/lib/dpkg/updates" "$root/usr/lib"
ln -s usr/lib "$root/lib"
touch "$root/usr/lib/of-another-package"  # dpkg removes a folder once it is empty
for file in status arch info/format; do
    [ ! -e "/var/lib/dpkg/$file" ] || cp "/var/lib/dpkg/$file" "$root/var/lib/dpkg/$file"
done
package_manager() {
    PATH=$scratch/bin:$PATH:/usr/sbin:/sbin dpkg --root="$root" --log="$scratch/dpkg.log" --no-triggers \
        --force-not-root --force-script-chrootless "$@"
}
files() { (cd "$root" && find . -path ./var -prune -o -print | sort); }
files >"$scratch/before"

say "a package without what it depends on is refused"
if package_manager -i "${development[@]}" >"$scratch/log" 2>&1; then fail "candela-dev was installed without candela"; fi
grep -q "candela-dev depends on candela (= " "$scratch/log" || { cat "$scratch/log" >&2; fail "it was refused for another reason"; }
quiet package_manager --purge candela-dev

say "install"
quiet package_manager -i "${runtime[@]}"
dpkg-deb --info "${runtime[0]}" triggers | grep -q "^activate-noawait ldconfig" || fail "the loader's cache would not be written"
[ "$(dpkg-query --admindir="$root/var/lib/dpkg" -W -f '${db:Status-Status}' candela)" = installed ] || fail "not installed"
candela=$root/usr/bin/candela
quiet "$candela" render -o "$scratch/picture.png"
[ "$(head -c 8 "$scratch/picture.png" | od -An -tx1 | tr -d ' ')" = 89504e470d0a1a0a ] || fail "no PNG was rendered"
"$build/bin/candela" render -o "$scratch/built.png" 2>"$scratch/log"
cmp -s "$scratch/picture.png" "$scratch/built.png" || fail "the installed command's picture differs from the built one's"
for target in cpp opengl webgl; do quiet "$candela" generate --target $target -o "$scratch/$target"; done

say "a PNG file is read without candela-openimageio"
quiet "$candela" render "$here/../../docs/examples/glass.toml" --width 64 --height 40 -o "$scratch/glass.png"

say "messages name candela-openimageio for its features, which work once it is installed"
asks() {
    local code=0
    "$@" >"$scratch/log" 2>&1 || code=$?
    { [ "$code" -ne 0 ] && grep -q 'candela-openimageio' "$scratch/log"; } ||
        { cat "$scratch/log" >&2; fail "no message names the package that $* needs (exit code $code)"; }
}
asks "$candela" render -o "$scratch/picture.exr"
asks "$candela" diff "$scratch/picture.png" "$scratch/built.png"
asks "$candela" verify --target cpp --report "$scratch/report"
[ ! -e "$scratch/report" ] || fail "verify started a report that it cannot finish"
quiet package_manager -i "${formats[@]}"
quiet "$candela" render -o "$scratch/picture.exr"
quiet "$candela" verify --target cpp --width 120 --height 120
quiet "$candela" diff --tolerance 0 "$scratch/picture.png" "$scratch/built.png"
"$candela" plugin doctor --plugin-dir "$root/usr/lib/candela/plugins" >"$scratch/log" || { cat "$scratch/log" >&2; fail "the doctor"; }
code=0
"$candela" plugin test "$root/usr/lib/candela/plugins/light-point.so" 2>"$scratch/log" || code=$?
{ [ "$code" -eq 1 ] && grep -q 'package candela-dev' "$scratch/log"; } || fail "no message says that the kit is in candela-dev"
code=0
"$candela" plugin new light x "$scratch/x" 2>"$scratch/log" || code=$?
{ [ "$code" -eq 1 ] && grep -q 'package candela-dev' "$scratch/log"; } || fail "no message says that templates are in candela-dev"

if [ ${#python[@]} -gt 0 ]; then
    say "the Python module, with only the installed packages"
    quiet package_manager -i "${python[@]}"
    cat >"$scratch/picture.py" <<'END'
import sys
import candela
assert candela.__file__.startswith(sys.argv[1]), candela.__file__
candela.Scene.load().render().save(sys.argv[2])
END
    PYTHONPATH=$root/usr/lib/python3/dist-packages quiet /usr/bin/python3 -B "$scratch/picture.py" "$root" "$scratch/python.png"
    quiet "$candela" diff --tolerance 0 "$scratch/python.png" "$scratch/built.png"
    quiet package_manager --purge python3-candela
fi

say "a plugin from scratch, with only the installed packages"
quiet package_manager -i "${development[@]}"
# Only one kind: templates.sh tests the others with `cmake --install`.
bash "$here/templates.sh" --installed "$root/usr" "$scratch/templates" "$cmake" "$cxx" light
say "a program that embeds Candela, with only the installed packages"
bash "$here/embedding.sh" "$root/usr" "$scratch/embedding" "$cmake" "$cxx"
interface=$(sed -n 's/^#define CANDELA_INTERFACE_VERSION //p' "$root/usr/include/candela/plugin/abi.h")
[ "$(dpkg-deb -f "${runtime[0]}" Provides)" = "candela-plugin-interface-$interface" ] || fail "the interface is not provided"

say "found through /lib, it is the same package"
mkdir "$scratch/through-lib"
cat >"$scratch/through-lib/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.28)
project(through-lib LANGUAGES CXX)
find_package(candela REQUIRED PATHS ${ROOT}/lib/cmake/candela NO_DEFAULT_PATH)
get_target_property(directories candela::api INTERFACE_INCLUDE_DIRECTORIES)
foreach(directory IN LISTS directories)
    if(NOT EXISTS ${directory}/candela/plugin.h)
        message(FATAL_ERROR "${directory} has no candela/plugin.h")
    endif()
endforeach()
END
quiet "$cmake" -G Ninja -S "$scratch/through-lib" -B "$scratch/through-lib/build" -DCMAKE_CXX_COMPILER="$cxx" -DROOT="$root"

say "remove"
quiet package_manager --purge candela candela-openimageio candela-dev
if dpkg-query --admindir="$root/var/lib/dpkg" -W candela candela-openimageio candela-dev >"$scratch/log" 2>&1; then fail "dpkg still lists them"; fi
files >"$scratch/after"
diff "$scratch/before" "$scratch/after" >&2 || fail "this is left behind"
say "all well"
