"""Makes a comparison and looks at its report.html in headless Chromium, by the DevTools protocol over a pipe.

check_report.py SOFTGRAIN SCENARIO [--keep FOLDER]   exit codes: 0 good, 1 not, 77 there is no chromium
"""
import base64
import fcntl
import json
import os
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time

METHODS = ["sdem", "rigid_dem", "bpm", "mpm"]
MOST_BYTES = 6_000_000
PATIENCE = 60.0  # seconds for one answer of the browser


class Browser:
    """Chromium with one page; every event that it sends is kept."""

    def __init__(self, program, profile):
        to_browser, self.send_end = os.pipe()
        self.receive_end, from_browser = os.pipe()

        def give_pipes():  # the protocol's fixed numbers: 3 to read from, 4 to write to
            spare = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (to_browser, from_browser)]
            os.dup2(spare[0], 3)
            os.dup2(spare[1], 4)

        command = [program, "--headless", "--remote-debugging-pipe", "--disable-gpu", "--no-first-run",
                   "--hide-scrollbars", "--disable-dev-shm-usage", "--user-data-dir=" + profile, "about:blank"]
        if os.geteuid() == 0:
            command.insert(1, "--no-sandbox")
        self.process = subprocess.Popen(command, preexec_fn=give_pipes, pass_fds=(3, 4), stderr=subprocess.DEVNULL,
                                        stdout=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.received, self.events, self.number, self.session = b"", [], 0, None
        page = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def message(self):
        while b"\0" not in self.received:
            if not select.select([self.receive_end], [], [], PATIENCE)[0]:
                raise RuntimeError("the browser does not answer")
            part = os.read(self.receive_end, 1 << 20)
            if not part:
                raise RuntimeError("the browser ended")
            self.received += part
        text, self.received = self.received.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **parameters):
        self.number += 1
        request = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.send_end, json.dumps(request).encode() + b"\0")
        while True:
            answer = self.message()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def open(self, url):
        self.call("Page.navigate", url=url)
        until = time.monotonic() + PATIENCE
        while self.value("document.readyState") != "complete" or self.value("location.href") != url:
            if time.monotonic() > until:
                raise RuntimeError("the page is not loaded")
            time.sleep(0.05)

    def value(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def key(self, name):
        for kind in ("rawKeyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=name, code=name,
                      windowsVirtualKeyCode={"ArrowLeft": 37, "ArrowRight": 39, "Home": 36, "End": 35}[name])

    def window(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def picture(self, path):
        size = self.call("Page.getLayoutMetrics")["cssContentSize"]
        answer = self.call("Page.captureScreenshot", captureBeyondViewport=True,
                           clip={"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1})
        with open(path, "wb") as file:
            file.write(base64.b64decode(answer["data"]))

    def close(self):
        try:
            self.call("Browser.close")
        except (RuntimeError, OSError):
            pass
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()


SHOWN = ("Array.from(document.images).filter(i => i.getBoundingClientRect().height > 0)"
         ".map(i => i.alt).join('; ')")

failures = []


def check(good, what):
    print(("ok    " if good else "WRONG ") + what)
    if not good:
        failures.append(what)


def complaints(events):
    """Messages of the console, of the browser, and uncaught exceptions."""
    said = []
    for event in events:
        if event.get("method") in ("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded"):
            said.append(json.dumps(event["params"])[:300])
    return said


def requests(events):
    """What the page asked for, itself and data: left out."""
    urls = [e["params"]["request"]["url"] for e in events if e.get("method") == "Network.requestWillBeSent"]
    return [u for u in urls if not u.startswith(("data:", "file:///")) and u != "about:blank"] + \
        [u for u in urls if u.startswith("file:///") and not u.endswith("/report.html")]


def check_loading(browser):
    check(not complaints(browser.events), f"no message in the console: {complaints(browser.events)}")
    check(not requests(browser.events), f"no request to elsewhere: {requests(browser.events)}")
    check(browser.value("Array.from(document.images).every(i => i.complete && i.naturalWidth > 0)"),
          "every picture loads")
    count = browser.value("document.images.length")
    check(count == len(METHODS) * 7, f"{count} pictures are those of {len(METHODS)} methods at 7 stages")
    check(browser.value("document.querySelectorAll('figure > svg').length") >= 3, "plots are within the page")
    for heading in ("What was run", "Methods", "Curves", "Pictures", "Distribution", "Energy", "could not do"):
        check(browser.value(f"Array.from(document.querySelectorAll('h2')).some(h => h.innerText.includes('{heading}'))"),
              f"there is a section '{heading}'")
    check(browser.value("document.querySelectorAll('.verdict p').length") == 3, "the verdict has three sentences")


def check_slider(browser):
    stages = []
    browser.value("document.getElementById('stage').focus()")
    last = browser.value(SHOWN)
    check(len(last.split("; ")) == len(METHODS), f"one picture per method is shown: {last}")
    browser.key("Home")
    for _ in range(7):
        stages.append((browser.value(SHOWN), browser.value("document.getElementById('stage-name').value")))
        browser.key("ArrowRight")
    check(len({shown for shown, _ in stages}) == 7, "each stop of the slider shows other pictures, by keyboard")
    check(all(name in shown for shown, name in stages), "the name beside the slider is that of the pictures")
    check(browser.value(SHOWN) == last, "the last stop shows what was shown at first")
    browser.value("(s => { s.value = 2; s.dispatchEvent(new Event('input')); })(document.getElementById('stage'))")
    check(browser.value(SHOWN) == stages[2][0], "a slider that is dragged shows its stage")


def check_widths(browser, folder):
    for width in (1200, 400):
        browser.window(width, 900)
        overflow = browser.value("document.documentElement.scrollWidth - document.documentElement.clientWidth")
        check(overflow <= 0, f"nothing sticks out at {width} pixels ({overflow})")
        browser.picture(os.path.join(folder, f"page_{width}.png"))


def check_print(browser, folder):
    pdf = base64.b64decode(browser.call("Page.printToPDF", preferCSSPageSize=True, printBackground=True)["data"])
    path = os.path.join(folder, "report.pdf")
    with open(path, "wb") as file:
        file.write(pdf)
    boxes = [tuple(float(n) for n in box.split()) for box in re.findall(rb"/MediaBox\s*\[([^\]]*)\]", pdf)]
    check(bool(boxes) and all(abs(b[2] - 595.3) < 1.5 and abs(b[3] - 841.9) < 1.5 for b in boxes),
          f"prints on A4: {len(boxes)} pages, {set(boxes)} points")
    check(2 <= len(boxes) <= 8, "on a few pages")
    browser.call("Emulation.setEmulatedMedia", media="print")
    shown = browser.value(SHOWN)
    last = browser.value("Array.from(document.querySelectorAll('.stage.last img')).map(i => i.alt).join('; ')")
    check(shown == last, f"the last stage is printed, wherever the slider stands: {shown}")
    browser.call("Emulation.setEmulatedMedia", media="screen")


def check_without_script(browser, url):
    browser.call("Emulation.setScriptExecutionDisabled", value=True)
    browser.open(url)
    check(browser.value(SHOWN).count("; ") == len(METHODS) - 1, "without scripts the last pictures are visible")
    check(browser.value("document.getElementById('loading').hidden"), "without scripts there is no slider")
    browser.call("Emulation.setScriptExecutionDisabled", value=False)


def check_report(chromium, softgrain, scenario, folder):
    out = os.path.join(folder, "comparison")
    subprocess.run([softgrain, "compare", scenario, "--methods", ",".join(METHODS), "--out", out, "--quiet", "--force",
                    "--threads", "1"], check=True, stdout=subprocess.DEVNULL)
    report = os.path.join(out, "report.html")
    check(os.path.getsize(report) < MOST_BYTES, f"{os.path.getsize(report)} bytes are less than {MOST_BYTES}")
    alone = os.path.join(folder, "alone", "report.html")  # nothing beside it
    os.makedirs(os.path.dirname(alone), exist_ok=True)
    shutil.copy(report, alone)
    browser = Browser(chromium, os.path.join(folder, "profile"))
    try:
        browser.window(1200, 900)
        url = "file://" + os.path.realpath(alone)
        browser.open(url)
        check_loading(browser)
        check_slider(browser)
        check_print(browser, folder)
        check_widths(browser, folder)
        check(not complaints(browser.events), f"still no message in the console: {complaints(browser.events)}")
        check_without_script(browser, url)
    finally:
        browser.close()


def main():
    softgrain, scenario = sys.argv[1:3]
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not chromium:
        print("skipped: no chromium is installed (Debian: apt-get install chromium)")
        return 77
    keep = sys.argv[4] if len(sys.argv) > 4 and sys.argv[3] == "--keep" else None
    if keep:
        os.makedirs(keep, exist_ok=True)
        check_report(chromium, softgrain, scenario, keep)
    else:
        with tempfile.TemporaryDirectory(prefix="softgrain_report_", ignore_cleanup_errors=True) as folder:
            check_report(chromium, softgrain, scenario, folder)
    print(f"{len(failures)} of the checks failed" if failures else "all good")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
