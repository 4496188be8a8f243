"""Tests the pages in a headless Chromium as readers use them: wide and narrow, light and dark, by keyboard, and with a
screen reader.

  TRIPTYCH_PROGRAM=build/release/src/app/triptych tests/browser/page_test.py [TEST…]

With TRIPTYCH_PICTURES=FOLDER, it leaves screenshots in that folder. With TRIPTYCH_AXE=FILE, it also checks the pages with
axe-core, which is not a Debian package: `npm pack axe-core` downloads an archive that contains axe.min.js.
"""
import itertools
import os
import sys
import tempfile
import time
import unittest

import devtools
import pages

HERE = os.path.dirname(os.path.abspath(__file__))
WIDE, NARROW, SMALL = (1400, 900), (390, 900), (700, 500)  # kept small, because smaller windows are drawn faster
WAYS = [(size, dark) for size in (WIDE, NARROW) for dark in (False, True)]
made = {}


def setUpModule():
    # Shared by all tests, because starting a browser takes a second.
    PageTest.browser = unittest.enterModuleContext(devtools.Browser())
    folder = tempfile.TemporaryDirectory(prefix="triptych-page-")
    unittest.addModuleCleanup(folder.cleanup)
    triptych = pages.Triptych(os.path.abspath(os.environ["TRIPTYCH_PROGRAM"]), folder.name)
    made.update(pages.make(triptych))


class PageTest(unittest.TestCase):
    maxDiff = None

    def opened(self, name, size=WIDE, dark=False):
        page = self.enterContext(self.browser.open(made[name], *size, dark))
        with open(os.path.join(HERE, "looks.js"), encoding="utf-8") as file:
            page.value(file.read())
        return page

    def assert_looks(self, page, *names):
        for name in names:
            with self.subTest(name):
                self.assertEqual(page.value(f"looks.{name}()"), [])


class Everywhere(PageTest):
    def test_each_page_each_way(self):
        for name, ((width, height), dark) in itertools.product(made, WAYS):
            with self.subTest(page=name, width=width, dark=dark):
                page = self.opened(name, (width, height), dark)
                keep(page, f"{name}-{width}-{'dark' if dark else 'light'}")
                self.assert_looks(page, "overflow", "brokenPictures", "links", "alternatives")
                page.value("looks.openAll()")
                self.assert_looks(page, "overflow", "contrast", "smallText", "charts", "overlaps")
                self.assertEqual(page.complaints(), [])

    def test_everything_has_a_name(self):
        for name in made:
            page = self.opened(name)
            page.value("looks.openAll()")
            told = page.names()
            if name != "history":
                self.assertEqual([text for role, text in told if role == "combobox"], ["Device", "Suite", "Check"])
                page.value("document.querySelector('[data-scene] button').click()")
                told += page.names()  # while a dialog is open, the browser does not report what is behind it
                self.assertEqual([text for role, text in told if role == "combobox"][3:], ["Left", "Right"])
                self.assertIn(("slider", "Border between the left and the right image"), told)
            named = {"button", "link", "image", "img", "search", "dialog", "DisclosureTriangle"}
            self.assertEqual([role for role, text in told if role in named and not text], [], name)

    @unittest.skipUnless(os.environ.get("TRIPTYCH_AXE"), "TRIPTYCH_AXE does not name axe.min.js")
    def test_axe_finds_nothing_serious(self):
        with open(os.environ["TRIPTYCH_AXE"], encoding="utf-8") as file:
            axe = file.read()
        for name, ((width, height), dark) in itertools.product(made, WAYS):
            with self.subTest(page=name, width=width, dark=dark):
                page = self.opened(name, (width, height), dark)
                page.value("looks.openAll()")
                page.value(f"{axe};0")
                self.assertEqual(page.value("""axe.run(document, {resultTypes: ['violations']}).then(({violations}) =>
                    violations.filter(each => ['serious', 'critical'].includes(each.impact))
                    .map(each => [each.id, each.nodes[0].html]))"""), [])

    # The Content-Security-Policy allows only the script whose hash it contains.
    def test_a_planted_script_does_not_run(self):
        pages_opened = {name: self.opened(name, SMALL) for name in made}
        for page in pages_opened.values():
            page.value("""(() => {
                const script = document.createElement('script');
                script.textContent = 'window.planted = 1';
                const image = document.createElement('img');
                image.setAttribute('onerror', 'window.planted = 2');
                image.src = 'data:,x';
                document.body.append(script, image);
                return 0; })()""")
        time.sleep(0.3)
        for name, page in pages_opened.items():
            self.assertEqual(page.value("window.planted === undefined"), True, name)

    def test_a_pass_is_small(self):
        self.assertLess(os.path.getsize(made["pass"]), 2_000_000)


def keep(page, name):
    folder = os.environ.get("TRIPTYCH_PICTURES")
    if folder:
        with open(os.path.join(folder, name + ".png"), "wb") as file:
            file.write(page.screenshot())


FINDINGS = "[...document.querySelectorAll('article[data-kind=finding]')]"
INSIDE = "(r => r.width > 0 && r.top >= -1 && r.left >= -1 && r.bottom <= innerHeight + 1 && r.right <= innerWidth + 1)"


class Verdict(PageTest):
    def test_the_first_screen_tells_verdict_findings_and_the_first_failing_picture(self):
        page = self.opened("fail")
        for what in ("header h1", "header .causes li:last-child", "article[data-kind=finding] h3",
                     "[data-kind=image] img[alt^='the difference']", "[data-kind=image] b.regression"):
            self.assertTrue(page.value(f"{INSIDE}(document.querySelector(\"{what}\").getBoundingClientRect())"), what)

    def test_every_fault_is_found(self):
        page = self.opened("fail")
        texts = page.value(f"{FINDINGS}.map(each => each.textContent)")
        for fault, says in {"half_voxel_shift": "exceed the error bound", "crash": "SIGSEGV", "hang": "no answer within",
                            "lost_counter": "", "slowdown:20": "instructions"}.items():
            self.assertTrue([text for text in texts if f"[injected: {fault}]" in text and says in text],
                            f"{fault} in {texts}")

    def test_links_lead_to_every_finding_and_back(self):
        for size in (WIDE, NARROW):
            page = self.opened("fail", size)
            ids = page.value(f"{FINDINGS}.map(each => each.id)")
            self.assertGreaterEqual(len(ids), 5)
            linked = page.value("[...document.querySelectorAll('#verdict .causes a')].map(each => each.hash.slice(1))")
            self.assertEqual(linked, ids)
            for each in ids:
                page.value(f"document.querySelector('#verdict a[href=\"#{each}\"]').click()")
                page.until(f"{INSIDE}(document.querySelector('#{each} h3').getBoundingClientRect())")
                page.value(f"document.querySelector('#{each} a[href=\"#verdict\"]').click()")
                page.until(f"{INSIDE}(document.querySelector('#verdict h1').getBoundingClientRect())")

    def test_pictures_and_findings_link_to_each_other(self):
        page = self.opened("fail")
        pairs = page.value(f"{FINDINGS}.map(each => [each.id, each.querySelector('a:not([href=\"#verdict\"])')?.hash])")
        for finding, image in [pair for pair in pairs if pair[1]]:
            back = page.value(f"document.querySelector('{image}').closest('section').querySelector('a[href^=\"#cause\"]').hash")
            self.assertIn(back[1:], [each for each, _ in pairs])
            page.value(f"document.querySelector('#{finding} a[href=\"{image}\"]').click()")
            page.until(f"(r => r.height > 0 && r.top < innerHeight && r.bottom > 0)"
                       f"(document.querySelector('{image}').closest('section').getBoundingClientRect())")

    def test_what_drew_nothing_has_a_tile_that_says_so(self):
        page = self.opened("fail")
        tiles = page.value("[...document.querySelectorAll('.tile')].map(each => [each.textContent, each.ariaLabel])")
        self.assertIn(["crashed", "gl:llvmpipe-egl: crashed, no image"], tiles)
        self.assertIn(["hung", "opencl:pocl: hung, no image"], tiles)

    def test_passes_are_folded_away(self):
        page = self.opened("fail")
        count = "[...document.querySelectorAll('b.pass')].filter(each => each.checkVisibility()).length"
        self.assertEqual(page.value(count), 0)
        page.value("looks.openAll()")
        self.assertGreater(page.value(count), 0)
        self.assertEqual(self.opened("pass").value(f"{FINDINGS}.length"), 0)


class Keyboard(PageTest):
    FOCUSED = """(element => ({
        text: element.textContent.slice(0, 30), tag: element.tagName, hash: element.hash,
        place: [...document.querySelectorAll('*')].indexOf(element),
        outline: parseFloat(getComputedStyle(element).outlineWidth) * (getComputedStyle(element).outlineStyle !== 'none'),
        inside: (r => r.top < innerHeight && r.bottom > 0)(element.getBoundingClientRect())}))(document.activeElement)"""

    def tabbed(self, page, most=400):
        seen = []
        for _ in range(most):
            page.press("Tab")
            focused = page.value(self.FOCUSED)
            if focused["tag"] == "BODY":
                return seen
            seen.append(focused)
        self.fail("the keyboard focus is trapped")

    def test_the_focus_goes_through_the_page_in_its_order_and_is_seen(self):
        for name, dark in [("fail", False), ("fail", True), ("accuracy", False), ("history", False)]:
            page = self.opened(name, SMALL, dark)
            seen = self.tabbed(page)
            places = [each["place"] for each in seen]
            self.assertEqual(places, sorted(places), name)
            self.assertEqual([each for each in seen if each["outline"] < 2 or not each["inside"]], [], name)
            controls = page.value("[...document.querySelectorAll('a, button, select, summary, input')]"
                                  ".filter(each => each.checkVisibility()).length")
            self.assertGreaterEqual(len(seen), controls, name)

    def test_enter_leads_to_a_finding_and_back(self):
        page = self.opened("fail", SMALL)
        page.press("Tab")
        target = page.value("document.activeElement.hash")
        self.assertEqual(target, "#cause0")
        page.press("Enter")
        page.until(f"location.hash === '{target}'")
        page.press("Tab")
        self.assertTrue(page.value(f"document.querySelector('{target}').contains(document.activeElement)"))
        while page.value("document.activeElement.hash") != "#verdict":
            page.press("Tab")
        page.press("Enter")
        page.until("location.hash === '#verdict' && scrollY < 50")

    def test_a_comparison_opens_moves_and_closes(self):
        page = self.opened("fail", SMALL)
        page.value("document.querySelector('[data-scene] button').focus()")
        page.press("Enter")
        page.until("document.querySelector('#compare').open")
        self.assertTrue(page.value("document.querySelector('#compare').contains(document.activeElement)"))
        while page.value("document.activeElement.type") != "range":
            page.press("Tab")
        before = page.value("getComputedStyle(document.querySelector('.layer.over')).clipPath")
        page.press("ArrowRight")
        self.assertNotEqual(page.value("getComputedStyle(document.querySelector('.layer.over')).clipPath"), before)
        page.press("Escape")
        page.until("!document.querySelector('#compare').open")
        self.assertEqual(page.value("document.activeElement.textContent"), "Compare with a slider")


class Comparison(PageTest):
    def open_first(self, size):
        page = self.opened("fail", size)
        page.value("document.querySelector('[data-scene] button').click()")
        page.until("document.querySelector('#compare').open")
        return page

    def names_of(self, page):
        return page.value("[...document.querySelector('#compare select').options].map(each => each.value)")

    # Selects two images in the comparison and moves the border between them to `place` percent. Returns a screenshot of the view
    # without its leftmost and rightmost four pixels, so that the border is not visible if `place` is 0 or 100.
    def shown(self, page, left, right, place):
        page.value(f"""(() => {{
            const [a, b] = document.querySelectorAll('#compare select');
            [a.value, b.value] = {[left, right]!r};
            a.dispatchEvent(new Event('change', {{bubbles: true}}));
            const slider = document.querySelector('#compare input');
            slider.value = {place};
            slider.dispatchEvent(new Event('input'));
            return Promise.all([...document.querySelectorAll('.view img')].map(each => each.decode()));
        }})()""")
        x, y, width, height = page.value("(r => [r.x, r.y, r.width, r.height])"
                                         "(document.querySelector('.view').getBoundingClientRect())")
        return page.screenshot({"x": round(x) + 4, "y": round(y), "width": round(width) - 8, "height": round(height)})

    def test_the_slider_goes_from_one_picture_to_the_other(self):
        for size in (WIDE, NARROW):
            page = self.open_first(size)
            names = self.names_of(page)
            self.assertIn("the reference image", names)
            self.assertGreaterEqual(len(names), 5)
            neighbours = list(itertools.pairwise(names if size == WIDE else names[:2]))
            alone = {name: self.shown(page, name, name, 0) for name in {each for pair in neighbours for each in pair}}
            if size == WIDE:
                keep(page, "comparison")
                self.assertGreaterEqual(len(set(alone.values())), 3)
            for left, right in neighbours:
                ends = [self.shown(page, left, right, place) for place in (0, 100)]
                self.assertEqual(ends, [alone[right], alone[left]], (left, right))
                if ends[0] != ends[1]:
                    self.assertNotIn(self.shown(page, left, right, 50), ends, (left, right))

    def test_zoom_shows_the_worst_pixel_in_its_frame(self):
        for size in (WIDE, NARROW):
            page = self.open_first(size)
            self.assertFalse(page.value("document.querySelector('.mark').checkVisibility()"))
            page.value("document.querySelector('.zoom').click()")
            keep(page, f"zoom-{size[0]}")
            self.assertEqual(page.value("document.querySelector('.zoom').ariaPressed"), "true")
            place = page.value("""(() => {
                const {x, y} = document.querySelector('[data-x]').dataset;
                const image = document.querySelector('.layer img');
                const box = image.getBoundingClientRect();
                const mark = document.querySelector('.mark').getBoundingClientRect();
                const view = document.querySelector('.view').getBoundingClientRect();
                const at = [box.x + (+x + .5) / image.naturalWidth * box.width,
                            box.y + (+y + .5) / image.naturalHeight * box.height];
                return {off: Math.hypot(at[0] - mark.x - mark.width / 2, at[1] - mark.y - mark.height / 2),
                        within: at[0] > view.x && at[0] < view.right && at[1] > view.y && at[1] < view.bottom,
                        scale: box.width / view.width,
                        said: document.querySelector('#compare output').textContent.includes(`${x}, ${y}`)};
            })()""")
            self.assertLess(place.pop("off"), 1)
            self.assertGreater(place.pop("scale"), 2)
            self.assertEqual(place, {"within": True, "said": True})
            page.value("document.querySelector('.zoom').click()")
            self.assertFalse(page.value("document.querySelector('.mark').checkVisibility()"))


class Filters(PageTest):
    COUNTS = """(() => {
        const parts = [...document.querySelectorAll('[data-kind]')];
        const fits = part => !part.dataset[NAME] || part.dataset[NAME].split(' ').includes(VALUE);
        return {wrong: parts.filter(part => part.hidden === fits(part)).length, all: parts.length,
                hidden: parts.filter(part => part.hidden).length,
                empty: [...document.querySelectorAll('.scene')].filter(scene => !scene.hidden &&
                    ![...scene.querySelectorAll('[data-kind]')].some(part => !part.hidden)).length,
                findings: ['finding'].map(kind => parts.filter(part => part.dataset.kind === kind))
                    .map(of => `${of.filter(part => !part.hidden).length} of ${of.length} finding`)[0],
                said: document.querySelector('#filters output').textContent};
    })()"""

    def test_each_choice_shows_what_it_names_and_says_what_is_hidden(self):
        page = self.opened("fail")
        choices = page.value("[...document.querySelectorAll('#filters select')].flatMap(select => "
                             "[...select.options].map(option => [select.name, option.value]))")
        self.assertEqual({name for name, _ in choices}, {"device", "suite", "check"})
        for name, value in [choice for choice in choices if choice[1]]:
            page.value(f"""(select => {{select.value = '{value}';
                select.dispatchEvent(new Event('change', {{bubbles: true}}))}})(document.querySelector('[name={name}]'))""")
            counts = page.value(self.COUNTS.replace("NAME", f"'{name}'").replace("VALUE", f"'{value}'"))
            self.assertEqual((counts["wrong"], counts["empty"]), (0, 0), (name, value, counts))
            self.assertIn(counts["findings"], counts["said"])
            self.assertIn(("status", counts["said"]),
                          [(role, text or counts["said"]) for role, text in page.names()])
            page.value("document.querySelector('#filters button').click()")
            page.until("![...document.querySelectorAll('[data-kind]')].some(part => part.hidden)")
            self.assertEqual(page.value("document.querySelector('#filters output').textContent"), "")
        self.assertGreater(len(choices), 10)


def main():
    if not devtools.program():
        print(f"skipped: none of {', '.join(devtools.PROGRAMS)} is installed; ci/setup installs the first")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        there = pages.Triptych(os.path.abspath(os.environ["TRIPTYCH_PROGRAM"]), folder).devices()
    if there != pages.DEVICES:
        print(f"skipped: needs {', '.join(pages.DEVICES)}; found {', '.join(there) or 'none of them'}")
        return 77
    return 0 if unittest.main(exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
