"""Scenes from files, texts and dictionaries; pictures; errors."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import candela

BUILD = pathlib.Path(os.environ["CANDELA_TEST_BUILD"])

# The face of a cube that fills the picture, lit from the observer's side: I = k_d C_o I_L N.L.
FACE = {
    "observer": {"position": [0, 0, 4], "look_at": [0, 0, 0], "projection": "orthographic", "height": 0.5},
    "image": {"width": 6, "height": 4},
    "shading": {"model": "flat"},
    "reflection": {"model": "lambert"},
    "light": [{"name": "sun", "type": "directional", "direction": [0, -1, -1], "intensity": 0.8}],
    "object": [{"name": "box", "type": "cube", "color": [255, 0, 255], "material": {"kd": 0.5}}],
}
EXPECTED = 0.5 * 0.8 * np.sqrt(0.5)


def srgb(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


class Pictures(unittest.TestCase):
    def test_floats_are_the_intensities_of_the_closed_form(self):
        picture = candela.Scene.from_dict(FACE).render(floats=True)
        self.assertEqual((picture.shape, picture.dtype), ((4, 6, 3), np.float32))
        np.testing.assert_allclose(picture, np.broadcast_to([EXPECTED, 0, EXPECTED], (4, 6, 3)), rtol=1e-6, atol=1e-9)

    def test_bytes_are_encoded_as_srgb(self):
        picture = candela.Scene.from_dict(FACE).render()
        self.assertEqual(picture.dtype, np.uint8)
        np.testing.assert_array_equal(picture[2, 3], [round(255 * srgb(EXPECTED)), 0, round(255 * srgb(EXPECTED))])

    def test_floats_become_the_bytes_that_are_rendered(self):
        scene = candela.Scene.load()
        np.testing.assert_array_equal(scene.render(floats=True).to_bytes(), scene.render())
        plain = scene.changed({"image.color_management": "none"})
        np.testing.assert_array_equal(plain.render(floats=True).to_bytes(), plain.render())

    def test_bytes_are_those_of_the_file_that_the_command_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.toml")
            path.write_text(candela.document(FACE), encoding="utf-8")
            subprocess.run([BUILD / "bin/candela", "render", "--quiet", path, "-o", path.with_suffix(".ppm")], check=True)
            written = path.with_suffix(".ppm").read_bytes()
            picture = candela.Scene.load(path).render()
        self.assertEqual(written, b"P6\n6 4\n255\n" + picture.tobytes())

    def test_the_array_is_the_memory_that_was_rendered_into(self):
        picture = candela.Scene.from_dict(FACE).render()
        owner = picture
        while isinstance(owner, np.ndarray):
            self.assertFalse(owner.flags.owndata)
            owner = owner.base
        self.assertEqual(type(owner).__name__, "PyCapsule")
        picture[:] = 7  # and it names its owner
        self.assertEqual(int(picture.sum()), 7 * picture.size)

    def test_a_picture_shows_itself_in_a_notebook(self):
        picture = candela.Scene.from_dict(FACE).render()
        png = picture._repr_png_()
        self.assertTrue(png.startswith(b"\x89PNG\r\n\x1a\n"))
        self.assertEqual(png[16:24], (6).to_bytes(4, "big") + (4).to_bytes(4, "big"))
        self.assertIsNone(picture[0, 0]._repr_png_())
        self.assertTrue(candela.Scene.from_dict(FACE)._repr_png_().startswith(b"\x89PNG"))

    def test_a_picture_is_saved_whole_or_not_at_all(self):
        picture = candela.Scene.from_dict(FACE).render()
        with tempfile.TemporaryDirectory() as folder:
            picture.save(pathlib.Path(folder, "a.png"))
            self.assertEqual(pathlib.Path(folder, "a.png").read_bytes(), picture.png())
            with self.assertRaises(OSError):
                picture.save(pathlib.Path(folder, "none", "a.png"))
            self.assertEqual(os.listdir(folder), ["a.png"])


class Scenes(unittest.TestCase):
    def test_numbers_and_arrays_of_numpy_are_values(self):
        changed = {**FACE, "observer": {**FACE["observer"], "position": np.array([0.0, 0.0, 4.0])},
                   "image": {"width": np.int64(6), "height": np.uint8(4)}}
        np.testing.assert_array_equal(candela.Scene.from_dict(changed).render(), candela.Scene.from_dict(FACE).render())

    def test_settings_override_and_a_scene_stays_what_it_was(self):
        scene = candela.Scene.from_dict(FACE)
        twice = scene.changed({"light.sun.intensity": 1.6})
        np.testing.assert_allclose(twice.render(floats=True)[..., 0], 2 * EXPECTED, rtol=1e-6)
        np.testing.assert_allclose(scene.render(floats=True)[..., 0], EXPECTED, rtol=1e-6)
        other = candela.Scene.from_dict(FACE, settings={"image.width": 9}, reflection="phong")
        self.assertEqual((other.width, other.height), (9, 4))

    def test_a_scene_as_text_reads_back_as_the_same_scene(self):
        scene = candela.Scene.from_dict(FACE)
        np.testing.assert_array_equal(candela.Scene.parse(scene.text()).render(), scene.render())

    def test_frames_of_an_animated_scene(self):
        animated = {**FACE, "animation": {"frames": 3, "fps": 2, "track": [
            {"path": "light.sun.intensity", "keys": [[0.0, 0.0], [1.0, 1.0]]}]}}
        scene = candela.Scene.from_dict(animated)
        self.assertEqual(scene.frame_count, 3)
        means = [float(scene.frame(i).render(floats=True)[..., 0].mean()) for i in range(3)]
        np.testing.assert_allclose(means, np.array([0, 0.5, 1]) * 0.5 * np.sqrt(0.5), rtol=1e-6)


class Renderers(unittest.TestCase):
    def test_every_picture_is_that_of_a_scene_with_the_same_values(self):
        scene = candela.Scene.from_dict(FACE)
        renderer = candela.Renderer(scene)
        for settings in ({"light.sun.intensity": 0.3}, {"object.box.rotation": [0, 30, 0]}, {"image.width": 11},
                         {"reflection.model": "phong", "object.box.material.ks": 0.25}, {"object.box.color": [10, 200, 30]}):
            renderer.update(settings)
            scene = scene.changed(settings)
            np.testing.assert_array_equal(renderer.render(), scene.render())

    def test_a_change_that_is_refused_leaves_the_scene_as_it_was(self):
        renderer = candela.Renderer(candela.Scene.from_dict(FACE))
        before = renderer.render()
        for path, value in (("light.sun.intensity", -1), ("object.box.position", [0, 0, 4]), ("light.moon.intensity", 1)):
            with self.assertRaises(candela.SceneError):
                renderer.set(path, value)
            np.testing.assert_array_equal(renderer.render(), before)


class Mistakes(unittest.TestCase):
    def test_an_error_has_all_that_is_wrong_with_places_and_suggestions(self):
        text = candela.document(FACE).replace("intensity", "intensty").replace("cube", "cub")
        with self.assertRaises(candela.SceneError) as raised:
            candela.Scene.parse(text, name="face.toml")
        unknown_key, unknown_shape = raised.exception.diagnostics
        lines = text.splitlines()
        self.assertEqual((unknown_key.severity, unknown_key.file), ("error", "face.toml"))
        self.assertIn("intensty", lines[unknown_key.line - 1])
        self.assertEqual((unknown_key.column, unknown_key.length), (1, len("intensty")))
        self.assertEqual(unknown_key.text, lines[unknown_key.line - 1])
        self.assertIn("did you mean 'intensity'?", unknown_key.suggestion)
        self.assertIn("did you mean 'cube'?", unknown_shape.message)
        self.assertIn("face.toml:%d:1: error" % unknown_key.line, str(raised.exception))
        self.assertIsInstance(raised.exception, ValueError)

    def test_what_helps_is_said_in_python(self):
        without = {key: value for key, value in FACE.items() if key not in ("shading", "reflection")}
        with self.assertRaises(candela.SceneError) as raised:
            candela.Scene.from_dict(without)
        self.assertIn("defaults=True", raised.exception.diagnostics[0].suggestion)
        self.assertNotIn("--", str(raised.exception))
        candela.Scene.from_dict(without, defaults=True)

    def test_warnings_are_no_errors(self):
        lit = {**FACE, "light": []}
        warnings = candela.Scene.from_dict(lit).warnings
        self.assertTrue(warnings and all(warning.severity == "warning" for warning in warnings))

    def test_files_that_cannot_be_read_and_names_that_nobody_has(self):
        with self.assertRaises(candela.SceneError) as raised:
            candela.Scene.load("/there/is/none.toml")
        self.assertEqual(raised.exception.diagnostics[0].file, "/there/is/none.toml")
        with self.assertRaisesRegex(candela.Error, "did you mean 'phong'"):
            candela.model("reflection/phng")
        with self.assertRaisesRegex(candela.RequestError, "'light', 'reflection', 'shading'"):
            candela.models("lamp")

    def test_what_toml_does_not_have_is_a_type_error(self):
        for value in (None, {1: 2}, object(), 1j):
            with self.assertRaises(TypeError):
                candela.Scene.from_dict({**FACE, "light": [{"type": value}]})
        with self.assertRaises(candela.Error):
            candela.Scene.from_dict({**FACE, "image": {"width": float("nan")}})


class Models(unittest.TestCase):
    def test_models_are_those_that_the_command_lists(self):
        listed = subprocess.run([BUILD / "bin/candela", "list"], check=True, capture_output=True, text=True).stdout
        models = candela.models()
        self.assertGreater(len(models), 30)
        for model in models:
            self.assertIn(model.name, listed)
        self.assertEqual([model for model in models if model.kind == "shape"], candela.models("shape"))

    def test_parameters_have_defaults_and_ranges(self):
        roughness = next(p for p in candela.model("reflection/ggx").parameters if p.name == "roughness")
        self.assertEqual((roughness.type, roughness.maximum), ("real", 1))
        position = next(p for p in candela.model("light/point").parameters if p.name == "position")
        self.assertIsNone(position.default)
        self.assertEqual(position.unit, "m")


if __name__ == "__main__":
    unittest.main()
