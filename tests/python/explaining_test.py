"""Pixels explained, and terms."""
import unittest

import numpy as np

import candela

FACE = {
    "observer": {"position": [0, 0, 4], "look_at": [0, 0, 0], "projection": "orthographic", "height": 0.5},
    "image": {"width": 6, "height": 4},
    "shading": {"model": "flat"},
    "reflection": {"model": "phong"},
    "light": [
        {"name": "sun", "type": "directional", "direction": [0, -1, -1], "intensity": 0.8},
        {"name": "sky", "type": "ambient", "intensity": 0.25},
    ],
    "object": [{"name": "box", "type": "cube", "color": [255, 255, 255],
                "material": {"ka": 0.4, "kd": 0.5, "ks": 0.2, "shininess": 2}}],
}
AMBIENT, DIFFUSE = 0.4 * 0.25, 0.5 * 0.8 * np.sqrt(0.5)
SPECULAR = 0.2 * 0.8 * 0.5  # R.V is cos 45 degrees, squared


class Terms(unittest.TestCase):
    def setUp(self):
        self.scene = candela.Scene.from_dict(FACE)

    def test_terms_are_those_of_the_closed_form(self):
        terms = self.scene.terms("ambient", "diffuse", "specular", "depth", "normal", "uv", "light.sun", "n_dot_l.sun")
        self.assertEqual(list(terms), ["ambient", "diffuse", "specular", "depth", "normal", "uv", "light.sun", "n_dot_l.sun"])
        expected = {"ambient": AMBIENT, "diffuse": DIFFUSE, "specular": SPECULAR, "light.sun": DIFFUSE + SPECULAR,
                    "n_dot_l.sun": np.sqrt(0.5), "depth": 3.5}
        for name, value in expected.items():
            np.testing.assert_allclose(terms[name], np.full(terms[name].shape, value), rtol=1e-5, err_msg=name)
        np.testing.assert_allclose(terms["normal"], np.broadcast_to([0, 0, 1], (4, 6, 3)), atol=1e-6)
        self.assertEqual([terms[name].shape for name in ("depth", "uv", "normal")], [(4, 6), (4, 6, 2), (4, 6, 3)])

    def test_all_terms_add_up_to_the_picture(self):
        terms = self.scene.terms()
        whole = terms["ambient"] + terms["diffuse"] + terms["specular"] + terms["background"]
        np.testing.assert_allclose(whole, self.scene.render(floats=True), rtol=1e-5)

    def test_an_unknown_term_has_a_suggestion(self):
        with self.assertRaisesRegex(candela.RequestError, "unknown term 'difuse'; did you mean 'diffuse'"):
            self.scene.terms("difuse")


class Shadows(unittest.TestCase):
    def setUp(self):
        lid = {"name": "lid", "type": "cube", "position": [0, 1, 1.5], "scale": [1, 0.6, 0.6]}  # on the way from the sun
        self.scene = candela.Scene.from_dict({**FACE, "object": [*FACE["object"], lid], "shadows": {"enabled": True}})

    def test_a_blocked_light_leaves_the_ambient_one(self):
        np.testing.assert_allclose(self.scene.render(floats=True), np.full((4, 6, 3), AMBIENT), rtol=1e-5)
        np.testing.assert_array_equal(self.scene.terms("visibility.sun")["visibility.sun"], np.zeros((4, 6, 3)))

    def test_a_pixel_names_the_blocker(self):
        point, = self.scene.explain(3, 2)["fragments"][0]["points"]
        sun = next(light for light in point["lights"] if light["type"] == "directional")
        self.assertEqual((sun["blocked_by"]["object"], sun["visibility"]), ("'lid'", [0, 0, 0]))

    def test_without_shadows_the_same_scene_is_lit(self):
        lit = self.scene.changed({"shadows.enabled": False}).render(floats=True)
        np.testing.assert_allclose(lit, np.full((4, 6, 3), AMBIENT + DIFFUSE + SPECULAR), rtol=1e-5)


class Explanations(unittest.TestCase):
    def setUp(self):
        self.scene = candela.Scene.from_dict(FACE)

    def test_a_pixel_is_explained_by_the_closed_form_and_is_the_picture_s(self):
        explained = self.scene.explain(3, 2)
        self.assertEqual(explained["pixel"], [3, 2])
        self.assertEqual(explained["bytes"], self.scene.render()[2, 3].tolist())
        fragment, = explained["fragments"]
        self.assertEqual((fragment["object"], fragment["shading"]), ("'box'", "flat"))
        point, = fragment["points"]
        np.testing.assert_allclose(point["N"], [0, 0, 1], atol=1e-6)
        sun = next(light for light in point["lights"] if light["type"] == "directional")
        np.testing.assert_allclose(sun["L"], np.array([0, 1, 1]) / np.sqrt(2), atol=1e-6)
        np.testing.assert_allclose(sun["I_d"], [DIFFUSE] * 3, rtol=1e-5)
        np.testing.assert_allclose(sun["I_s"], [SPECULAR] * 3, rtol=1e-5)
        np.testing.assert_allclose(explained["I"], [AMBIENT + DIFFUSE + SPECULAR] * 3, rtol=1e-5)
        self.assertIn("phong", str(explained))

    def test_kernels_are_compiled_once_and_compute_the_same(self):
        first, second = self.scene.explain(3, 2), self.scene.explain(1, 1)
        for explained in (first, second):
            self.assertNotIn("note", explained)
            self.assertLess(explained["kernel_difference"], 1e-5)
        steps = first["fragments"][0]["points"][0]["lights"][0]["reflection_steps"]
        self.assertIn("n_dot_l", [step["name"] for step in steps])

    def test_a_pixel_that_the_picture_does_not_have_is_an_index_error(self):
        for x, y in ((6, 0), (0, 4), (-1, 0)):
            with self.assertRaisesRegex(IndexError, "0, 0 to 5, 3"):
                self.scene.explain(x, y)


if __name__ == "__main__":
    unittest.main()
