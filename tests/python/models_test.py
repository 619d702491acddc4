"""Models on arrays, against closed forms and the worked examples of the rendering-equation notes (RE)."""
import unittest

import numpy as np

import candela

RANDOM = np.random.default_rng(20)


def directions(*shape, about=None):
    """Unit vectors; within 80 degrees of `about` if that is given."""
    v = RANDOM.normal(size=(*shape, 3))
    v /= np.linalg.norm(v, axis=-1, keepdims=True)
    if about is None:
        return v
    cosine = np.sum(v * about, axis=-1, keepdims=True)
    v = np.where(cosine < 0, v - 2 * cosine * about, v) + 0.2 * about
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def unit(*vector):
    return np.array(vector, float) / np.linalg.norm(vector)


def dot(a, b):
    return np.sum(a * b, axis=-1, keepdims=True)


def ggx(n, v, l, ior, alpha):
    """Walter et al. (2007), eqs. 22 and 33, with Heitz's (2014) height-correlated G2, eq. 99: the specular part, times N.L."""
    h = l + v
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    nl, nv, nh, vh = dot(n, l), dot(n, v), dot(n, h), dot(v, h)
    d = alpha**2 / (nh**2 * (alpha**2 - 1) + 1) ** 2
    smith = [(-1 + np.sqrt(1 + alpha**2 * (1 - c**2) / c**2)) / 2 for c in (nl, nv)]
    g = np.sqrt(ior**2 - 1 + vh**2)
    f = 0.5 * ((g - vh) / (g + vh)) ** 2 * (1 + ((vh * (g + vh) - 1) / (vh * (g - vh) + 1)) ** 2)
    return f * d / (1 + smith[0] + smith[1]) / (4 * nv * nl) * nl


class ReflectionModels(unittest.TestCase):
    def test_lambert_is_im1(self):
        n, l = directions(1000), directions(1000)
        color, light = RANDOM.uniform(size=(1000, 3)), RANDOM.uniform(size=(1000, 3))
        model = candela.reflection("lambert", kd=0.6)
        expected = 0.6 * color * light * np.maximum(dot(n, l), 0)
        np.testing.assert_allclose(model.evaluate(n, n, l, color=color, light=light), expected, rtol=1e-5, atol=1e-6)

    def test_ggx_is_walters_with_heitzs_masking(self):
        n = directions(2000)
        v, l = directions(2000, about=n), directions(2000, about=n)
        for alpha in (0.05, 0.3, 1.0):
            model = candela.reflection("ggx", kd=0, ks=1, roughness=alpha, ior=1.5)
            expected = np.broadcast_to(ggx(n, v, l, 1.5, alpha), (2000, 3))
            np.testing.assert_allclose(model.evaluate(n, v, l), expected, rtol=3e-3, atol=1e-5)

    def test_parts_add_up_and_light_only_scales(self):
        n = directions(300)
        v, l = directions(300, about=n), directions(300, about=n)
        model = candela.reflection("phong", kd=[0.1, 0.5, 0.9], ks=0.1)
        parts = model.evaluate_parts(n, v, l, color=[0.2, 0.4, 0.8])
        whole = model(n, v, l, color=[0.2, 0.4, 0.8])
        np.testing.assert_allclose(parts.diffuse + parts.specular, whole, rtol=1e-6)
        np.testing.assert_allclose(model.evaluate(n, v, l, color=[0.2, 0.4, 0.8], light=3), 3 * whole, rtol=1e-5)
        np.testing.assert_allclose(model.ambient(n, v, color=[0.2, 0.4, 0.8], ambient=2),
                                   np.broadcast_to(2 * 0.1 * np.array([0.2, 0.4, 0.8]), (300, 3)), rtol=1e-6)

    def test_axes_are_broadcast_and_strides_do_not_matter(self):
        model = candela.reflection("blinn-phong", ks=0.3)
        n = directions(7, 11).astype(np.float32)
        expected = model.evaluate(n.reshape(-1, 3), [0, 0, 1], unit(1, 2, 2)).reshape(7, 11, 3)
        observer, to_light = np.array([[0, 0, 1]]), unit(1, 2, 2)
        np.testing.assert_array_equal(model.evaluate(n, observer, to_light), expected)
        apart = np.ascontiguousarray(np.moveaxis(n, -1, 0))
        np.testing.assert_array_equal(model.evaluate(np.moveaxis(apart, 0, -1), observer, to_light), expected)
        np.testing.assert_array_equal(model.evaluate(apart.reshape(3, -1).T, observer, to_light), expected.reshape(-1, 3))
        np.testing.assert_array_equal(model.evaluate(n[::-2, ::3], observer, to_light), expected[::-2, ::3])
        self.assertEqual(model.evaluate([0, 0, 1], [0, 0, 1], [0, 0, 1]).shape, (3,))
        self.assertEqual(model.evaluate(np.empty((0, 3)), [0, 0, 1], [0, 0, 1]).shape, (0, 3))

    def test_any_number_of_points_of_any_layout_is_the_same_to_the_byte(self):
        model = candela.reflection("lambert", kd=0.6)
        for count in (1, 15, 16, 17, 63, 64, 65, 200, 1031):
            n, l = (directions(count).astype(np.float32) for _ in range(2))
            color = RANDOM.uniform(size=(count, 3)).astype(np.float32)
            expected = model.evaluate(n, n, l, color=color)
            np.testing.assert_allclose(expected, 0.6 * color * np.maximum(dot(n, l), 0), rtol=1e-5, atol=1e-6)
            layouts = (np.asfortranarray, lambda array: np.repeat(array, 2, axis=0)[::2], lambda array: array.astype(float))
            for layout in layouts:
                np.testing.assert_array_equal(model.evaluate(*map(layout, (n, n, l)), color=layout(color)), expected)
            parts = model.evaluate_parts(n, n, l, color=color)
            np.testing.assert_array_equal(parts.diffuse + parts.specular, expected)

    def test_the_number_of_threads_does_not_matter(self):
        n = directions(100_003)
        model = candela.reflection("cook-torrance")
        results = [model.evaluate(n, unit(1, 1, 3), unit(0, 2, 1), threads=threads) for threads in (0, 1, 2, 5)]
        for result in results[1:]:
            np.testing.assert_array_equal(result, results[0])

    def test_every_installed_model_is_finite_and_not_negative(self):
        n = directions(500)
        v, l = directions(500, about=n), directions(500)
        tangents = np.cross(n, directions(500))
        tangents /= np.linalg.norm(tangents, axis=-1, keepdims=True)
        for model in candela.models("reflection"):
            result = candela.reflection(model.name).evaluate(n, v, l, tangents=tangents, uv=np.zeros(2))
            self.assertTrue(np.isfinite(result).all() and (result >= 0).all(), model.name)

    def test_an_anisotropic_model_asks_for_tangents(self):
        model = candela.reflection("ward")
        self.assertTrue(model.reads_tangents)
        with self.assertRaisesRegex(candela.RequestError, "reflection/ward reads tangents"):
            model.evaluate([0, 0, 1], [0, 0, 1], [0, 0, 1])

    def test_values_are_checked_as_in_a_scene(self):
        with self.assertRaises(candela.RequestError) as raised:
            candela.reflection("ggx", roughnes=0.2, ior=0.1, kd="red")
        text = str(raised.exception)
        self.assertEqual(len(raised.exception.diagnostics), 3)
        for expected in ("unknown key 'roughnes'", "did you mean 'roughness'?", "'ior'", "1 to 100", "'kd'"):
            self.assertIn(expected, text)
        with self.assertRaisesRegex(candela.Error, "did you mean 'ggx'"):
            candela.reflection("gxg")
        self.assertEqual(candela.reflection("ggx", ior=2).values["ior"], 2)
        self.assertEqual(candela.reflection("ggx").model.title, "GGX")

    def test_shapes_that_do_not_fit_are_explained(self):
        model = candela.reflection("lambert")
        with self.assertRaisesRegex(ValueError, "normals has the shape .*length 3"):
            model.evaluate(np.zeros((5, 4)), [0, 0, 1], [0, 0, 1])
        with self.assertRaisesRegex(ValueError, r"normals \(5, 3\), to_observer \(4, 3\)"):
            model.evaluate(np.zeros((5, 3)), np.zeros((4, 3)), [0, 0, 1])


class Lights(unittest.TestCase):
    def test_a_point_light_obeys_the_inverse_square_law(self):
        lamp = candela.light("point", position=(1, 2, 3), intensity=20)
        points = RANDOM.uniform(-2, 2, size=(4, 50, 3))
        incident = lamp.illuminate(points)
        offset = np.array([1, 2, 3]) - points
        distance = np.linalg.norm(offset, axis=-1, keepdims=True)
        np.testing.assert_allclose(incident.to_light, offset / distance, rtol=1e-4, atol=1e-6)
        np.testing.assert_allclose(incident.diffuse, np.broadcast_to(20 / distance**2, points.shape), rtol=1e-4)
        np.testing.assert_array_equal(incident.specular, incident.diffuse)

    def test_colours_are_decoded_unless_said_otherwise(self):
        red = {"direction": (0, -1, 0), "color": (188, 0, 0)}
        decoded = ((188 / 255 + 0.055) / 1.055) ** 2.4
        np.testing.assert_allclose(candela.light("directional", **red)([0, 0, 0]).diffuse, [decoded, 0, 0], rtol=1e-4)
        plain = candela.light("directional", color_management="none", **red)
        np.testing.assert_allclose(plain([0, 0, 0]).diffuse, [188 / 255, 0, 0], rtol=1e-5)

    def test_ambient_light_has_no_direction(self):
        sky = candela.light("ambient", intensity=0.5)
        self.assertEqual((sky.sample_count, sky.has_ambient), (0, True))
        np.testing.assert_allclose(sky.ambient(np.zeros((2, 3))), np.full((2, 3), 0.5), rtol=1e-6)
        with self.assertRaisesRegex(IndexError, "no sample 0; its sample count is 0"):
            sky.illuminate([0, 0, 0])
        lamp = candela.light("point", position=(0, 0, 0))
        np.testing.assert_array_equal(lamp.ambient([1, 1, 1]), [0, 0, 0])

    def test_a_light_without_its_position_says_so(self):
        with self.assertRaisesRegex(candela.RequestError, "position"):
            candela.light("point")


class ShadingModels(unittest.TestCase):
    TRIANGLE = np.array([[0, 0, 0], [2, 0, 0], [0, 3, 0]], float)
    CORNERS = np.array([unit(-1, 0, 1), unit(1, 0, 1), unit(0, 1, 1)])

    def test_flat_is_dd8_and_phong_is_dd10(self):
        weights = RANDOM.dirichlet([1, 1, 1], size=64)
        flat = candela.shading("flat").normals(self.TRIANGLE, weights, vertex_normals=self.CORNERS)
        np.testing.assert_allclose(flat, np.broadcast_to([0, 0, 1], (64, 3)), atol=1e-6)
        phong = candela.shading("phong")
        expected = weights @ self.CORNERS
        expected /= np.linalg.norm(expected, axis=-1, keepdims=True)
        np.testing.assert_allclose(phong.normals(self.TRIANGLE, weights, vertex_normals=self.CORNERS), expected, atol=1e-5)
        np.testing.assert_allclose(phong.normals(self.TRIANGLE, weights), flat, atol=1e-6)
        self.assertEqual([candela.shading(name).rate for name in ("flat", "gouraud", "phong")], ["face", "vertex", "fragment"])

    def test_derivatives_are_asked_for_and_used(self):
        model = candela.shading("derivative")
        with self.assertRaisesRegex(candela.RequestError, "dpdu and dpdv"):
            model.normals(self.TRIANGLE, [1, 0, 0])
        normal = model.normals(self.TRIANGLE, [1, 0, 0], dpdu=[0, 0, 2], dpdv=[3, 0, 0])
        np.testing.assert_allclose(normal, [0, 1, 0], atol=1e-6)

    def test_vertex_normals_are_dd9(self):
        # Two faces of a box, one of them twice as large in triangles: x = 1 and y = 1 share an edge.
        positions = [[1, 1, 0], [1, 1, 1], [1, 0, 0], [0, 1, 0]]
        triangles = [[0, 1, 2], [0, 3, 1]]
        normals = candela.shading("phong").vertex_normals(positions, triangles)
        np.testing.assert_allclose(normals, [unit(1, 1, 0), unit(1, 1, 0), [1, 0, 0], [0, 1, 0]], atol=1e-6)
        with self.assertRaises(IndexError):
            candela.shading("phong").vertex_normals(positions, [[0, 1, 4]])


class WorkedExamples(unittest.TestCase):
    def test_re_1_a_mirror_direction(self):
        # With shininess 1 and k_s 1, the highlight is R.V: three observers along the axes measure R = (0.8944, 0.4472, 0).
        mirror = candela.reflection("phong", kd=0, ks=1, shininess=1)
        measured = mirror.evaluate([0, 1, 0], np.eye(3), unit(-4, 2, 0))[:, 0]
        np.testing.assert_allclose(measured, [0.8944, 0.4472, 0], atol=5e-5)

    def test_re_2_the_corner_of_a_face(self):
        face = np.array([[5, 0, 0], [0, 0, 0], [5, 0, 5]], float)
        normal = candela.shading("flat").normals(face, [0, 1, 0])
        np.testing.assert_allclose(normal, [0, 1, 0], atol=1e-6)
        to_light, to_observer = unit(-10, 10, 0), unit(20, 5, 0)
        cosines = candela.reflection("phong", kd=1, ks=0), candela.reflection("phong", kd=0, ks=1, shininess=1)
        measured = [model.evaluate(normal, to_observer, to_light)[0] for model in cosines]
        np.testing.assert_allclose(measured, [0.7071, 0.8575], atol=5e-5)

    def test_re_3_the_red_intensity_at_a_vertex(self):
        face = np.array([[0.7, 0.1, 0.4], [0.1, 0.2, 0.2], [0.5, 0.3, 0.5]])
        normal = candela.shading("flat").normals(face, [1, 0, 0])
        np.testing.assert_allclose(np.abs(normal), [1 / 3, 2 / 3, 2 / 3], atol=1e-5)
        normal = np.array([1 / 3, 2 / 3, -2 / 3])
        lamp = candela.light("point", position=(0.3, 0.8, 0.4), attenuation="offset-linear", attenuation_offset=0.01)
        incident = lamp.illuminate(face[0])
        np.testing.assert_allclose(incident.to_light, [-0.4962, 0.8683, 0], atol=2e-4)
        self.assertAlmostEqual(float(normal @ incident.to_light), 0.4135, delta=2e-4)
        model = candela.reflection("phong", ka=0.1, kd=0.8, ks=0.2, shininess=10)
        # R.V is -0.5514 there: no highlight, although its tenth power is positive.
        parts = model.evaluate_parts(normal, [0, 0, 1], incident.to_light, light=incident.diffuse)
        self.assertLess(parts.specular[0], 1e-6)
        ambient = model.ambient(normal, [0, 0, 1], ambient=0.3)
        self.assertAlmostEqual(float(ambient[0] + parts.diffuse[0]), 0.4353, delta=2e-4)


if __name__ == "__main__":
    unittest.main()
