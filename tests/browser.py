"""Drives a headless Chromium by its DevTools protocol over two pipes (no network, nothing to install but chromium). Commands are arguments:
open FILE[#HASH] | size W H [PIXELS] | eval EXPRESSION | wait EXPRESSION | key NAME | move X Y | drag X0 Y0 X1 Y1 | wheel X Y DELTA |
pinch X Y FACTOR | shot FILE | dark
eval prints its value as JSON. Ends with 1 if the console had an error or a warning, if a script failed, or if anything but FILE was asked for.
NO_WEBGL=1: a browser without it. SPDX-License-Identifier: GPL-3.0-or-later"""
import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--remote-debugging-pipe", "--force-color-profile=srgb", "--font-render-hinting=none"]
WEBGL = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
KEYS = {"Space": " "}


class Browser:
    def __init__(self):
        self.home = tempfile.mkdtemp()
        to_read, self.write = os.pipe()
        self.read, to_write = os.pipe()
        self.complaints, self.waiting, self.number, self.session, self.rest = [], {}, 0, None, b""

        def pipes():
            read, write = os.dup(to_read), os.dup(to_write)  # out of the way, if one of them is 3 or 4
            os.dup2(read, 3)
            os.dup2(write, 4)
        flags = FLAGS + (["--disable-3d-apis"] if os.environ.get("NO_WEBGL") else WEBGL) + ["--user-data-dir=" + self.home, "about:blank"]
        self.process = subprocess.Popen(["chromium"] + flags, preexec_fn=pipes, close_fds=False, stdin=subprocess.DEVNULL,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, "HOME": self.home})
        os.close(to_read)
        os.close(to_write)
        target = [t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page"][0]["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in "Page", "Runtime", "Log", "Network":
            self.call(domain + ".enable")

    def call(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters, **({"sessionId": self.session} if self.session else {})}
        os.write(self.write, json.dumps(message).encode() + b"\0")
        number = self.number
        while number not in self.waiting:
            self.take()
        answer = self.waiting.pop(number)
        if "error" in answer:
            raise SystemExit("%s: %s" % (method, answer["error"]["message"]))
        return answer["result"]

    def take(self):
        while b"\0" not in self.rest:
            more = os.read(self.read, 1 << 20)
            if not more:
                raise SystemExit("chromium ended")
            self.rest += more
        line, self.rest = self.rest.split(b"\0", 1)
        event = json.loads(line)
        if "id" in event:
            self.waiting[event["id"]] = event
        elif event["method"] == "Runtime.exceptionThrown":
            details = event["params"]["exceptionDetails"]
            self.complaints.append(details.get("exception", {}).get("description", details["text"]))
        elif event["method"] == "Runtime.consoleAPICalled":
            self.complaints.append(" ".join(str(a.get("value", a.get("description"))) for a in event["params"]["args"]))
        elif event["method"] == "Log.entryAdded":
            text = event["params"]["entry"]["text"]
            if "GPU stall due to ReadPixels" not in text:  # how a browser without a GPU puts a canvas onto the screen
                self.complaints.append(text)
        elif event["method"] == "Network.requestWillBeSent":
            url = event["params"]["request"]["url"]
            if not url.startswith(("file:", "data:", "about:")):
                self.complaints.append("asked for " + url)

    def evaluate(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise SystemExit("%s: %s" % (expression, answer["exceptionDetails"].get("exception", {}).get("description")))
        return answer["result"].get("value")

    def settle(self):
        self.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=float(x), y=float(y), **more)

    def do(self, command):
        word, _, rest = command.partition(" ")
        words = rest.split()
        if word == "open":
            path, _, address = rest.partition("#")
            self.call("Page.navigate", url="file://" + os.path.abspath(path) + ("#" + address if address else ""))
            self.do("wait document.readyState == 'complete' && document.body.dataset.ready")
        elif word == "size":
            self.call("Emulation.setDeviceMetricsOverride", width=int(words[0]), height=int(words[1]), mobile=False,
                      deviceScaleFactor=float(words[2]) if len(words) > 2 else 1)
        elif word == "dark":
            self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        elif word == "eval":
            print(json.dumps(self.evaluate(rest)))
        elif word == "wait":
            end = time.monotonic() + 60
            while not self.evaluate(rest):
                if time.monotonic() > end:
                    raise SystemExit("waited in vain for " + rest + "".join("\n" + c for c in self.complaints))
                time.sleep(0.05)
        elif word == "key":
            for kind in "keyDown", "keyUp":
                key = KEYS.get(rest, rest)
                self.call("Input.dispatchKeyEvent", type=kind, key=key, **({"text": key} if len(key) == 1 else {}))
        elif word == "move":
            self.mouse("mouseMoved", *words)
        elif word == "drag":
            self.mouse("mouseMoved", *words[:2])
            self.mouse("mousePressed", *words[:2], button="left", buttons=1, clickCount=1)
            self.mouse("mouseMoved", *words[2:], button="left", buttons=1)
            self.mouse("mouseReleased", *words[2:], button="left", clickCount=1)
        elif word == "wheel":
            self.mouse("mouseWheel", words[0], words[1], deltaX=0, deltaY=float(words[2]))
        elif word == "pinch":
            x, y, factor = map(float, words)
            for kind, far in ("touchStart", 40), ("touchMove", 40 * factor), ("touchEnd", None):
                points = [{"x": x - far, "y": y, "id": 1}, {"x": x + far, "y": y, "id": 2}] if far else []
                self.call("Input.dispatchTouchEvent", type=kind, touchPoints=points)
        elif word == "shot":
            self.settle()
            with open(rest, "wb") as out:
                out.write(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))
        else:
            raise SystemExit("no command " + word)
        if word not in ("size", "open", "eval", "wait"):
            self.settle()

    def close(self):
        self.process.kill()
        self.process.wait()
        time.sleep(0.1)
        shutil.rmtree(self.home, ignore_errors=True)


browser = Browser()
try:
    for argument in sys.argv[1:]:
        browser.do(argument)
    browser.evaluate("1")
    for complaint in browser.complaints:
        print("console: " + complaint, file=sys.stderr)
    sys.exit(1 if browser.complaints else 0)
finally:
    browser.close()
