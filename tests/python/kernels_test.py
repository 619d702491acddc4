"""Models from a kernel's text."""
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
