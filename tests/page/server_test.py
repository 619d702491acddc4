"""Tests `candela view` with requests that it must not answer, browsers that hold it up, many saves, and ending at any moment.

By hand: CANDELA=build/release/bin/candela python3 tests/page/server_test.py
"""
import json
import os
import pathlib
import random
import re
import signal
import socket
import subprocess
import time
import unittest

from served import COMMAND, ENVIRONMENT, LONGEST, OWN_KERNEL, View, children_of, status_of, tcp_sockets_of

CUBE = str(pathlib.Path(__file__).parents[2] / "docs/examples/cube.toml")
JUNK = int(os.environ.get("CANDELA_TEST_REQUESTS", "2000"))
# Sanitizers hold back freed memory, and record each thread's history.
MAY_GROW = 4096 if os.environ.get("CANDELA_TEST_SANITIZED", "") == "" else 256 * 1024  # kB


# Records the browser's arguments, and stays.
BROWSER = """#!/bin/sh
printf '%s\\n' "$@" > arguments.new
ls -l /proc/self/fd > descriptors
echo $$ > browser
mv arguments.new arguments
exec sleep 1000
"""


def commands_of(processes):
    found = []
    for process in processes:
        try:
            found.append(pathlib.Path(f"/proc/{process}/cmdline").read_bytes().split(b"\0"))
        except OSError:
            pass  # it has ended since
    return found


def until(connection, text):
    received = b""
    while text not in received:
        part = connection.recv(65536)
        assert part, f"the events end with {received[-200:]}"
        received += part
    return received


class ServerTest(unittest.TestCase):
    def setUp(self):
        self.view = View(self._testMethodName)
        self.addCleanup(self.check_end)

    def check_end(self):
        if self.view.process.poll() is None:
            self.assertEqual(self.view.end(), 0)
        self.assertEqual(self.view.left_behind(), [])

    def test_it_listens_on_this_machine_alone_and_asks_nobody(self):
        self.explained("pixel=1%2C2")
        with self.view.events() as connection:
            until(connection, b"event: problems")
            own = set()
            for process in (self.view.process.pid, *children_of(self.view.process.pid)):
                # A child may end, and a descriptor may be closed, while they are inspected.
                for descriptor in pathlib.Path("/proc").glob(f"{process}/fd/*"):
                    try:
                        own.update(re.findall(r"socket:\[(\d+)\]", os.readlink(descriptor)))
                    except FileNotFoundError:
                        pass
            listening, connected = [], []
            for table in ("tcp", "tcp6", "udp", "udp6"):
                for line in pathlib.Path(f"/proc/net/{table}").read_text().splitlines()[1:]:
                    fields = line.split()
                    if fields[9] in own:
                        (listening if fields[3] == "0A" else connected).append(fields[1])
        address = f"0100007F:{self.view.port:04X}"
        self.assertEqual(listening, [address])
        self.assertEqual(set(connected), {address})

    def test_only_who_knows_the_token_is_answered(self):
        token = self.view.token
        self.assertEqual(self.view.status(f"/{token}/"), 302)
        self.assertEqual(self.view.status(f"/{token}/?live={self.view.generation()}"), 200)
        for path in ("/", f"/{token[:-1]}/", f"/{token}x/", f"/{token.upper()}/" if token.upper() != token else "/x/", f"//{token}/", "/events",
                     f"/{'0' * 32}/events", f"/{token}", f"/?{token}/"):
            self.assertEqual(self.view.status(path), 404, path)

    def test_nothing_but_the_page_and_its_events_is_there(self):
        for path in ("../../etc/passwd", "%2e%2e/%2e%2e/etc/passwd", "..", "scene.toml", "events/", "//etc/passwd", "\\..\\x"):
            self.assertEqual(self.view.status(f"/{self.view.token}/{path}"), 404, path)
        for method in ("POST", "PUT", "DELETE", "HEAD", "OPTIONS"):
            self.assertEqual(self.view.status(f"/{self.view.token}/", method=method), 405, method)

    def test_requests_for_another_host_or_from_another_site_are_refused(self):
        path = f"/{self.view.token}/"
        for host in ("evil.example", f"evil.example:{self.view.port}", "127.0.0.1", "127.0.0.1:1", f"127.0.0.1:{self.view.port}.evil.example", ""):
            self.assertEqual(self.view.status(path, host=host), 403, host)
        for origin in ("http://evil.example", "null", f"https://127.0.0.1:{self.view.port}", f"http://127.0.0.1:{self.view.port}.evil.example",
                       "http://127.0.0.1:1"):
            self.assertEqual(self.view.status(path, Origin=origin), 403, origin)
        for own in (f"127.0.0.1:{self.view.port}", f"localhost:{self.view.port}"):
            self.assertEqual(self.view.status(path, host=own, Origin=f"http://{own}"), 302, own)

    def save(self, query, **fields):
        fields = {"Origin": f"http://127.0.0.1:{self.view.port}", **fields}
        return self.view.get(f"/{self.view.token}/save?{query}", method="POST", **{k: v for k, v in fields.items() if v})

    def test_changes_are_written_into_the_scenes_file_and_nowhere_else_in_it(self):
        before = self.view.file.read_text()
        answer = self.save("set=object.0.color%3D%5B7%2C8%2C9%5D")
        self.assertIn(b" 200 ", answer.split(b"\r\n")[0])
        self.assertEqual(self.view.file.read_text(), before.replace("[100, 90, 40]", "[7, 8, 9]"))
        self.assertIn(b" 200 ", self.save("shading=flat").split(b"\r\n")[0])
        self.assertIn('shading = {model = "flat"}', self.view.file.read_text())
        # A save from the page is followed like any other.
        end = time.monotonic() + LONGEST
        while b'"color":[7.0,8.0,9.0]' not in self.view.page():
            self.assertLess(time.monotonic(), end)

    def test_what_would_make_the_scene_wrong_is_not_saved_and_said(self):
        before = self.view.file.read_text()
        for query, reason in (("set=object.0.color%3D%5B700%2C8%2C9%5D", b"outside its range"), ("set=object.3.color%3D%5B1%2C2%2C3%5D", b"there is no object 3"),
                              ("", b"nothing to change"), ("reflection=lambrt", b"lambert")):
            answer = self.save(query)
            self.assertIn(b" 422 ", answer.split(b"\r\n")[0], query)
            self.assertIn(reason, answer)
        for query in ("file=x", "set", "set=%0", "output=%2Fetc%2Fpasswd"):
            self.assertIn(b" 400 ", self.save(query).split(b"\r\n")[0], query)
        self.assertEqual(self.view.file.read_text(), before)

    def test_only_this_page_saves(self):
        before = self.view.file.read_text()
        query = "set=object.0.color%3D%5B7%2C8%2C9%5D"
        for origin in ("", "null", "http://evil.example", f"https://127.0.0.1:{self.view.port}"):
            self.assertIn(b" 403 ", self.save(query, Origin=origin).split(b"\r\n")[0], origin)
        own = f"http://127.0.0.1:{self.view.port}"
        for method in ("GET", "PUT", "HEAD", "OPTIONS"):
            self.assertEqual(self.view.status(f"/{self.view.token}/save?{query}", method=method, Origin=own), 405)
        self.assertEqual(self.view.status(f"/{'0' * 32}/save?{query}", method="POST", Origin=own), 404)
        self.assertEqual(self.view.file.read_text(), before)

    def keep(self, query, body=b"KERNEL", **fields):
        fields = {"Origin": f"http://127.0.0.1:{self.view.port}", **fields}
        answer = self.view.get(f"/{self.view.token}/keep?{query}", method="POST", body=body, **{k: v for k, v in fields.items() if v})
        return int(answer.split(b" ", 2)[1]), answer

    def folders(self):
        return sorted(each.name for each in self.view.folder.iterdir() if each.is_dir())

    def test_a_formula_is_kept_in_a_new_folder_and_nowhere_else(self):
        status, answer = self.keep("model=reflection%2Fphong&name=cel", b"// mine\nstruct PhongMaterial { vec3 ka; };\nKERNEL vec3 phong_reflect_ambient(PhongMaterial m, Surface s) { return m.ka; }\n")
        self.assertEqual(status, 200, answer)
        self.assertEqual(self.folders(), ["cel", "tmp"])
        self.assertEqual(self.view.folder.joinpath("cel/cel.kernel").read_text(), "/// # Cel\n/// Based on Phong: one sentence about it.\n///\n// mine\nstruct CelMaterial { vec3 ka; };\nKERNEL vec3 cel_reflect_ambient(CelMaterial m, Surface s) { return m.ka; }\n")
        before = {each: each.read_bytes() for each in self.view.folder.joinpath("cel").iterdir()}
        self.view.folder.joinpath("link").symlink_to("/nonexistent")
        for name, reason in (("cel", b"already exists"), ("link", b"already exists"), ("tmp", b"already exists"), ("..%2Fx", b"is not a valid plugin name"),
                             ("%2Ftmp%2Fx", b"is not a valid plugin name"), ("", b"is not a valid plugin name"), ("-x", b"is not a valid plugin name"), ("A", b"is not a valid plugin name")):
            status, answer = self.keep(f"model=phong&name={name}")
            self.assertEqual(status, 422, name)
            self.assertIn(reason, answer, name)
        for kernel, reason in ((b"KERNEL float f(float x) { float *p = x; return x; }", b"kept.kernel:1:33: the kernel language has neither pointers"),
                               (b"#include </etc/passwd>", b"kept.kernel:1:1: the kernel language has no preprocessor"),
                               (b"// \\\nKERNEL", b"must not end with")):
            status, answer = self.keep("model=phong&name=other", kernel)
            self.assertEqual(status, 422, kernel)
            self.assertIn(reason, answer, kernel)
        for model in ("phnog", "light%2Fpoint", "--help", "..%2F..%2Fx"):
            self.assertEqual(self.keep(f"model={model}&name=other")[0], 422, model)
        self.assertEqual(self.folders(), ["cel", "tmp"])
        self.assertEqual(before, {each: each.read_bytes() for each in self.view.folder.joinpath("cel").iterdir()})

    def test_only_this_page_keeps_and_no_more_than_a_formula(self):
        query = "model=phong&name=cel"
        for origin in ("", "null", "http://evil.example", f"https://127.0.0.1:{self.view.port}"):
            self.assertEqual(self.keep(query, Origin=origin)[0], 403, origin)
        self.assertEqual(self.view.status(f"/{self.view.token}/keep?{query}"), 405)
        self.assertEqual(self.view.status(f"/{'0' * 32}/keep?{query}", method="POST"), 404)
        for wrong in ("", "model=phong", "name=cel", f"{query}&name=x", f"{query}&set=a%3D1", f"{query}&kernel=%2Fetc%2Fpasswd", f"{query}&pixel=1%2C1"):
            self.assertEqual(self.keep(wrong)[0], 400, wrong)
        self.assertEqual(self.view.get(f"/{self.view.token}/keep?{query}", method="POST", body=b"x" * 70000, Origin=f"http://127.0.0.1:{self.view.port}"), b"")
        # Other requests have no body.
        self.assertEqual(self.view.status(f"/{self.view.token}/", body=b"x"), 400)
        self.assertEqual(self.folders(), ["tmp"])

    def test_the_page_is_not_for_frames_caches_and_other_sites(self):
        head = self.view.page().split(b"\r\n\r\n")[0]
        for field in (b"X-Frame-Options: DENY", b"Cache-Control: no-store", b"Referrer-Policy: no-referrer", b"X-Content-Type-Options: nosniff",
                      b"Cross-Origin-Resource-Policy: same-origin"):
            self.assertIn(field, head)

    def test_junk_is_survived(self):
        chance, before = random.Random(17), status_of(self.view.process.pid)[0]
        good = f"GET /{self.view.token}/ HTTP/1.1\r\nHost: 127.0.0.1:{self.view.port}\r\n\r\n".encode()
        for _ in range(JUNK):
            data = bytearray(good if chance.random() < 0.7 else chance.randbytes(chance.randrange(1, 300)))
            for _ in range(chance.randrange(1, 9)):
                data[chance.randrange(len(data))] = chance.randrange(256)
            with self.view.connect() as connection:
                try:
                    connection.sendall(bytes(data))
                    connection.shutdown(socket.SHUT_WR)
                except OSError:
                    continue
        self.assertEqual(self.view.status(f"/{self.view.token}/"), 302)
        self.assertLess(status_of(self.view.process.pid)[0] - before, MAY_GROW)
        # Refusals are logged, but not enough to fill a disk.
        for _ in range(30):
            self.assertEqual(self.view.status("/nothing"), 404)
        log = (self.view.folder / "log.txt").read_text()
        self.assertIn("404", log)
        self.assertLess(len(log.splitlines()), 60)

    def test_the_renderers_picture_is_had_with_changes(self):
        path = f"/{self.view.token}/reference.png"
        plain = self.view.get(path)
        self.assertIn(b"Content-Type: image/png", plain)
        picture = plain.split(b"\r\n\r\n", 1)[1]
        expected = self.view.folder / "expected.png"
        subprocess.run([COMMAND, "render", "--quiet", self.view.file, "-o", expected], env=ENVIRONMENT, check=True)
        self.assertEqual(picture, expected.read_bytes())
        changed = self.view.get(f"{path}?set=object.0.color%3D%5B9,200,9%5D&shading=flat").split(b"\r\n\r\n", 1)[1]
        subprocess.run([COMMAND, "render", "--quiet", self.view.file, "-o", expected, "--set", "object.0.color=[9,200,9]", "--shading", "flat"],
                       env=ENVIRONMENT, check=True)
        self.assertEqual(changed, expected.read_bytes())
        wrong = self.view.get(f"{path}?set=object.0.colour%3D3")
        self.assertIn(b" 422 ", wrong[:20])
        self.assertIn(b"colour", wrong)

    def test_options_of_the_command_hold_for_the_picture_too(self):
        done = subprocess.Popen([COMMAND, "view", "--no-open", "--quiet", "--models", "all", "--port=0", "--set", "object.0.color=[1,2,3]",
                                 self.view.file], env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
        port, token = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/", done.stdout.readline().strip()).groups()
        with socket.create_connection(("127.0.0.1", int(port)), timeout=LONGEST) as connection:
            connection.sendall(f"GET /{token}/reference.png HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
            parts = []
            while part := connection.recv(65536):
                parts.append(part)
        done.send_signal(signal.SIGINT)
        self.assertEqual(done.wait(LONGEST), 0)
        done.stdout.close()
        expected = self.view.folder / "expected.png"
        subprocess.run([COMMAND, "render", "--quiet", self.view.file, "-o", expected, "--set", "object.0.color=[1,2,3]"], env=ENVIRONMENT, check=True)
        self.assertEqual(b"".join(parts).split(b"\r\n\r\n", 1)[1], expected.read_bytes())

    def explained(self, query):
        return self.view.get(f"/{self.view.token}/explanation.json?{query}").split(b"\r\n\r\n", 1)[1]

    def test_a_pixel_is_explained_with_changes(self):
        for options in ([], ["--set", "object.0.color=[9,200,9]", "--shading", "flat"]):
            picture = self.view.folder / "expected.ppm"
            subprocess.run([COMMAND, "render", "--quiet", self.view.file, "-o", picture, *options], env=ENVIRONMENT, check=True)
            at = 3 * (24 * 64 + 32)
            query = "pixel=32%2C24" + ("&set=object.0.color%3D%5B9,200,9%5D&shading=flat" if options else "")
            explanation = json.loads(self.explained(query))
            self.assertEqual(bytes(explanation["bytes"]), picture.read_bytes()[-3 * 64 * 48:][at:at + 3])
            self.assertEqual(explanation["pixel"], [32, 24])

    def pixel_of_picture(self):
        picture = self.view.folder / "expected.ppm"
        subprocess.run([COMMAND, "render", "--quiet", self.view.file, "-o", picture], env=ENVIRONMENT, check=True)
        at = 3 * (24 * 64 + 32)
        return list(picture.read_bytes()[-3 * 64 * 48:][at:at + 3])

    def test_what_is_shown_is_explained_after_each_save_and_while_the_file_is_broken(self):
        bytes_said = lambda: json.loads(self.explained("pixel=32%2C24"))["bytes"]
        for red in (10, 250):
            self.view.save(red)
            self.view.wait_for_color(red)
            self.assertEqual(bytes_said(), self.pixel_of_picture())
        expected = self.pixel_of_picture()
        with self.view.events() as connection:
            self.view.save("oops")
            until(connection, b"oops")
        self.assertEqual(bytes_said(), expected)
        self.view.save(30)
        self.view.wait_for_color(30)
        self.assertEqual(bytes_said(), self.pixel_of_picture())

    def test_what_explains_is_replaced_if_it_is_killed(self):
        self.view.wait_for_color(100)
        self.explained("pixel=1%2C2")
        for child in children_of(self.view.process.pid):
            os.kill(int(child), signal.SIGKILL)
        self.assertEqual(json.loads(self.explained("pixel=1%2C2"))["pixel"], [1, 2])

    def test_what_is_no_pixel_is_not_explained(self):
        for query in ("", "pixel=1,2&pixel=3,4", "pixel", "set=image.width%3D9"):
            self.assertEqual(self.view.status(f"/{self.view.token}/explanation.json?{query}"), 400, query)
        for query in ("pixel=64%2C0", "pixel=-1%2C0", "pixel=x", "pixel=", "pixel=1%2C2&set=object.0.colour%3D3", "pixel=--help",
                      "pixel=1%2C2%0A3%2C4", "pixel=%0A"):
            self.assertEqual(self.view.status(f"/{self.view.token}/explanation.json?{query}"), 422, query)
        self.assertIn(b"0,0 to 63,47", self.explained("pixel=64%2C0"))
        self.assertEqual(json.loads(self.explained("pixel=5%2C6"))["pixel"], [5, 6])
        self.assertEqual(self.view.status(f"/{self.view.token}/reference.png?pixel=1%2C2"), 400)
        self.assertEqual(self.view.status(f"/{self.view.token}/explanation.json?pixel=1%2C2", method="POST"), 405)

    def test_a_term_stands_in_for_the_picture(self):
        path = f"/{self.view.token}/reference.png"
        picture = self.view.get(f"{path}?set=object.0.color%3D%5B9,200,9%5D&terms=diffuse").split(b"\r\n\r\n", 1)[1]
        expected = self.view.folder / "expected.png"
        subprocess.run([COMMAND, "render", "--quiet", self.view.file, "-o", expected, "--set", "object.0.color=[9,200,9]", "--terms", "diffuse"],
                       env=ENVIRONMENT, check=True)
        self.assertEqual(picture, expected.with_suffix(".diffuse.png").read_bytes())
        for query, status in (("terms=diffuse&terms=normal", 400), ("terms", 400), ("terms=difuse", 422), ("terms=..%2Fx", 422), ("terms=", 422)):
            self.assertEqual(self.view.status(f"{path}?{query}"), status, query)
        self.assertEqual(self.view.status(f"/{self.view.token}/explanation.json?pixel=1%2C2&terms=diffuse"), 400)

    def test_options_that_change_no_picture_are_refused(self):
        for query in ("output=/tmp/x", "plugin-dir=/tmp", "set", "set=%", "set=%zz", "set=%00", "=", "set=a&-o=b", "&"):
            self.assertEqual(self.view.status(f"/{self.view.token}/reference.png?{query}"), 400, query)

    def body(self, path):
        return self.view.get(path).split(b"\r\n\r\n", 1)[1].decode()

    def test_parts_of_the_page_are_served_alone(self):
        self.view.wait_for_color(100)
        page = self.view.page().decode()
        scene = re.search(r'id="scene">(.*?)</script>', page, re.S)[1]
        arrays = dict(re.findall(r'id="(array-[^"]+)">([^<]*)</script>', page))
        self.assertEqual(set(json.loads(scene)["arrays"]), set(arrays))
        names = sorted(arrays)
        path = f"/{self.view.token}/?live={self.view.generation()}"
        self.assertEqual(self.body(f"{path}&part=scene"), scene + "\n")
        self.assertEqual(self.body("&".join([path, *(f"part={name}" for name in names)])), "".join(arrays[name] + "\n" for name in names))
        for part in ("", "nothing", "scen", "array-", "..%2Fscene", "scene&part=nothing"):
            self.assertEqual(self.view.status(f"{path}&part={part}"), 404, part)

    def test_parts_of_an_older_page_are_those_of_the_newest(self):
        self.view.wait_for_color(100)
        before, array = self.view.generation(), re.search(r'"arrays":\["([^"]+)"', self.view.page().decode())[1]
        self.view.save(77)
        self.view.wait_for_color(77)
        answer = self.view.get(f"/{self.view.token}/?live={before}&part=scene&part={array}").decode()
        self.assertIn(f"Location: /{self.view.token}/?live={self.view.generation()}&part=scene&part={array}\r\n", answer)
        # A colour does not change an array.
        self.assertIn(array, self.body(f"/{self.view.token}/?live={self.view.generation()}&part=scene"))

    def test_large_requests_are_cut_off(self):
        for head in (b"GET / HTTP/1.1\r\nX: ", f"GET /{self.view.token}/".encode(), b"POST / HTTP/1.1\r\nContent-Length: 1000000000\r\n\r\n"):
            sent = 0
            with self.view.connect() as connection:
                try:
                    connection.sendall(head)
                    while sent < 1 << 30:
                        sent += connection.send(b"x" * 65536)
                except OSError:
                    pass
            self.assertLess(sent, 32 << 20, head)
        self.assertEqual(self.view.status(f"/{self.view.token}/"), 302)

    def test_half_open_connections_do_not_keep_others_out(self):
        idle = [self.view.connect() for _ in range(200)]
        self.assertEqual(self.view.status(f"/{self.view.token}/"), 302)
        for connection in idle:
            connection.close()

    def test_a_browser_that_reads_nothing_holds_up_nobody(self):
        with self.view.events() as slow, self.view.events() as quick:
            slow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1024)
            until(quick, b"event: problems")
            for i in range(10):
                before = self.view.generation()
                self.view.save(i)
                until(quick, f"event: scene\ndata: {before + 1}\n".encode())
            self.view.wait_for_color(9)

    def test_of_many_saves_half_of_them_broken_the_last_is_shown(self):
        self.view.wait_for_color(100)
        for i in range(100):
            self.view.save("oops" if i % 2 == 0 else i)
            time.sleep(0.01)
        self.view.save(200)
        self.view.wait_for_color(200)
        with self.view.events() as connection:
            self.assertIn(b'data: ""', until(connection, b"event: problems\ndata: \"\"\n"))

    def test_a_kernel_file_that_was_wrong_from_the_start_is_followed(self):
        folder = self.view.folder / "kernels"  # the scene's own folder is watched while the scene is wrong
        folder.mkdir()
        kernel = folder / "lambert.kernel"
        right = pathlib.Path(__file__).parents[2].joinpath("plugins/reflection/lambert.kernel").read_text()
        kernel.write_text(right.replace("KERNEL Reflected", "KERNEL Reflecting"))
        view = View("follows-a-kernel", options=["--reflection", str(kernel)])
        with view.events() as connection:
            until(connection, b"Reflecting")
        kernel.write_text(right)
        view.wait_for_color(100)
        self.assertEqual(view.end(), 0)

    def started(self, name, **options):
        view = View(f"{self._testMethodName}-{name}", **options)
        self.addCleanup(lambda: self.assertEqual(view.end(), 0))
        return view

    def test_a_kernel_file_that_a_scene_names_is_followed_though_it_was_wrong_or_missing(self):
        scene = View.text(100).replace('"lambert"', '"kernels/own.kernel"')
        wrong = OWN_KERNEL.replace("KERNEL Reflected", "KERNEL Reflecting")
        for name, files, problem in (("wrong", {"scene.toml": scene, "kernels/own.kernel": wrong}, b"Reflecting"),
                                     ("missing", {"scene.toml": scene, "kernels/other": ""}, b"does not exist")):
            view = self.started(name, files=files)
            with view.events() as connection:
                until(connection, problem)
            view.folder.joinpath("kernels/own.kernel").write_text(OWN_KERNEL)
            view.wait_for_color(100)
        view = self.started("later", files={"kernels/own.kernel": wrong})
        view.wait_for_color(100)
        with view.events() as connection:
            view.replace(scene.replace("100", "150"))
            until(connection, b"Reflecting")
        view.folder.joinpath("kernels/own.kernel").write_text(OWN_KERNEL)
        view.wait_for_color(150)

    def test_a_kernel_file_is_called_by_its_path_in_the_page_and_its_requests(self):
        scene = View.text(100).replace('"lambert"', '"own.kernel"')
        view = self.started("named", files={"scene.toml": scene, "own.kernel": OWN_KERNEL})
        view.wait_for_color(100)
        self.assertIn(b'"id":"own.kernel"', view.page())
        self.assertIn(b'"id":"reflection/phong"', view.page())
        own = {"Origin": f"http://127.0.0.1:{view.port}"}
        answer = view.get(f"/{view.token}/keep?model=own.kernel&name=mine", method="POST", body=OWN_KERNEL.encode(), **own)
        self.assertIn(b" 200 ", answer.split(b"\r\n")[0], answer)
        shown = view.get(f"/{view.token}/reference.png?reflection=own.kernel")
        self.assertEqual(shown, view.get(f"/{view.token}/reference.png?"))
        self.assertIn(b" 200 ", shown.split(b"\r\n")[0], shown)
        self.assertIn(b" 200 ", view.get(f"/{view.token}/save?reflection=phong", method="POST", **own).split(b"\r\n")[0])
        self.assertIn(b" 200 ", view.get(f"/{view.token}/save?reflection=own.kernel", method="POST", **own).split(b"\r\n")[0])
        self.assertEqual(view.file.read_text(), scene)

    def test_a_model_chosen_in_the_page_replaces_that_of_the_command(self):
        for option in (["--reflection", "phong", "--shading=flat"], ["--reflection=phong", "--shading", "flat"]):
            view = self.started(option[0].strip("-"), options=option)
            view.wait_for_color(100)
            shown = view.get(f"/{view.token}/reference.png?reflection=half-lambert&shading=gouraud").split(b"\r\n\r\n", 1)[1]
            expected = view.folder / "expected.png"
            subprocess.run([COMMAND, "render", "--quiet", view.file, "-o", expected, "--reflection", "half-lambert", "--shading", "gouraud"],
                           env=ENVIRONMENT, check=True)
            self.assertEqual(shown, expected.read_bytes())
            explained = json.loads(view.get(f"/{view.token}/explanation.json?pixel=32%2C24&reflection=half-lambert").split(b"\r\n\r\n", 1)[1])
            self.assertIn("half-lambert", json.dumps(explained))

    def test_programs_that_it_starts_have_none_of_its_sockets(self):
        # Open while the processes start.
        idle = [self.view.connect() for _ in range(20)]
        self.view.wait_for_color(100)
        self.explained("pixel=1%2C2")
        self.view.save(50)
        self.view.wait_for_color(50)
        self.explained("pixel=1%2C2")
        children = children_of(self.view.process.pid)
        self.assertTrue(children)
        self.assertGreaterEqual(len(tcp_sockets_of(self.view.process.pid)), 1)
        for child in children:
            self.assertEqual(tcp_sockets_of(child), {}, child)
        # So that their openers notice their end.
        for connection in idle:
            self.assertEqual(connection.recv(1), b"")
            connection.close()

    def test_the_renderers_picture_is_given_up_when_nobody_waits_for_it(self):
        # This would take many minutes.
        huge = "set=image.width%3D60000&set=image.height%3D60000&set=image.samples%3D16"
        is_rendering = lambda: any(b"render" in command for command in commands_of(children_of(self.view.process.pid)))
        waiting = [self.view.connect() for _ in range(2)]
        for connection in waiting:  # the second one does not even start
            connection.sendall(f"GET /{self.view.token}/reference.png?{huge} HTTP/1.1\r\nHost: 127.0.0.1:{self.view.port}\r\n\r\n".encode())
        end = time.monotonic() + LONGEST
        while not is_rendering():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)
        for connection in waiting:
            connection.close()
        # They do not hold up this one.
        self.assertIn(b"Content-Type: image/png", self.view.get(f"/{self.view.token}/reference.png"))
        self.assertFalse(is_rendering())


class Opening(unittest.TestCase):
    def setUp(self):
        self.view = View(self._testMethodName, BROWSER)
        self.addCleanup(lambda: self.view.process.poll() is None and self.view.end())
        end = time.monotonic() + LONGEST
        while not (self.view.folder / "arguments").exists():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)
        browser = int((self.view.folder / "browser").read_text())
        self.addCleanup(os.kill, browser, signal.SIGKILL)

    def test_the_browser_is_led_to_the_address_by_a_file_that_only_its_user_reads(self):
        arguments = (self.view.folder / "arguments").read_text()
        self.assertNotIn(self.view.token, arguments)
        page = pathlib.Path(arguments.strip())
        self.assertEqual(page.stat().st_mode & 0o777, 0o600)
        self.assertIn(f'http-equiv="refresh" content="0; url={self.view.address}"', page.read_text())
        for command in commands_of([self.view.process.pid, *children_of(self.view.process.pid)]):
            self.assertNotIn(self.view.token.encode(), b" ".join(command))
        self.assertEqual(self.view.end(), 0)
        self.assertEqual(self.view.left_behind(), [])

    def test_the_browser_has_nothing_open_but_its_streams_and_the_port_is_free_again_while_it_runs(self):
        descriptors = re.findall(r"(\d+) -> (\S+)", (self.view.folder / "descriptors").read_text())
        # The descriptor of `ls` itself, for the folder that it reads.
        self.assertEqual([target for number, target in descriptors if int(number) > 2 and not target.startswith("/proc/")], [], descriptors)
        self.assertEqual(self.view.end(), 0)
        with self.assertRaises(ConnectionRefusedError):
            self.view.connect()


class Ending(unittest.TestCase):
    def test_it_ends_well_at_any_moment(self):
        chance = random.Random(3)
        for i in range(12):
            view = View(self._testMethodName)
            number = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)[i % 3]
            if i % 2:
                view.save(i)
            time.sleep(chance.random() * 0.08)
            self.assertEqual(view.end(number), 0)
            self.assertEqual(view.left_behind(), [])

    def test_asked_to_end_again_while_it_ends_it_leaves_nothing_behind_either(self):
        chance = random.Random(5)
        for i in range(24):
            view = View(self._testMethodName)
            view.save(i)
            time.sleep(chance.random() * 0.02)
            view.process.send_signal(signal.SIGTERM)
            time.sleep(chance.random() * 0.02)
            self.assertIn(view.end(), (0, -signal.SIGINT))
            self.assertEqual(view.left_behind(), [])

    def test_a_port_that_is_taken_is_an_error(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            done = subprocess.run([COMMAND, "view", "--no-open", "--port", str(port)], env=ENVIRONMENT, capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL, timeout=LONGEST)
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"cannot listen on port {port} of 127.0.0.1", done.stderr)

    def test_what_cannot_be_followed_is_refused(self):
        for arguments, words in ((["-"], "is not a file"), (["nowhere.toml"], "is not a file"), (["--port", "70000"], "--port is 70000"),
                                 (["--target", "cpp2"], "unknown target 'cpp2'"),
                                 ([CUBE, "--plain"], "--plain applies to a model given instead of a scene"),
                                 ([CUBE, "--shadows", "--no-shadows"], "contradict each other"), ([CUBE, "--set", "image.width"], "has no '='")):
            done = subprocess.run([COMMAND, "view", "--no-open", *arguments], env=ENVIRONMENT, capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL, timeout=LONGEST)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
