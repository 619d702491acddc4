"""Runs the notebooks of docs/examples/notebooks, cell by cell, and compares their results with known ones. The only Jupyter feature that they need is
showing the value of a cell's last line; installing Jupyter for that would take 30 packages."""
import ast
import contextlib
import io
import json
import pathlib
import unittest

import numpy as np

NOTEBOOKS = pathlib.Path(__file__).resolve().parents[2] / "docs/examples/notebooks"


def run(name):
    """The final definitions, and the pictures that were shown."""
    notebook = json.loads((NOTEBOOKS / name).read_text(encoding="utf-8"))
    names, pictures = {"__name__": "__main__"}, []
    for i, cell in enumerate(cell for cell in notebook["cells"] if cell["cell_type"] == "code"):
        assert not cell["outputs"], f"{name} must be stored without outputs"
        tree = ast.parse("".join(cell["source"]), f"{name}, code cell {i}")
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        with contextlib.redirect_stdout(io.StringIO()):
            exec(compile(tree, f"{name}, code cell {i}", "exec"), names)
            shown = eval(compile(ast.Expression(last.value), f"{name}, code cell {i}", "eval"), names) if last else None
        if hasattr(shown, "_repr_png_"):
            pictures.append(shown._repr_png_())
    return names, pictures


class Notebooks(unittest.TestCase):
    def test_all_are_tested(self):
        tested = {"highlights.ipynb", "measured.ipynb", "white-furnace.ipynb", "worked-examples.ipynb"}
        self.assertEqual({path.name for path in NOTEBOOKS.glob("*.ipynb")}, tested)

    def test_blinn_phong_needs_four_times_phong_s_exponent(self):
        names, pictures = run("highlights.ipynb")
        ratios = names["ratios"]
        # cos^n a is exp(-n a^2 / 2) for small a, and the half vector turns by a/2: 4 in the limit.
        self.assertAlmostEqual(ratios[512], 4, delta=0.02)
        distance = [abs(ratios[n] - 4) for n in (8, 32, 128, 512)]
        self.assertEqual(distance, sorted(distance, reverse=True))
        self.assertTrue(pictures[0].startswith(b"\x89PNG"))

    def test_in_a_furnace_no_bounded_model_is_brighter_than_its_surroundings(self):
        names, pictures = run("white-furnace.ipynb")
        albedos = names["albedos"]
        candela = names["candela"]
        self.assertEqual(sorted(albedos), sorted(model.name for model in candela.models("reflection")))
        np.testing.assert_allclose(albedos["lambert"], 0.7, rtol=1e-5)
        # Phong's lobe about the normal, where R.V is N.L: k_d + k_s times the integral of cos^n, over pi.
        np.testing.assert_allclose(albedos["phong"][0], 0.7 + 0.3 * 2 / (32 + 1), rtol=1e-3)
        for model in candela.models("reflection"):
            if "energy-bounded" in model.properties:
                self.assertLess(max(albedos[model.name]), 1 + 1e-3, model.name)
        # From above, with alpha 1: the integral of c / (c + 1) over the cosine c, times Fresnel's ((100 - 1) / (100 + 1))^2.
        self.assertAlmostEqual(names["metal"][1.0], (1 - np.log(2)) * (99 / 101) ** 2, delta=0.003)
        metal = list(names["metal"].values())
        self.assertEqual(metal, sorted(metal, reverse=True))
        self.assertEqual(len(pictures), 1)

    def test_a_fit_finds_the_material_that_a_file_was_made_of(self):
        names, pictures = run("measured.ipynb")
        error, (kd, ks), roughness = names["results"]["ggx"]
        known = names["KNOWN"]
        self.assertEqual(names["name"], "ggx")
        self.assertLess(error, 0.05)
        np.testing.assert_allclose([kd, ks, roughness], [known["kd"], known["ks"], known["roughness"]], rtol=0.05)
        self.assertEqual(len(pictures), 1)

    def test_the_worked_examples_give_the_notes_numbers(self):
        names, _ = run("worked-examples.ipynb")
        np.testing.assert_allclose(names["r"], [0.8944, 0.4472, 0], atol=5e-5)
        np.testing.assert_allclose([names["cos_theta"], names["cos_alpha"]], [0.7071, 0.8575], atol=5e-5)
        np.testing.assert_allclose(names["incident"].to_light, [-0.4962, 0.8683, 0], atol=2e-4)
        np.testing.assert_allclose([names["n_dot_l"], names["red"]], [0.4135, 0.4353], atol=2e-4)
        self.assertLess(names["parts"].specular[0], 1e-6)


if __name__ == "__main__":
    unittest.main()
