"""Firefox as Selenium drives it. Debian has no geckodriver, but Firefox itself speaks WebDriver BiDi (a W3C draft): this translates the
WebDriver commands that tests use, so that they are written once for all browsers."""
import base64
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time

import websocket
from selenium.webdriver.firefox.options import Options
from selenium.webdriver.remote.command import Command
from selenium.webdriver.remote.webdriver import WebDriver

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the key of an element in WebDriver's JSON
START = 60  # seconds, on a busy machine

# Firefox makes no requests of its own accord, and draws WebGL on the CPU if there is no graphics card.
PREFERENCES = {
    "app.normandy.enabled": False,
    "app.update.disabledForTesting": True,
    "browser.region.network.url": "",
    "browser.safebrowsing.update.enabled": False,
    "browser.shell.checkDefaultBrowser": False,
    "browser.startup.homepage_override.mstone": "ignore",
    "browser.startup.page": 0,
    "datareporting.policy.dataSubmissionEnabled": False,
    "dom.max_script_run_time": 0,
    "extensions.systemAddon.update.enabled": False,
    "network.captive-portal-service.enabled": False,
    "network.connectivity-service.enabled": False,
    "network.dns.disablePrefetch": True,
    "services.settings.server": "data:,#remote-settings-dummy/v1",
    "toolkit.telemetry.server": "",
    "webgl.disable-fail-if-major-performance-caveat": True,
    "webgl.force-enabled": True,
}

# Elements are passed as nodes, everything else as JSON.
CALL = """(json, ...nodes) => {
    const words = JSON.parse(json, (key, value) => (value && typeof value === "object" && "%s" in value ? nodes[value.node] : value));
    const call = function () { %s };
    const sent = (value) => (value instanceof Node ? value : JSON.stringify(value ?? null));
    return %s;
}"""
NOW = "sent(call.apply(null, words))"
LATER = "new Promise((done) => call.apply(null, [...words, (value) => done(sent(value))]))"


class Refused(Exception):
    def __init__(self, answer):
        super().__init__(answer["message"])
        self.answer = {"status": answer["error"], "value": {"error": answer["error"], "message": answer["message"]}}


class Bidi:
    """A connection: commands one after another, and the events in between."""

    def __init__(self, address):
        self.socket = websocket.create_connection(address, timeout=START, suppress_origin=True)
        self.number = 0
        self.events = []

    def call(self, method, timeout=START, **parameters):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        end = time.monotonic() + timeout
        while True:
            self.socket.settimeout(max(end - time.monotonic(), 0.01))
            try:
                message = json.loads(self.socket.recv())
            except websocket.WebSocketTimeoutException:
                raise Refused({"error": "script timeout", "message": f"{method}: no answer within {timeout} s"}) from None
            if message["type"] == "event":
                self.events.append(message)
            elif message["id"] == self.number:
                if message["type"] == "error":
                    raise Refused(message)
                return message["result"]


def started_display():
    """A virtual display: even without windows, Firefox has WebGL only with a display."""
    reading, writing = os.pipe()
    process = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-nolisten", "tcp", "-screen", "0", "1280x1024x24"], pass_fds=[writing],
                               stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writing)
    with open(reading) as pipe:
        number = pipe.readline().strip()
    assert number, "Xvfb does not start"
    return process, f":{number}"


class Executor:
    """Translates WebDriver's commands to BiDi."""

    def __init__(self, has_webgl):
        self.display, display = started_display()
        self.profile = pathlib.Path(tempfile.mkdtemp(prefix="candela-firefox-"))
        preferences = {**PREFERENCES, "webgl.disabled": not has_webgl}
        (self.profile / "user.js").write_text("".join(f"user_pref({json.dumps(k)}, {json.dumps(v)});\n" for k, v in preferences.items()))
        with open(self.profile / "log.txt", "w") as log:
            self.process = subprocess.Popen(
                ["firefox-esr", "--headless", "--no-remote", "--profile", self.profile, "--remote-debugging-port=0"],
                env=dict(os.environ, DISPLAY=display), stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)
        self.script_timeout = START
        self.bidi = Bidi(self.address() + "/session")

    def address(self):
        end = time.monotonic() + START
        while time.monotonic() < end and self.process.poll() is None:
            for line in (self.profile / "log.txt").read_text(errors="replace").splitlines():
                if line.startswith("WebDriver BiDi listening on "):
                    return line.split()[-1]
            time.sleep(0.02)
        raise AssertionError("Firefox does not start: " + (self.profile / "log.txt").read_text(errors="replace"))

    def execute(self, command, parameters):
        try:
            return {"value": COMMANDS[command](self, **{name: value for name, value in parameters.items() if name != "sessionId"})}
        except Refused as refusal:
            return refusal.answer

    def close(self):
        self.bidi.socket.close()

    def script(self, how, source, arguments, timeout=START):
        nodes = []

        def replaced(value):
            if isinstance(value, dict) and ELEMENT in value:
                nodes.append({"sharedId": value[ELEMENT]})
                return {ELEMENT: 0, "node": len(nodes) - 1}
            if isinstance(value, list):
                return [replaced(item) for item in value]
            return {k: replaced(v) for k, v in value.items()} if isinstance(value, dict) else value
        words = json.dumps(replaced(arguments))
        answer = self.bidi.call("script.callFunction", timeout, functionDeclaration=CALL % (ELEMENT, source, how), awaitPromise=True,
                                arguments=[{"type": "string", "value": words}, *nodes], target={"context": self.context}, userActivation=True)
        if answer["type"] == "exception":
            raise Refused({"error": "javascript error", "message": answer["exceptionDetails"]["text"]})
        result = answer["result"]
        return {ELEMENT: result["sharedId"]} if result["type"] == "node" else json.loads(result["value"])

    def actions(self, actions):
        for source in actions:
            for action in source["actions"]:
                if isinstance(action.get("origin"), dict):
                    action["origin"] = {"type": "element", "element": {"sharedId": action["origin"][ELEMENT]}}
        self.bidi.call("input.performActions", context=self.context, actions=actions)

    # The commands, with WebDriver's parameters.

    def new_session(self, **_):
        session = self.bidi.call("session.new", capabilities={})
        self.bidi.call("session.subscribe", events=["log.entryAdded"])
        self.context = self.bidi.call("browsingContext.getTree")["contexts"][0]["context"]
        return {"sessionId": session["sessionId"], "capabilities": session["capabilities"]}

    def quit(self):
        self.bidi.call("browser.close")
        try:
            self.process.wait(START)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.display.terminate()
        self.display.wait()
        shutil.rmtree(self.profile, ignore_errors=True)

    def get(self, url):
        self.bidi.call("browsingContext.navigate", context=self.context, url=url, wait="complete")

    def current_url(self):
        return self.script(NOW, "return location.href", [])

    def title(self):
        return self.script(NOW, "return document.title", [])

    def set_timeouts(self, **timeouts):
        self.script_timeout = timeouts.get("script", 1000 * self.script_timeout) / 1000

    def execute_now(self, script, args):
        return self.script(NOW, script, args)

    def execute_later(self, script, args):
        return self.script(LATER, script, args, self.script_timeout)

    def find_all(self, using, value):
        assert using == "css selector", using
        found = self.bidi.call("browsingContext.locateNodes", context=self.context, locator={"type": "css", "value": value})
        return [{ELEMENT: node["sharedId"]} for node in found["nodes"]]

    def find(self, using, value):
        found = self.find_all(using, value)
        if not found:
            raise Refused({"error": "no such element", "message": f"nothing is '{value}'"})
        return found[0]

    def text(self, id):
        return self.script(NOW, "return arguments[0].innerText", [{ELEMENT: id}])

    def scroll_to(self, id):
        self.script(NOW, "arguments[0].scrollIntoView({ block: 'nearest' })", [{ELEMENT: id}])

    def click(self, id):
        self.scroll_to(id)
        self.actions([{"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": [
            {"type": "pointerMove", "x": 0, "y": 0, "origin": {ELEMENT: id}}, {"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}]}])

    def send_keys(self, id, value, **_):
        self.script(NOW, "arguments[0].focus()", [{ELEMENT: id}])
        self.actions([{"type": "key", "id": "keyboard", "actions": [{"type": kind, "value": key} for key in value for kind in ("keyDown", "keyUp")]}])

    def element_screenshot(self, id):
        self.scroll_to(id)
        clip = {"type": "element", "element": {"sharedId": id}}
        return self.bidi.call("browsingContext.captureScreenshot", context=self.context, clip=clip)["data"]

    def screenshot(self):
        return self.bidi.call("browsingContext.captureScreenshot", context=self.context)["data"]

    def log(self, type):
        entries = [event["params"] for event in self.bidi.events if event["method"] == "log.entryAdded"]
        self.bidi.events = []
        return [{"level": {"error": "SEVERE"}.get(entry["level"], "INFO"), "message": entry["text"]} for entry in entries]

    def current_window(self):
        return self.context

    def new_window(self, type):
        return {"handle": self.bidi.call("browsingContext.create", type=type)["context"], "type": type}

    def switch_to_window(self, handle):
        self.context = handle
        self.bidi.call("browsingContext.activate", context=handle)

    def close_window(self):
        self.bidi.call("browsingContext.close", context=self.context)
        return []


COMMANDS = {
    Command.NEW_SESSION: Executor.new_session,
    Command.QUIT: Executor.quit,
    Command.GET: Executor.get,
    Command.GET_CURRENT_URL: Executor.current_url,
    Command.GET_TITLE: Executor.title,
    Command.GET_LOG: Executor.log,
    Command.SET_TIMEOUTS: Executor.set_timeouts,
    Command.W3C_EXECUTE_SCRIPT: Executor.execute_now,
    Command.W3C_EXECUTE_SCRIPT_ASYNC: Executor.execute_later,
    Command.W3C_ACTIONS: Executor.actions,
    Command.FIND_ELEMENT: Executor.find,
    Command.FIND_ELEMENTS: Executor.find_all,
    Command.GET_ELEMENT_TEXT: Executor.text,
    Command.CLICK_ELEMENT: Executor.click,
    Command.SEND_KEYS_TO_ELEMENT: Executor.send_keys,
    Command.SCREENSHOT: Executor.screenshot,
    Command.ELEMENT_SCREENSHOT: Executor.element_screenshot,
    Command.W3C_GET_CURRENT_WINDOW_HANDLE: Executor.current_window,
    Command.NEW_WINDOW: Executor.new_window,
    Command.SWITCH_TO_WINDOW: Executor.switch_to_window,
    Command.CLOSE: Executor.close_window,
}


class Firefox(WebDriver):
    def __init__(self, has_webgl=True):
        # (Without options, newer Selenium does not start a session; the executor supplies their content.)
        super().__init__(command_executor=Executor(has_webgl), options=Options())
        self.bidi = self.command_executor.bidi

    def resize(self, width, height):
        viewport = {"width": width, "height": height}
        self.bidi.call("browsingContext.setViewport", context=self.current_window_handle, viewport=viewport, devicePixelRatio=1)

    def run_before_pages(self, source):
        """Runs before the scripts of every page that is loaded from now on; returns a function that ends that."""
        script = self.bidi.call("script.addPreloadScript", functionDeclaration="() => { %s }" % source)["script"]
        return lambda: self.bidi.call("script.removePreloadScript", script=script)
