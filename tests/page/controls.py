"""Checks that controls do what options of the command line do."""
import scenes
from generated import SCRATCH, SMALL_WINDOW, Generated, PageTest, options_for

# Some parameters of reflection models have no visible effect at the defaults of the others: they are tried with these values.
NEEDS = {
    "beckmann.masking": {"ks": 1, "roughness": 1, "ior": 100},
    "disney.sheen_tint": {"sheen": 1},
    "disney.clearcoat_gloss": {"clearcoat": 1},
    "metallic-roughness.clearcoat_roughness": {"clearcoat": 1},
    "metallic-roughness.sheen_roughness": {"sheen_color": 0.8},
    "metallic-roughness.anisotropy_rotation": {"anisotropy_strength": 0.8},
    "metallic-roughness.iridescence_ior": {"iridescence": 1},
    "metallic-roughness.iridescence_thickness": {"iridescence": 1},
    "openpbr.coat_color": {"coat_weight": 1},
    "openpbr.coat_roughness": {"coat_weight": 1},
    "openpbr.coat_roughness_anisotropy": {"coat_weight": 1, "coat_roughness": 0.5},
    "openpbr.coat_ior": {"coat_weight": 1},
    "openpbr.coat_darkening": {"coat_weight": 1},
    "openpbr.fuzz_color": {"fuzz_weight": 1},
    "openpbr.fuzz_roughness": {"fuzz_weight": 1},
}

# Sheen and masking show where light grazes the surface.
LIGHT_FROM_BEHIND = """
[[light]]
type = "directional"
direction = [-0.3, -0.5, 0.8]
"""


def another(number, least, most):
    """Another allowed number of the same kind, far enough away to be visible."""
    for candidate in (number * 0.5, number * 1.6, number + 0.4, least):
        if least <= candidate <= most and abs(candidate - number) > 1e-3:
            return candidate
    raise AssertionError(f"no other number than {number} from {least} to {most}")


class Controls(PageTest):
    """Uses each control as a person would, then resets everything."""

    window = SMALL_WINDOW

    def settings(self):
        return self.browser.run("return [...document.querySelectorAll('.setting')].map((s) => s.dataset.path)")

    def value_shown(self, path):
        return self.browser.run("""
            const setting = document.querySelector(`[data-path="${arguments[0]}"]`);
            const numbers = [...setting.querySelectorAll("input[type=number]")].map((input) => Number(input.value));
            if (numbers.length > 0) return numbers.length === 1 ? numbers[0] : numbers;
            const input = setting.querySelector("input, select");
            if (input.type === "color") return [1, 3, 5].map((at) => parseInt(input.value.slice(at, at + 2), 16));
            return input.type === "checkbox" ? input.checked : input.value;""", path)

    def try_input(self, generated, own, path, selector, value, options=()):
        what = f"{path}, {selector.split('] ')[-1]} = {value}"
        self.browser.enter(selector, value)
        shown = self.value_shown(path)
        page = self.picture(generated)
        self.assert_alike(page, generated.render(*options, *options_for(path, shown)), f"{what}, shown as {shown}", before=own)
        self.assertTrue(self.browser.run("return document.querySelector(arguments[0]).classList.contains('changed')", f'[data-path="{path}"]'), what)

    def inputs(self, path):
        """(selector, type, value, least, most) of a setting's inputs."""
        described = self.browser.run("""
            const setting = document.querySelector(`[data-path="${arguments[0]}"]`);
            return [...setting.querySelectorAll("input, select")].map((input, i) => {
                input.dataset.test = i;
                const options = input.options ? [...input.options].map((option) => option.value) : [];
                return [i, input.type, input.value, input.min, input.max, options];
            });""", path)
        for i, kind, value, least, most, options in described:
            yield f'[data-path="{path}"] [data-test="{i}"]', kind, value, least, most, options

    def new_values(self, path, kind, value, least, most, options):
        if kind == "checkbox":
            return [False]
        if kind == "color":
            return ["#c86414"]
        if kind == "select-one":
            return [option for option in options if option not in ("", value, self.own_model.get(path))]
        if path.endswith(("position", "look_at", "direction", "up", "edge_u", "edge_v")):
            return [float(value) + (0.35 if kind == "number" or float(value) + 0.35 <= float(most) else -0.35)]
        if path.endswith("rotation"):
            return [float(value) + 40]
        least, most = float(least or "-inf"), float(most or "inf")
        number = another(float(value), least, most)
        return [int(number) if path.endswith(("samples_u", "samples_v", "bands")) else number]

    def try_setting(self, generated, own, path, undo, options=(), kinds=None):
        for selector, kind, *described in list(self.inputs(path)):
            if kinds is not None and kind not in kinds:
                continue
            for new in self.new_values(path, kind, *described):
                undo()
                list(self.inputs(path))  # these may also be rebuilt
                self.try_input(generated, own, path, selector, new, options)

    def reset(self):
        self.browser.click("reset-all")
        self.browser.unfold_all()

    def check_all(self, generated):
        self.browser.open(generated.address)
        self.browser.unfold_all()
        self.own_model = {kind: generated.scene["objects"][-1][kind] for kind in ("shading", "reflection")}
        own = self.picture(generated)
        paths = self.settings()
        expected = {f"object.{i}.color" for i in range(len(generated.scene["objects"]))}
        for i, light in enumerate(generated.scene["lights"]):
            names = [p["name"] for p in generated.scene["light_models"][light["model"]]["parameters"]]
            expected |= {f"light.{i}.on", *(f"light.{i}.value.{name}" for name in names)}
        for i, thing in enumerate(generated.scene["objects"]):
            names = [p["name"] for p in generated.scene["reflection_models"][thing["reflection"]]["parameters"]]
            expected |= {f"object.{i}.material.{thing['reflection']}.{name}" for name in names}
        self.assertLessEqual(expected | {"shading", "reflection"}, set(paths))
        for path in paths:
            with self.subTest(path):
                self.try_setting(generated, own, path, self.reset)
            self.reset()
            self.assertEqual(self.picture(generated).pixels, own.pixels, f"{path}: reset")
        self.assertEqual(self.browser.errors(), [])

    def test_perspective(self):
        self.check_all(Generated("controls-perspective", scenes.PERSPECTIVE))

    def test_orthographic(self):
        self.check_all(Generated("controls-orthographic", scenes.ORTHOGRAPHIC))

    def test_materials_of_other_models(self):
        generated = Generated("materials", scenes.PERSPECTIVE + LIGHT_FROM_BEHIND)
        self.browser.open(generated.address)
        unused = set(NEEDS)
        self.own_model = {}
        for model in generated.scene["reflection_models"]:
            prefix = f"object.1.material.{model}."

            def choose(needs=()):
                self.browser.click("reset-all")
                self.browser.enter("[data-path=reflection] select", model)
                self.browser.unfold_all()
                for name, value in dict(needs).items():
                    self.browser.enter(f'[data-path="{prefix}{name}"] input[type=number]', value)

            choose()
            own = self.picture(generated)
            for path in [p for p in self.settings() if p.startswith(prefix)]:
                with self.subTest(path):
                    needs = NEEDS.get(path.removeprefix("object.1.material."), {})
                    unused.discard(path.removeprefix("object.1.material."))
                    choose(needs)
                    before = self.picture(generated) if needs else own
                    options = ["--reflection", model]
                    for name, value in needs.items():
                        options += options_for(prefix + name, value)
                    self.try_setting(generated, before, path, lambda: choose(needs), options, ("number", "select-one"))
        self.assertEqual(unused, set(), "no such parameter")

    def test_one_channel(self):
        generated = Generated("channels", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        self.browser.unfold_all()
        own = self.picture(generated)
        path = "object.0.material.lambert.kd"
        self.assertEqual(self.value_shown(path), 0.7)
        self.browser.run("document.querySelector(arguments[0]).click()", f'[data-path="{path}"] .split')
        self.assertEqual(self.picture(generated).pixels, own.pixels)
        selector = [s for s, kind, *_ in self.inputs(path) if kind == "number"][1]
        self.try_input(generated, own, path, selector, 0.2)
        self.assertEqual(self.value_shown(path), [0.7, 0.2, 0.7])

    def test_a_preset_sets_the_figures_of_its_source(self):
        generated = Generated("presets", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        self.browser.unfold_all()
        own = self.picture(generated)
        balls = "return [...document.querySelectorAll('#objects details')][1].querySelector('.preset select')"
        choose = lambda name: self.browser.run(f"""
            const select = (() => {{ {balls} }})();
            select.value = [...select.options].find((option) => option.textContent === arguments[0]).value;
            select.dispatchEvent(new Event("change"));""", name)
        chosen = lambda: self.browser.run(f"const select = (() => {{ {balls} }})(); return select.selectedOptions[0].textContent")
        self.assertEqual(chosen(), "custom")
        # OpenGL's gold, as in Kilgard's teapots.c.
        choose("gold")
        gold = ("--set", "object.1.color=[255,255,255]", "--set", "object.1.material.ka=[0.24725,0.1995,0.0745]",
                "--set", "object.1.material.kd=[0.75164,0.60648,0.22648]",
                "--set", "object.1.material.ks=[0.628281,0.555802,0.366065]", "--set", "object.1.material.shininess=51.2")
        self.assert_alike(self.picture(generated), generated.render(*gold), "gold", before=own)
        self.assertEqual(self.value_shown("object.1.material.blinn-phong.shininess"), 51.2)
        self.assertEqual(chosen(), "gold")
        # One value differs: it is no longer gold.
        self.browser.enter('[data-path="object.1.material.blinn-phong.shininess"] input', "3")
        self.assertEqual(chosen(), "custom")
        # A metal's reflectance (Real-Time Rendering, table 9.2), under GGX.
        self.browser.click("reset-all")
        self.browser.enter("[data-path=reflection] select", "ggx")
        self.browser.unfold_all()
        ggx = self.picture(generated)
        choose("copper")
        copper = ("--reflection", "ggx", "--set", "object.1.color=[250,209,194]", "--set", "object.1.material.kd=0",
                  "--set", "object.1.material.ks=[0.955,0.638,0.538]", "--set", "object.1.material.ior=100")
        self.assert_alike(self.picture(generated), generated.render(*copper), "copper", before=ggx)

    def test_values_of_every_material_and_of_normal_maps(self):
        folder = SCRATCH / "textured"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "waves.ppm").write_bytes(scenes.WAVES)
        (folder / "tilts.ppm").write_bytes(scenes.TILTS)
        generated = Generated("textured", scenes.TEXTURED)
        self.browser.open(generated.address)
        self.browser.unfold_all()
        own = self.picture(generated)
        self.assert_alike(own, generated.render(), "as it is")
        expected = {"object.0.bump_map.height", "object.1.common.opacity", "object.2.common.emission_strength", "object.2.normal_map.scale",
                    "object.3.common.emission_strength"}
        # Those that pictures give have none: --set would put a number in the place of the picture.
        given = {"object.0.color", "object.2.material.phong.kd"}
        paths = set(self.settings())
        self.assertEqual({path for path in paths if path.split(".")[2:3] and path.split(".")[2] in ("common", "normal_map", "bump_map")}, expected)
        self.assertEqual(paths & given, set())
        self.assertIn("object.2.material.phong.ks", paths)
        self.own_model = {}
        for path in sorted(expected):
            with self.subTest(path):
                self.try_setting(generated, own, path, self.reset)
            self.reset()
            self.assertEqual(self.picture(generated).pixels, own.pixels, f"{path}: reset")
        # A normal map shows where light is evaluated at pixels; another model has all of its own numbers.
        self.browser.enter("[data-path=shading] select", "gouraud")
        self.browser.unfold_all()
        self.assertNotIn("object.2.normal_map.scale", self.settings())
        self.reset()
        self.browser.enter("[data-path=reflection] select", "blinn-phong")
        self.browser.unfold_all()
        self.assertIn("object.2.material.blinn-phong.kd", self.settings())
        self.assertEqual(self.browser.errors(), [])

    def test_wrong_input(self):
        generated = Generated("wrong", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        self.browser.unfold_all()
        own = self.picture(generated)
        wrong = {
            "object.0.material.lambert.kd": ["", "-0.1", "1.1", "1e99"],
            "light.0.value.intensity": ["-1", ""],
            "light.1.value.inner_angle": ["90", "-5"],
            "observer.fov": ["0", "180", "-20"],
        }
        for path, values in wrong.items():
            for value in values:
                selector = [s for s, kind, *_ in self.inputs(path) if kind == "number"][0]
                self.browser.enter(selector, value)
                self.assertEqual(self.picture(generated).pixels, own.pixels, f"{path} = {value}")
                self.assertNotEqual(self.browser.text(f'[data-path="{path}"] .wrong'), "", f"{path} = {value}")
                self.assertEqual(self.browser.one(selector).get_attribute("aria-invalid"), "true")
            self.reset()
        self.assertEqual(self.browser.errors(), [])
