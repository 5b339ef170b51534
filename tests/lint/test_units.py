#!/usr/bin/env python3
"""What framework/build/units.py puts into one translation unit, and what it keeps apart."""

import os
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, os.path.join(HERE, "../../framework/build"))
import units  # pylint: disable=wrong-import-position


def own(text):
    return "namespace {\n\n" + text + "\n\n}  // namespace\n"


class Units(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def together(self, *texts, **limits):
        """How many sources stand in each unit."""
        paths = []
        for number, text in enumerate(texts):
            paths.append(os.path.join(self.folder.name, f"{number}.cpp"))
            with open(paths[-1], "w", encoding="utf-8") as file:
                file.write(text)
        return [len(unit) for unit in units.units_of(paths, **limits)]

    def test_sources_that_share_nothing_stand_together(self):
        self.assertEqual(self.together(own("int first() { return 1; }"), own("int second() { return 2; }")), [2])

    def test_a_name_that_two_declare_keeps_them_apart(self):
        for text in ("int same() { return 1; }", "constexpr int same = 1;", "struct same {};", "class same : A {};"):
            self.assertEqual(self.together(own(text), own("int same() { return 2; }")), [1, 1], text)

    def test_further_constants_of_a_line_count(self):
        self.assertEqual(self.together("constexpr int kA = 1, kB = 2;\n", "int f() { int kB = 3; return kB; }\n"), [1, 1])

    def test_a_name_that_the_other_mentions_keeps_them_apart(self):
        self.assertEqual(self.together(own("int size() { return 1; }"), "int f(int size) { return size; }\n"), [1, 1])

    def test_members_texts_and_comments_are_no_mention(self):
        for text in ("int f(A a) { return a.size; }", "int f(A* a) { return a->size; }", "int f() { return A::size; }",
                     'const char* f() { return "size"; }', "int f();  // size"):
            self.assertEqual(self.together(own("int size() { return 1; }"), text + "\n"), [2], text)

    def test_what_all_see_keeps_nobody_apart(self):
        self.assertEqual(self.together("int same(int) { return 1; }\n", "int same(float) { return 2; }\n"), [2])

    def test_the_same_import_twice_is_one(self):
        self.assertEqual(self.together("using a::json;\n", "using a::json;\nint f(json);\n"), [2])
        self.assertEqual(self.together("using a::json;\n", "int f(int json);\n"), [1, 1])
        self.assertEqual(self.together("using Json = a::json;\n", "using Json = b::json;\nJson f();\n"), [1, 1])

    def test_units_have_bounds(self):
        texts = [f"int f{i}() {{ return {i}; }}\n" for i in range(5)]
        self.assertEqual(self.together(*texts, most=2), [2, 2, 1])
        self.assertEqual(self.together(*texts, most_bytes=60), [2, 2, 1])

    def test_an_equal_answer_is_not_written_again(self):
        output = os.path.join(self.folder.name, "units.cmake")
        self.together("int a();\n", "int b();\n")
        paths = [os.path.join(self.folder.name, f"{i}.cpp") for i in range(2)]
        units.write(output, paths)
        os.utime(output, (1, 1))
        units.write(output, paths)
        self.assertEqual(os.stat(output).st_mtime, 1)
        with open(output, encoding="utf-8") as file:
            self.assertEqual(file.read().count("UNITY_GROUP"), 1)


if __name__ == "__main__":
    unittest.main()
