"""Models from a kernel's text."""
import contextlib
import os
import pathlib
import tempfile
import unittest

import numpy as np

import candela

MINNAERT = """
// Minnaert (1941): the diffuse part, with an exponent k.
struct MyMoonMaterial {
    vec3 kd;
    float k;  // 1: Lambert
};

KERNEL Reflected my_moon_reflect(MyMoonMaterial m, Surface s, vec3 to_light) {
    float n_dot_l = max(dot(s.normal, to_light), 0.0f);
    float n_dot_v = max(dot(s.normal, s.to_observer), 1.0e-4f);
    return Reflected(m.kd * s.color * n_dot_l * pow(max(n_dot_l * n_dot_v, 1.0e-6f), m.k - 1.0f), vec3(0.0f));
}
"""


SCENE = """
version = 1
observer = {position = [0, 0, 4], look_at = [0, 0, 0], projection = "orthographic", height = 0.5}
image = {width = 2, height = 2}
shading.model = "flat"
light = [{type = "directional", direction = [0, 0, -1]}]
object = [{type = "cube", color = [255, 255, 255], reflection = "my-moon.kernel", material = {kd = 0.5, k = 1}}]
"""


@contextlib.contextmanager
def folder_with(**files):
    """A new working folder with these files: my_moon for my-moon.kernel."""
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            for name, text in files.items():
                pathlib.Path(name.replace("_", "-") + ".kernel").write_text(text, encoding="utf-8")
            yield pathlib.Path(folder)
        finally:
            os.chdir(before)


class KernelFiles(unittest.TestCase):
    def test_a_file_serves_wherever_a_model_is_named(self):
        with folder_with(my_moon=MINNAERT):
            expected = candela.kernel_reflection(MINNAERT, kd=0.5, k=1.5).evaluate([0, 1, 0], [0.6, 0.8, 0], [0, 1, 0])
            for path in ("my-moon.kernel", "./my-moon.kernel", os.path.abspath("my-moon.kernel"), pathlib.Path("my-moon.kernel")):
                model = candela.reflection(path, kd=0.5, k=1.5)
                np.testing.assert_array_equal(model.evaluate([0, 1, 0], [0.6, 0.8, 0], [0, 1, 0]), expected)
                for described in (model.model, candela.model(path)):
                    self.assertEqual(described.id, "reflection/my-moon")
                    self.assertEqual([parameter.name for parameter in described.parameters], ["kd", "k"])
            outcomes = {check.outcome for check in candela.conformance("my-moon.kernel", kd=0.5, k=1)}
            self.assertLessEqual(outcomes, {"passed", "warning", "skipped"})

    def test_lights_and_shading_models_are_files_too(self):
        with folder_with(dim="KERNEL Incident dim_illuminate(Receiver p) { return Incident(vec3(0.0f, 1.0f, 0.0f), vec3(0.5f), vec3(0.5f)); }",
                         upward="KERNEL vec3 upward_normal(ShadingPoint p) { return vec3(0.0f, 1.0f, 0.0f); }"):
            np.testing.assert_array_equal(candela.light("dim.kernel").illuminate([1, 2, 3]).diffuse, [0.5] * 3)
            normals = candela.shading("upward.kernel").normals([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [1, 0, 0])
            np.testing.assert_array_equal(normals, [0, 1, 0])
            with self.assertRaisesRegex(candela.RequestError, "'dim.kernel' is a light model; expected a reflection model"):
                candela.reflection("dim.kernel")

    def test_scenes_name_a_file_next_to_them(self):
        with folder_with(my_moon=MINNAERT) as folder:
            (folder / "scene.toml").write_text(SCENE, encoding="utf-8")
            os.chdir("/")
            scene = candela.Scene.load(folder / "scene.toml")
            np.testing.assert_allclose(scene.render(floats=True), np.full((2, 2, 3), 0.5), rtol=1e-4)
            self.assertEqual(candela.Scene.parse(scene.text()).render().tobytes(), scene.render().tobytes())

    def test_a_mistake_in_a_file_has_its_place(self):
        with folder_with(my_moon=MINNAERT.replace("float k;", "double k;")) as folder:
            (folder / "scene.toml").write_text(SCENE, encoding="utf-8")
            for error, attempt in ((candela.RequestError, lambda: candela.reflection("my-moon.kernel", registry=candela.Registry())),
                                   (candela.RequestError, lambda: candela.model("my-moon.kernel", registry=candela.Registry())),
                                   (candela.SceneError, lambda: candela.Scene.load("scene.toml", registry=candela.Registry()))):
                with self.assertRaisesRegex(error, "my-moon.kernel:5:5: .*the kernel language has no 'double'") as raised:
                    attempt()
                found, = raised.exception.diagnostics
                self.assertEqual((found.line, found.column, found.text), (5, 5, "    double k;  // 1: Lambert"))


class Kernels(unittest.TestCase):
    def test_a_kernel_is_its_formula(self):
        model = candela.kernel_reflection(MINNAERT, kd=(0.2, 0.4, 0.8), k=1.5)
        cosines = np.array([[1.0, 0.9], [0.5, 0.7], [0.3, 0.2], [-0.5, 0.5]])
        to_light, to_observer = (np.stack([np.sqrt(1 - c**2), c, 0 * c], axis=-1) for c in cosines.T)
        n_dot_l = np.maximum(cosines[:, 0], 0)
        expected = np.array([0.2, 0.4, 0.8]) * (n_dot_l * np.maximum(n_dot_l * cosines[:, 1], 1e-6) ** 0.5)[:, np.newaxis]
        np.testing.assert_allclose(model.evaluate([0, 1, 0], to_observer, to_light), expected, rtol=1e-4, atol=1e-8)
        np.testing.assert_array_equal(model.ambient([0, 1, 0], [0, 1, 0]), [0, 0, 0])
        self.assertEqual(model.name, "my-moon")

    def test_a_kernel_without_parameters_that_reads_tangents_and_reflects_ambient_light(self):
        model = candela.kernel_reflection("""
            KERNEL Reflected grain_reflect(Surface s, vec3 to_light) {
                float t = dot(s.tangent, to_light);
                return Reflected(vec3(0.0f), vec3(t * t));
            }
            KERNEL vec3 grain_reflect_ambient(Surface s) { return 0.5f * s.color; }
        """)
        self.assertTrue(model.reads_tangents)
        np.testing.assert_allclose(model.evaluate([0, 1, 0], [0, 1, 0], [0.6, 0.8, 0], tangents=[1, 0, 0]), [0.36] * 3, rtol=1e-6)
        np.testing.assert_allclose(model.ambient([0, 1, 0], [0, 1, 0], color=0.5, tangents=[1, 0, 0]), [0.25] * 3, rtol=1e-6)

    def test_a_quotient_by_zero_ends_no_process(self):
        model = candela.kernel_reflection("""
            struct QuotientMaterial {
                int zero;
            };
            KERNEL Reflected quotient_reflect(QuotientMaterial m, Surface s, vec3 to_light) {
                int a = 7 / m.zero + 7 % m.zero + int(1.0e30f * to_light.y) + (-2147483647 - 1) / (m.zero - 1);
                return Reflected(vec3(float(a)), vec3(0.0f));
            }
        """, zero=0)
        np.testing.assert_array_equal(model.evaluate([0, 1, 0], [0, 1, 0], [0, 1, 0]), [-2147483648.0] * 3)

    def test_scenes_can_name_it(self):
        model = candela.kernel_reflection(MINNAERT, kd=0.5, k=1)
        scene = candela.Scene.from_dict({
            "observer": {"position": [0, 0, 4], "look_at": [0, 0, 0], "projection": "orthographic", "height": 0.5},
            "image": {"width": 2, "height": 2},
            "shading": {"model": "flat"},
            "light": [{"type": "directional", "direction": [0, 0, -1]}],
            "object": [{"type": "cube", "color": [255, 255, 255], "material": {"kd": 0.5, "k": 1}}],
        }, reflection=model.name, registry=model.registry)
        np.testing.assert_allclose(scene.render(floats=True), np.full((2, 2, 3), 0.5), rtol=1e-4)

    def test_it_conforms_as_installed_models_do(self):
        model = candela.kernel_reflection(MINNAERT, kd=0.5, k=1)
        for checks in (candela.conformance("reflection/my-moon", registry=model.registry, kd=0.5, k=1),
                       candela.conformance("reflection/lambert")):
            self.assertGreater(len(checks), 10)
            failed = [check for check in checks if check.outcome not in ("passed", "warning", "skipped")]
            self.assertEqual(failed, [])
        with self.assertRaisesRegex(candela.Error, "did you mean"):
            candela.conformance("reflection/lambrt")

    def test_what_is_wrong_with_a_kernel_is_said(self):
        for source, said in (
                ("KERNEL vec3 x_reflekt(Surface s) { return s.color; }", "a function 'KERNEL Reflected NAME_reflect"),
                (MINNAERT.replace("struct MyMoonMaterial", "struct Moon"), "my-moon.kernel:8:34: unknown type 'MyMoonMaterial'"),
                (MINNAERT.replace("float k;", "double k;"), "my-moon.kernel:5:5: the kernel language has no 'double'; numbers with a fraction are float"),
                (MINNAERT.replace("n_dot_v;", "n_dot_w;").replace("* n_dot_v,", "* n_dot_w,"), r"my-moon.kernel:11:67: unknown variable 'n_dot_w'; did you mean 'n_dot_"),
                (MINNAERT.replace("float n_dot_v", "vec3 *p = (vec3 * const) 16; float n_dot_v"),
                 r"my-moon.kernel:10:10: the kernel language has neither pointers nor references"),
                (MINNAERT.replace("    float n_dot_v", "#include </etc/passwd>\n    float n_dot_v"), "has no preprocessor"),
                (MINNAERT.replace("float n_dot_v", "while (true) { } float n_dot_v"), "a loop needs a constant bound"),
                (MINNAERT.replace("    return", "    float system = system(1.0f);\n    return"), "'system' is a variable here")):
            with self.assertRaisesRegex(candela.RequestError, said):
                candela.kernel_reflection(source, kd=0.5, k=1)
        with self.assertRaisesRegex(candela.RequestError, "'k'"):
            candela.kernel_reflection(MINNAERT, kd=0.5)


if __name__ == "__main__":
    unittest.main()
