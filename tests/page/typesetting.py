"""Formulas as the page typesets them."""
import scenes
from generated import Generated, PageTest

# The expected formulas, by element: fractions as {a/b}, powers and indices in braces.
EXPECTED = {
    "phong": ["R=2N(N·L)−L", "I_{a}=k_{a}C_{o}I_{ambient}", "I_{d}=k_{d}C_{o}I_{L}max(N·L,0)",
              "I_{s}=k_{s}I_{L}max(R·V,0)^{shininess} where N·L>0, else 0"],
    "blinn-phong": ["H={L+V/|L+V|}", "I_{a}=k_{a}C_{o}I_{ambient}", "I_{d}=k_{d}C_{o}I_{L}max(N·L,0)",
                    "I_{s}=k_{s}I_{L}max(N·H,0)^{shininess} where N·L>0, else 0"],
    "half-lambert": ["I_{a}=k_{a}C_{o}I_{ambient}", "I_{d}=k_{d}C_{o}I_{L}({N·L/2}+{1/2})^{n}"],
    "ggx": ["I_{a}=k_{a}C_{o}I_{ambient}", "I_{d}=k_{d}C_{o}I_{L}max(N·L,0)",
            "I_{s}={k_{s}I_{L}FDG/4N·V}", "D={α^{2}/((N·H)^{2}(α^{2}−1)+1)^{2}}",
            "G={2N·LN·V/N·L√{α^{2}+(1−α^{2})(N·V)^{2}}+N·V√{α^{2}+(1−α^{2})(N·L)^{2}}}"],
}

READ = """
    const read = (node) => {
        const inner = [...node.childNodes].map(read);
        switch (node.localName) {
            case "mfrac": return `{${inner.join("/")}}`;
            case "msub": return `${inner[0]}_{${inner[1]}}`;
            case "msup": return `${inner[0]}^{${inner[1]}}`;
            case "msqrt": return `√{${inner.join("")}}`;
            case "mtext": return ` ${node.textContent.trim()} `;
            default: return node.nodeType === Node.TEXT_NODE ? node.textContent : inner.join("");
        }
    };
    const line = (one) => [...one.children].map(read).join(" ").replace(/[\\u2061\\u00a0]/g, "").replace(/ +/g, " ").trim();
"""


class Typesetting(PageTest):
    def lines(self, model):
        self.browser.enter("[data-path=reflection] select", model)
        return self.browser.run(READ + """
            return [...document.querySelectorAll("#formulas details")][0].querySelectorAll(".formula-line")
                .values().map(line).toArray();""")

    def test_formulas_are_set_as_a_person_would_write_them(self):
        generated = Generated("formulas", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        for model, expected in EXPECTED.items():
            with self.subTest(model):
                self.assertEqual(self.lines(model), expected)
        # Every formula is typeset: no shipped model's equation is left as text.
        for model in generated.scene["reflection_models"]:
            lines = self.lines(model)
            self.assertTrue(lines)
            said = self.browser.run("return [...document.querySelectorAll('#formulas .said')].map((one) => one.textContent)")
            self.assertEqual([text for text in said if " = " in text and "falloff" not in text], [], model)
        self.assertEqual(self.browser.errors(), [])
