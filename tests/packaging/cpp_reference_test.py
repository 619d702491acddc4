"""Checks the C++ reference of a few declarations.

    cpp_reference_test.py ROOT
"""
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "docs/site"))
from cpp import Reference  # noqa: E402

HEADER = """// The interface of horns.
#pragma once

namespace candela {

/// How loud a horn is; see Horn::blow().
struct Loudness {
    float level = 0;  // decibels, with
                      // a reference of 20 micropascals
    bool steady = false;
};

enum class Pitch { low, high };

/// A horn. `Horn` < all others.
class CANDELA_EXPORT Horn : public Instance {
  public:
    ~Horn() override;
    /// Blows for `seconds`.
    virtual Loudness blow(const Pitch& pitch, float seconds = 1) const = 0;

  private:
    int hidden_ = 0;  // nobody's business
};

template <class T>
constexpr T twice(T value) {
    return value + value;  // not a member
}

}  // namespace candela
"""
MODULE = """// Orchestras.
module;

#include <vector>

export module candela.orchestra;

import candela.horn;

export namespace candela {

/// How many play, <count> of them.
CANDELA_EXPORT int players(const std::vector<Horn*>& horns);

}  // namespace candela
"""


class CppReference(unittest.TestCase):
    def reference(self):
        root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        for path, text in (("core/include/candela/horn.h", HEADER), ("core/util/orchestra.cppm", MODULE)):
            (root / path).parent.mkdir(parents=True)
            (root / path).write_text(text)
        navigation = Reference(root, root / "pages", root / "scratch").write()
        return navigation, {path.name: path.read_text() for path in (root / "pages").iterdir()}

    def test_each_header_and_module_has_a_page_in_the_navigation(self):
        navigation, pages = self.reference()
        self.assertEqual(set(pages), {"index.md", "candela-horn-h.md", "candela-orchestra.md"})
        self.assertIn({"Interfaces": [{"horn.h": "cpp/candela-horn-h.md"}]}, navigation)
        self.assertIn({"Modules": [{"candela.orchestra": "cpp/candela-orchestra.md"}]}, navigation)
        self.assertIn("| [`candela/horn.h`](candela-horn-h.md) | The interface of horns |", pages["index.md"])

    def test_declarations_stand_as_they_are_written(self):
        _, pages = self.reference()
        page = pages["candela-horn-h.md"]
        for text in ("#include <candela/horn.h>", "class candela::Horn : public Instance", "enum class Pitch", "~Horn() override;",
                     "virtual Loudness blow(const Pitch& pitch, float seconds = 1) const = 0;",
                     "template <class T>\nconstexpr T twice(T value);"):
            self.assertIn(text, page)
        self.assertIn("import candela.orchestra;", pages["candela-orchestra.md"])
        self.assertIn("int players(const std::vector<Horn*>& horns);", pages["candela-orchestra.md"])

    def test_comments_are_descriptions_wherever_they_stand(self):
        _, pages = self.reference()
        page = pages["candela-horn-h.md"]
        self.assertIn("The interface of horns.", page)
        self.assertIn("| `float level = 0` | decibels, with a reference of 20 micropascals |", page)
        self.assertRegex(page, r"A horn\. .*Horn.* &lt; all others\.")
        self.assertIn("Blows for `seconds`.", page)
        self.assertIn("How many play, &lt;count&gt; of them.", pages["candela-orchestra.md"])

    def test_what_is_named_in_prose_is_linked_to_where_it_is_described(self):
        _, pages = self.reference()
        page = pages["candela-horn-h.md"]
        place = page.partition("### blow {#")[2].partition("}")[0]
        self.assertIn(f"see [`Horn::blow()`](#{place}).", page)

    def test_what_is_private_or_inside_of_functions_is_left_out(self):
        page = self.reference()[1]["candela-horn-h.md"]
        for text in ("hidden_", "nobody", "not a member"):
            self.assertNotIn(text, page)


if not shutil.which("doxygen"):
    print("doxygen is not installed")
    sys.exit(77)
unittest.main()
