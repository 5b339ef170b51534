"""The page of a plan in a real browser. Usage: plan_page_test.py LIGHTLOOM SOURCE_FOLDER."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from webdriver import Browser

PROGRAM = None
SOURCE = None


class PlanPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="lightloom-plan-page-")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        scene = ["--scene", f"{SOURCE}/samples/scenes/atrium.scene.json", "--size", "64x48", "--set", "resolution=16"]
        cls.plans = {}
        for name, graph, more in (("paper", "graphs/paper.json", ["--disable", "denoise_box_x"]), ("lightloom", "graphs/lightloom.json", ["--dump", "trace.*"])):
            whole = [PROGRAM, "plan", f"{SOURCE}/{graph}", *scene, *more, "--memory"]
            plan = json.loads(subprocess.run([*whole, "--format", "json"], check=True, capture_output=True).stdout)
            # Times that tell every step apart: 1 ms, 2 ms, 3 ms, …
            passes = [{"pass": step["pass"], "median_ms": i + 1} for i, step in enumerate(plan["steps"])]
            os.makedirs(f"{cls.folder}/{name}")
            with open(f"{cls.folder}/{name}/run.json", "w", encoding="utf-8") as stream:
                json.dump({"graph": {"plan_hash": plan["hash"]}, "passes": passes}, stream)
            timed = [*whole, "--times", f"{cls.folder}/{name}"]
            cls.plans[name] = json.loads(subprocess.run([*timed, "--format", "json"], check=True, capture_output=True).stdout)
            subprocess.run([*timed, "--format", "html", "--out", f"{cls.folder}/{name}.html"], check=True)
        with open(f"{SOURCE}/samples/graphs/first_graph.json", encoding="utf-8") as stream:
            graph = json.load(stream)
        graph["name"] = "</script><img src=x onerror='window.broken=1'> {{style}} \u2028 \"'&"
        with open(f"{cls.folder}/hostile.json", "w", encoding="utf-8") as stream:
            json.dump(graph, stream)
        subprocess.run([PROGRAM, "plan", f"{cls.folder}/hostile.json", "--format", "html", "--out", f"{cls.folder}/hostile.html"],
                       check=True, stderr=subprocess.DEVNULL)
        cls.browser = Browser().__enter__()
        cls.addClassCleanup(cls.browser.__exit__, None, None, None)

    def setUp(self):
        self.browser.media(prefers_color_scheme="light")
        self.browser.resize(1400, 900)
        self.browser.log("browser")
        self.browser.log("performance")
        self.open("paper")

    def tearDown(self):
        self.assertEqual(self.browser.log("browser"), [], "the console must stay silent")
        asked = [entry["message"] for entry in self.browser.log("performance") if '"Network.requestWillBeSent"' in entry["message"]]
        outside = [message for message in asked if '"url":"file://' not in message and '"url":"data:' not in message]
        self.assertEqual(outside, [], "no request may leave the page")

    def open(self, name):
        self.plan = self.plans.get(name)
        self.browser.open(os.path.join(self.folder, f"{name}.html"))
        self.browser.wait("document.documentElement.dataset.ready === 'true'")

    def value(self, expression):
        return self.browser.value(expression)

    def count(self, selector):
        return self.value(f"document.querySelectorAll(`{selector}`).length")

    def tooltip(self):
        # A busy machine may show it later than the pointer's move has been answered.
        self.browser.wait("!document.getElementById('tooltip').hidden")
        return self.value("document.getElementById('tooltip').textContent")

    def test_order_shows_every_port_and_step(self):
        for name in ("paper", "lightloom"):
            self.open(name)
            ports = {f"{value['pass']}.{value['port']}" for value in self.plan["values"]}
            self.assertEqual(self.count(".order-row"), len(ports))
            self.assertEqual(self.count(".stripe"), len(self.plan["steps"]))
            names = self.value("[...document.querySelectorAll('.step-head .step-name')].map(t => t.textContent)")
            self.assertEqual(names[1:], [step["pass"] for step in self.plan["steps"]])

    def test_marks_are_what_steps_touch(self):
        self.open("lightloom")
        for step in (0, 3, len(self.plan["steps"]) - 1):
            entry = self.plan["steps"][step]
            port = lambda use: use["value"].rsplit(".", use["value"].count(".") - 1)[0]
            written = {port(use) for use in entry["outputs"] + entry["scratch"]}
            read = {port(use) for use in entry["inputs"]}
            marked = set(self.value(f"[...document.querySelectorAll('.order-row')].filter(r => r.querySelector('[data-step=\"{step}\"]')).map(r => r.dataset.find)"))
            self.assertEqual(marked, written | read)
            self.assertEqual(set(self.value(f"[...document.querySelectorAll('.order-row')].filter(r => r.querySelector('.mark.write[data-step=\"{step}\"]')).map(r => r.dataset.find)")), written)

    def test_bars_span_the_lifetimes(self):
        columns = self.value("[...document.querySelectorAll('.stripe')].map(s => [s.x.baseVal.value, s.x.baseVal.value + s.width.baseVal.value])")
        for value in self.plan["values"]:
            if value["kept"] != "frame" or value["part"] != "" or value["first_step"] is None:
                continue
            left, right = self.value(f"(b => [b.x.baseVal.value, b.x.baseVal.value + b.width.baseVal.value])(document.querySelector('.order-row[data-find=\"{value['name']}\"] .life'))")
            self.assertAlmostEqual(left, columns[value["first_step"]][0], delta=3)
            self.assertAlmostEqual(right, columns[value["last_step"]][1], delta=3)

    def test_barriers_have_reasons_on_hover_and_in_the_list(self):
        self.browser.hover(".step-head[data-step='5'] .wait")
        reasons = {barrier["reason"] for barrier in self.plan["steps"][5]["barriers"]}
        self.assertGreater(len(reasons), 0)
        for reason in reasons:
            self.assertIn(reason, self.tooltip())
        listed = self.value("[...document.querySelectorAll('#barriers tbody tr')].map(r => r.cells[4].textContent)")
        def all_reasons(node):
            if isinstance(node, dict):
                return ([node["reason"]] if "takes_over" in node else []) + [r for child in node.values() for r in all_reasons(child)]
            return [r for child in node for r in all_reasons(child)] if isinstance(node, list) else []
        self.assertEqual(set(listed), set(all_reasons(self.plan)))
        shown = "[...document.querySelectorAll('#barriers tbody tr')].filter(r => r.offsetHeight > 0).length"
        before = self.value(shown)
        self.browser.run("[...document.querySelectorAll('#barriers label')].find(l => l.textContent.includes('shared memory')).querySelector('input').click()")
        self.assertLess(self.value(shown), before)

    def test_memory_map_has_no_overlap_and_its_lines(self):
        for name in ("paper", "lightloom"):
            self.open(name)
            placed = [value for value in self.plan["values"] if value["place"] is not None]
            boxes = self.value("[...document.querySelectorAll('#memory svg')].map(s => [...s.querySelectorAll('.place rect')].map(r => [r.x.baseVal.value, r.y.baseVal.value, r.width.baseVal.value, r.height.baseVal.value]))")
            self.assertEqual(sum(len(heap) for heap in boxes), len(placed))
            self.assertEqual(self.count("#memory .bound"), len(self.plan["memory"]["heaps"]))
            for heap in boxes:
                for i, (x, y, w, h) in enumerate(heap):
                    for u, v, p, q in heap[:i]:
                        # Slivers are drawn a pixel or two high at least.
                        overlap = min(x + w, u + p) - max(x, u) > 1 and min(y + h, v + q) - max(y, v) > 2
                        self.assertFalse(overlap, (name, heap[i]))

    def test_critical_path(self):
        times = self.plan["times"]
        self.assertEqual(self.count("#times .time-row .time.on"), len(times["critical_steps"]))
        self.assertEqual(self.count("#times .time-row"), len(self.plan["steps"]))
        self.assertIn(f"{times['sum_ms']:.0f}", self.value("document.querySelector('#times .lead').textContent"))
        ends = self.value("[...document.querySelectorAll('#times .time-row .time.on')].map(b => [b.x.baseVal.value, b.x.baseVal.value + b.width.baseVal.value])")
        for (_, end), (start, _) in zip(ends, ends[1:]):
            self.assertAlmostEqual(end, start, delta=2)
        self.assertEqual(self.count(".stripe.critical"), len(times["critical_steps"]))

    def test_steps_and_what_is_left_out(self):
        self.assertEqual(self.count("details.step"), len(self.plan["steps"]) + len(self.plan["once"]))
        self.browser.click("#steps .controls button")
        self.assertEqual(self.count("details.step[open]"), self.count("details.step"))
        left = self.value("document.querySelector('#left').textContent")
        self.assertIn("denoise_box_x", left)
        for entry in self.plan["bypassed"] + self.plan["culled"]:
            self.assertIn(entry["reason"], left)
        for step in self.plan["once"]:
            self.assertIn(step["once"], left)

    def test_search_and_step_highlight(self):
        self.browser.run("const s = document.getElementById('search'); s.value = 'Temporal'; s.dispatchEvent(new Event('input'))")
        self.assertEqual(self.count("details.step.found"), 1)
        self.assertGreater(self.count(".order-row.unfound"), 5)
        self.browser.run("const s = document.getElementById('search'); s.value = ''; s.dispatchEvent(new Event('input'))")
        self.assertEqual(self.count(".unfound"), 0)
        self.browser.hover(".step-head[data-step='6'] .step-number")
        self.assertGreater(self.count(".order-row.apart"), 3)
        self.assertIn(self.plan["steps"][6]["pass"], self.tooltip())

    def test_keyboard_reaches_values(self):
        self.browser.focus(".order-row[tabindex='0']")
        self.browser.press("Down")
        self.assertEqual(self.value("document.activeElement.dataset.find"), self.value("document.querySelectorAll('.order-row')[1].dataset.find"))
        self.assertIn(self.value("document.activeElement.dataset.find"), self.tooltip())

    def test_theme(self):
        ground = "getComputedStyle(document.body).backgroundColor"
        light = self.value(ground)
        self.browser.media(prefers_color_scheme="dark")
        dark = self.value(ground)
        self.assertNotEqual(light, dark)
        self.browser.click("#theme")
        self.assertEqual(self.value(ground), light)
        self.browser.run("localStorage.clear()")

    def test_names_cannot_become_markup(self):
        self.open("hostile")
        self.assertIsNone(self.value("window.broken ?? null"))
        self.assertIn("onerror", self.value("document.querySelector('h1').textContent"))
        self.assertTrue(self.value("document.getElementById('times').hidden"), "no times were given")
        self.assertIn("--memory", self.value("document.getElementById('memory').textContent"))

    def test_narrow_page_does_not_scroll_sideways(self):
        self.browser.resize(400, 800)
        for name in ("paper", "hostile"):
            self.open(name)
            self.assertLessEqual(self.value("document.documentElement.scrollWidth"), 400, name)


if __name__ == "__main__":
    SOURCE = os.path.abspath(sys.argv.pop(2))
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main(verbosity=1)
