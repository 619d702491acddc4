#!/usr/bin/env bash
# Makes the wheel of a build, installs it into a virtual environment, and renders, compiles a kernel and checks a model with
# only that.
#   wheel.sh BUILD_DIR SCRATCH_DIR SOURCE_DIR PYTHON
# Exit code 77: it cannot run here; it prints the reason.
set -euo pipefail
build=$1 scratch=$2 source=$3 python=$4
say() { printf '== %s\n' "$*"; }
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
quiet() { "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "$*"; }; }

"$python" -c 'import build, ensurepip, scikit_build_core' 2>/dev/null ||
    { echo "SKIPPED: python3-build, python3-venv or python3-scikit-build-core is not installed here"; exit 77; }
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
unset PYTHONPATH CANDELA_PLUGIN_PATH
export XDG_DATA_HOME=$scratch/data XDG_CACHE_HOME=$scratch/cache

say "a build without the module is refused, with advice"
code=0
"$python" -m build --wheel --no-isolation -C cmake.define.CANDELA_BUILD="$scratch" --outdir "$scratch/wheels" \
    "$source/scripts/packaging/wheel" >"$scratch/log" 2>&1 || code=$?
# CMake breaks lines.
{ [ "$code" -ne 0 ] && tr -s '\n ' ' ' <"$scratch/log" | grep 'does not have the Python module. scripts/package.sh builds it' >"$scratch/said"; } ||
    { cat "$scratch/log" >&2; fail "it was not"; }

say "make the wheel"
quiet "$python" -m build --wheel --no-isolation -C cmake.define.CANDELA_BUILD="$build" --outdir "$scratch/wheels" \
    "$source/scripts/packaging/wheel"
wheels=("$scratch"/wheels/candela-*.whl)
[ -f "${wheels[0]}" ] || fail "no wheel was made"

say "install it, with the machine's NumPy"
quiet "$python" -m venv --system-site-packages "$scratch/venv"
quiet "$scratch/venv/bin/pip" install --no-index "${wheels[0]}"

cat >"$scratch/picture.py" <<'END'
import pathlib
import re
import sys

import candela

venv, picture = sys.argv[1:]
candela.Scene.load().render().save(picture)
kernel = candela.kernel_reflection("""
struct HalfMaterial {
    float kd;
};
KERNEL Reflected half_reflect(HalfMaterial m, Surface s, vec3 to_light) {
    return Reflected(m.kd * s.color * dot(s.normal, to_light), vec3(0.0f));
}
""", kd=0.5)
reflected = kernel.evaluate([0, 1, 0], [0, 1, 0], [0, 1, 0], color=[1, 1, 1])
assert abs(reflected - 0.5).max() < 1e-6, reflected
assert {check.outcome for check in candela.conformance("light/point")} <= {"passed", "skipped"}
loaded = set(re.findall(r"/\S*candela\S*\.so\S*", pathlib.Path("/proc/self/maps").read_text()))
elsewhere = [path for path in loaded if not path.startswith(venv) and "candela/kernels/" not in path]
assert loaded and not elsewhere, elsewhere
END
say "the picture is the command's, and nothing is loaded from elsewhere"
quiet "$scratch/venv/bin/python" -B "$scratch/picture.py" "$scratch/venv/" "$scratch/python.png"
quiet "$build/bin/candela" render -o "$scratch/command.png"
cmp "$scratch/python.png" "$scratch/command.png" || fail "the wheel's picture differs from the command's"

say "a type checker finds the annotations, and the licence is there"
for file in candela/py.typed candela/_candela.pyi candela-*.dist-info/licenses/LICENSE; do
    compgen -G "$scratch/venv/lib/python3*/site-packages/$file" >/dev/null || fail "$file is not installed"
done

say "remove it"
quiet "$scratch/venv/bin/pip" uninstall --yes candela
# Only paths within it: the checkout may also have that name.
left=$(cd "$scratch/venv" && find . -path '*candela*')
[ -z "$left" ] || fail "left behind: $left"
say "all well"
