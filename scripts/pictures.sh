#!/usr/bin/env bash
# Renders the documentation's pictures again: docs/pictures/*, and writes the pages of models that they belong to.
#   scripts/pictures.sh [directory]     to another directory
# The contact sheet is one scene: in each cell a coarse sphere and a coarse teapot with their own shading and reflection model,
# all in the same light.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
out=${1:-$root/docs/pictures}
mkdir -p "$out"

render() { "$root/scripts/render.sh" "$@"; }

# object 'KEYS; OF; IT' X Y SHADING REFLECTION MATERIAL
object() {
    printf '[[object]]\n'
    tr ';' '\n' <<<"$1"
    printf 'position = [%s, %s, 0.0]\nshading = "%s"\nreflection = "%s"\n%s\n' "$2" "$3" "$4" "$5" "$6"
}

# The light of both sheets.
sheet_head() {
    cat <<'TOML'
version = 1
[room]
width = 20.0
[observer]
position   = [0.0, 0.0, 4.0]
look_at    = [0.0, 0.0, 0.0]
projection = "orthographic"
height     = 4.5
[image]
width      = 1040
height     = 450
samples    = 16
background = [24, 26, 32]
[[light]]
type      = "directional"
direction = [1.0, -1.1, -1.2]
intensity = 0.9
[[light]]
type      = "directional"
direction = [-1.0, 0.2, -0.6]
color     = [120, 140, 200]
intensity = 0.25
[[light]]
type  = "ambient"
color = [150, 155, 180]
TOML
}

contact_sheet() {
    sheet_head
    local row=0 shading column reflection x y material
    for shading in flat gouraud phong; do
        column=0
        for reflection in lambert half-lambert phong blinn-phong; do
            x=$(awk "BEGIN { print -3.9 + 2.6 * $column }")
            y=$(awk "BEGIN { print 1.5 - 1.5 * $row }")
            material=
            case $reflection in *phong) material='material = { kd = 0.6, ks = 0.4, shininess = 30.0 }' ;; esac
            object 'type = "sphere"; radius = 0.48; segments = 16; rotation = [12.0, 20.0, 0.0]; color = [200, 96, 48]' \
                "$(awk "BEGIN { print $x - 0.74 }")" "$y" "$shading" "$reflection" "$material"
            object 'type = "teapot"; size = 0.72; segments = 3; rotation = [24.0, 20.0, 0.0]; color = [70, 130, 190]' \
                "$(awk "BEGIN { print $x + 0.42 }")" "$y" "$shading" "$reflection" "$material"
            column=$((column + 1))
        done
        row=$((row + 1))
    done
}

# Every opaque reflection model, on the same fine sphere and teapot.
reflection_sheet() {
    sheet_head | sed 's/^height     = 4.5/height     = 6.0/; s/^height     = 450/height     = 600/'
    local i=0 x y reflection material
    for reflection in lambert half-lambert oren-nayar eon minnaert phong blinn-phong cook-torrance beckmann ggx disney ward ashikhmin-shirley kajiya-kay toon gooch; do
        x=$(awk "BEGIN { print -3.9 + 2.6 * ($i % 4) }")
        y=$(awk "BEGIN { print 2.25 - 1.5 * int($i / 4) }")
        case $reflection in
            *phong) material='material = { kd = 0.6, ks = 0.4, shininess = 30.0 }' ;;
            oren-nayar) material='material = { sigma = 40.0 }' ;;
            eon) material='material = { roughness = 1.0 }' ;;
            disney) material='material = { roughness = 0.4, clearcoat = 1.0, clearcoat_gloss = 0.8 }' ;;
            kajiya-kay) material='material = { kd = 0.4, ks = 0.4 }' ;;
            cook-torrance | beckmann | ggx) material='material = { kd = 0.6, ks = 0.4, roughness = 0.25, ior = 3.0 }' ;;
            ward) material='material = { kd = 0.4, ks = 0.6 }' ;;
            ashikhmin-shirley) material='material = { ks = 0.2 }' ;;
            toon) material='material = { bands = 3, ks = 0.4 }' ;;
            *) material= ;;
        esac
        object 'type = "sphere"; radius = 0.48; rotation = [12.0, 20.0, 0.0]; color = [200, 96, 48]' \
            "$(awk "BEGIN { print $x - 0.74 }")" "$y" phong "$reflection" "$material"
        object 'type = "teapot"; size = 0.72; segments = 16; rotation = [24.0, 20.0, 0.0]; color = [70, 130, 190]' \
            "$(awk "BEGIN { print $x + 0.42 }")" "$y" phong "$reflection" "$material"
        i=$((i + 1))
    done
}

# A coarse sphere and a coarse ring whose terminator is in sight. With "naive", each is there twice: once to be seen, and once, open for light
# in no direction, to cast shadows on the first.
terminator_scene() {
    sheet_head | sed '/^\[\[light\]\]/,$d; s/^width      = 1040/width      = 640/; s/^height     = 4.5/height     = 2.3/; s/^height     = 450/height     = 300/'
    printf '[constraints]\noverlap = "allow"\n[shadows]\nenabled = true\n[[light]]\ntype = "directional"\ndirection = [-1.0, -0.55, -0.1]\n'
    printf '[[light]]\ntype = "ambient"\nintensity = 0.3\n'
    local copy copies=treated
    [ "$1" != naive ] || copies='casts_shadows=false encloses=true'
    for copy in $copies; do
        case $copy in treated) copy= ;; *) copy="; $copy" ;; esac
        object "type = \"sphere\"; radius = 0.9; segments = 12; color = [220, 160, 90]$copy" -1.2 0.0 phong lambert ""
        object "type = \"torus\"; major_radius = 0.62; minor_radius = 0.3; segments = 14; rotation = [60.0, 0.0, 0.0]; color = [220, 160, 90]$copy" 1.2 0.0 \
            phong lambert ""
    done
}

sheet=$(mktemp --suffix=.toml)
trap 'rm -f "$sheet"' EXIT
contact_sheet >"$sheet"
render "$sheet" -o "$out/contact-sheet.png"
reflection_sheet >"$sheet"
render "$sheet" -o "$out/reflection-models.png"
render "$root/docs/examples/still-life.toml" -o "$out/still-life.png"
render "$root/docs/examples/glass.toml" -o "$out/glass.png"
render "$root/docs/examples/penumbra.toml" -o "$out/penumbra.png"
render "$root/docs/examples/cornell-box.toml" -o "$out/cornell-box.png"
terminator_scene naive >"$sheet"
render "$sheet" -o "$out/terminator-before.png"
terminator_scene treated >"$sheet"
render "$sheet" -o "$out/terminator.png"
render --samples 16 -o "$out/default-scene.png"

# The pages of models, with their pictures.
python3 -B "$root/scripts/models.py" "$root/build/release/bin/candela" --pictures "$out/models"

# A model in place of a scene.
model=$(mktemp -d)
trap 'rm -rf "$sheet" "$model"' EXIT
python3 -B "$root/scripts/vase.py" "$model"
render "$model/vase.obj" --samples 16 -o "$out/imported.png"

# The generated page, as a browser shows it.
page=$(mktemp -d)
trap 'rm -rf "$sheet" "$model" "$page"' EXIT
"$root/build/release/bin/candela" generate "$root/docs/examples/still-life.toml" --target webgl --models phong,lambert,flat,gouraud,ggx,toon -o "$page" 2>/dev/null
/usr/bin/python3 -B "$root/tests/page/page_picture.py" "$page/scene.html" "$out/page.png"

"$root/build/release/bin/candela" plot phong:shininess=20,ks=0.5,kd=0.3 blinn-phong:shininess=80,ks=0.5,kd=0.3 ggx:roughness=0.2,ks=0.2,ior=4,kd=0.3 \
    -o "$out/lobes.svg"

"$root/build/release/bin/candela" plot light/spot:inner_angle=10,outer_angle=30 light/spot:inner_angle=10,outer_angle=30,falloff=linear \
    light/spot:inner_angle=30,outer_angle=30,attenuation=offset-linear -o "$out/lights.svg"

"$root/build/release/bin/candela" compare "$root/docs/examples/still-life.toml" --width 320 --height 200 \
    --reflection lambert,phong,ggx,toon --shading flat,phong -o "$out/compare.png"

"$root/build/release/bin/candela" compare "$root/docs/examples/still-life.toml" --width 320 --height 200 --columns 3 \
    --terms picture,ambient,diffuse,specular,light.lamp,n_dot_l.lamp,normal,depth,triangle -o "$out/terms.png"

# The page of an exercise, with an answer that wrongly uses an even power.
/usr/bin/python3 -B "$root/tests/page/exercise_picture.py" "$root/build/release/bin/candela" "$out/exercise.png"
# A film, as eight of its frames.
frames=$(mktemp -d)
trap 'rm -rf "$sheet" "$model" "$page" "$frames"' EXIT
"$root/build/release/bin/candela" animate "$root/docs/examples/still-life.toml" --width 320 --height 200 --set animation.frames=8 \
    --set animation.orbit.turns=1 -o "$frames/%d.png" 2>/dev/null
ffmpeg -loglevel error -y -i "$frames/%d.png" -vf tile=4x2 -frames:v 1 "$out/film.png"

# The page while the scene is being edited.
/usr/bin/python3 -B "$root/tests/page/view_picture.py" "$root/build/release/bin/candela" "$root/docs/examples/still-life.toml" "$out/view.png" "$out/explanation.png" \
    "$out/panes.png"
