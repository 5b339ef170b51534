"""The report of a study in a real browser. Usage: report_test.py PROGRAM (report_samples)."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from webdriver import Browser

PROGRAM = None
HEADING = "#results-body th[data-column='{}']"


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="lightloom-report-")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        subprocess.run([PROGRAM, cls.folder], check=True)
        cls.browser = cls.enterClassContext(Browser()) if hasattr(cls, "enterClassContext") else Browser()
        if not hasattr(cls, "enterClassContext"):
            cls.addClassCleanup(cls.browser.__exit__, None, None, None)

    def setUp(self):
        self.browser.media(prefers_color_scheme="light")
        self.browser.resize(1280, 900)
        self.browser.log("browser")
        self.browser.log("performance")
        self.open("full.html")

    def tearDown(self):
        self.assertEqual(self.browser.log("browser"), [], "the console must stay silent")
        asked = [entry["message"] for entry in self.browser.log("performance") if '"Network.requestWillBeSent"' in entry["message"]]
        outside = [message for message in asked if '"url":"file://' not in message and '"url":"data:' not in message]
        self.assertEqual(outside, [], "no request may leave the page")

    def open(self, name):
        self.browser.open(os.path.join(self.folder, name))

    def value(self, expression):
        return self.browser.value(expression)

    def names(self):
        return self.value("[...document.querySelectorAll('#results-body tr.row:not(.failed) .choose')].map(b => b.textContent)")

    def split(self):
        return int(self.value("document.querySelector('[role=slider]').getAttribute('aria-valuenow')"))

    def zooms(self):
        return self.value("[...new Set([...document.querySelectorAll('.viewport img')].map(i => getComputedStyle(i).transform.split(',')[0]))]")

    def test_slider_moves_by_drag_and_keys(self):
        self.assertEqual(self.split(), 50)
        x, y = self.browser.centre("[role=slider]")
        width = self.value("document.querySelector('.stage').clientWidth")
        self.browser.drag((x, y), (x + width // 4, y))
        self.assertAlmostEqual(self.split(), 75, delta=1)
        clip = self.value("getComputedStyle(document.querySelector('.stage .top')).clipPath")
        self.assertIn("7", clip)
        self.browser.focus("[role=slider]")
        before = self.split()
        self.browser.press("Left", "Left")
        self.assertEqual(self.split(), before - 2)
        self.browser.press("Right", shift=True)
        self.assertEqual(self.split(), before + 8)
        self.browser.press("Home")
        self.assertEqual(self.split(), 0)
        self.browser.press("End")
        self.assertEqual(self.split(), 100)

    def test_zoom_is_shared(self):
        self.assertEqual(self.zooms(), ["matrix(1"])
        self.browser.focus(".stage")
        self.browser.press("+", "+")
        self.assertEqual(self.zooms(), ["matrix(2.25"])
        rendering = self.value("getComputedStyle(document.querySelector('.stage img')).imageRendering")
        self.assertEqual(rendering, "pixelated")
        x, y = self.browser.centre(".cells figure:nth-child(3) .viewport")
        before = self.value("getComputedStyle(document.querySelector('.stage img')).transform")
        self.browser.drag((x, y), (x + 40, y + 20))
        after = self.value("[...new Set([...document.querySelectorAll('.stage img')].map(i => getComputedStyle(i).transform))]")
        self.assertEqual(len(after), 1)
        self.assertNotEqual(after[0], before)
        self.browser.wheel(".stage", -300)
        self.browser.wait("document.querySelector('.zoom-level').textContent !== '2.3×'")
        self.browser.focus(".stage")
        self.browser.press("0")
        self.assertEqual(self.zooms(), ["matrix(1"])

    def test_tables_sort_both_ways_by_click_and_key(self):
        start = self.names()
        column = HEADING.format("FLIP")
        flips = "[...document.querySelectorAll('#results-body tr.row:not(.failed) td:nth-child(3)')].map(c => parseFloat(c.textContent))"
        at = self.value("[...document.querySelectorAll('#results-body th')].findIndex(h => h.dataset.column === 'FLIP') + 1")
        flips = flips.replace("nth-child(3)", f"nth-child({at})")
        self.browser.click(column + " button")
        self.assertEqual(self.value(f"document.querySelector(\"{column}\").getAttribute('aria-sort')"), "ascending")
        values = self.value(flips)
        self.assertEqual(values, sorted(values))
        self.browser.focus(column + " button")
        self.browser.press("Enter")
        self.assertEqual(self.value(f"document.querySelector(\"{column}\").getAttribute('aria-sort')"), "descending")
        values = self.value(flips)
        self.assertEqual(values, sorted(values, reverse=True))
        self.assertTrue(self.value("document.querySelector('#results-body tbody tr:last-child').classList.contains('failed')"))
        self.browser.press("Space")
        self.assertEqual(self.names(), start)

    def test_row_selection_greys_the_graph(self):
        self.browser.run("[...document.querySelectorAll('#results-body .choose')].find(b => b.textContent === 'without distance').click()")
        off = "[...document.querySelectorAll('.graph .node.off[data-pass]')].map(n => n.dataset.pass + ' ' + n.querySelector('.type').textContent)"
        self.assertEqual(sorted(self.value(off)), ["distance disabled", "merge culled", "voxelize_dynamic culled"])
        self.browser.run("[...document.querySelectorAll('#results-body .choose')].find(b => b.textContent === 'paper').click()")
        self.assertEqual(self.value(off), [])

    def test_graph_names_ports(self):
        self.browser.focus(".node[tabindex='0']")
        self.browser.press("End", "Up")
        self.assertEqual(self.value("document.querySelector('.graph-side h3').textContent"), "modulate")
        self.assertIn("surface", self.value("document.querySelector('.graph-side').textContent"))
        self.browser.hover(".node[data-pass='temporal']")
        self.assertIn("@1..9", self.value("document.querySelector('.graph-side').textContent"))

    def test_row_opens_with_command_and_copies_it(self):
        self.browser.click("#results-body tr.row:nth-child(2) .open")
        text = self.value("document.querySelector('.command pre').textContent")
        self.assertTrue(text.startswith("lightloom render graphs/paper.json"))
        self.assertIn("--disable denoise_tangent", text)
        self.browser.click(".command .copy")
        self.browser.wait("document.querySelector('.command .copy').textContent !== 'Copy'")

    def test_theme(self):
        ground = "getComputedStyle(document.body).backgroundColor"
        light = self.value(ground)
        self.browser.media(prefers_color_scheme="dark")
        dark = self.value(ground)
        self.assertNotEqual(light, dark)
        self.browser.click("#theme")
        self.assertEqual(self.value(ground), light)
        self.browser.click("#theme")
        self.assertEqual(self.value(ground), dark)
        self.browser.run("localStorage.clear()")

    def test_pareto_metric_and_axes(self):
        points = "[...document.querySelectorAll('.point[data-setting]')].map(p => p.querySelector('.ring').getAttribute('cy'))"
        before = self.value(points)
        self.assertEqual(len(before), 10)
        self.browser.run("const s = document.getElementById('pareto-metric'); s.value = 'psnr'; s.dispatchEvent(new Event('change'))")
        after = self.value(points)
        self.assertNotEqual(before, after)
        self.assertIn("higher is better", self.value("document.querySelector('#pareto svg[role=group]').textContent"))
        self.assertTrue(self.value("document.querySelector('#pareto svg .front-line').getAttribute('d')") != "")
        self.browser.focus(".point[data-setting][tabindex='0']")
        self.browser.press("Right", "Enter")
        self.assertEqual(self.value("document.activeElement.dataset.setting"), self.value("document.getElementById('setting').value"))

    def test_other_view_and_infinite_numbers(self):
        self.browser.run("const s = document.getElementById('view'); s.value = '1'; s.dispatchEvent(new Event('change'))")
        self.browser.run("[...document.querySelectorAll('#results-body .chooser label')].find(l => l.textContent === 'PSNR').querySelector('input').click()")
        self.assertIn("∞", self.value("document.querySelector('#results-body').textContent"))
        self.assertIn("no number that these axes can show", self.value("document.querySelector('#pareto').textContent"))

    def test_heat_maps(self):
        before = self.value("document.querySelector('.stage .top img').dataset.index")
        self.browser.run("[...document.querySelectorAll('#pictures label')].find(l => l.textContent === 'heat maps').querySelector('input').click()")
        self.assertNotEqual(self.value("document.querySelector('.stage .top img').dataset.index"), before)
        self.assertIn("heat map", self.value("document.querySelector('.stage .tag.right').textContent"))

    def test_odd_studies(self):
        for name, rows in (("one.html", 1), ("many.html", 100), ("hostile.html", None), ("empty.html", 0)):
            with self.subTest(name):
                self.open(name)
                self.assertIsNone(self.value("window.broken ?? null"))
                if rows is not None:
                    self.assertEqual(self.value("document.querySelectorAll('#results-body tr.row').length"), rows)

    def test_narrow_page_does_not_scroll_sideways(self):
        self.browser.resize(400, 800)
        for name in ("full.html", "hostile.html"):
            self.open(name)
            self.assertLessEqual(self.value("document.documentElement.scrollWidth"), 400, name)


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main(verbosity=1)
