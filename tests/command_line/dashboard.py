"""Tests that a server receives everything that ci/dashboard sends, including the numbers and images of a check. A small
server in this test takes the place of CDash."""

import gzip
import http.server
import os
import pathlib
import subprocess
import tempfile
import threading
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECK = """cat <<'END'
<CTestMeasurement type="numeric/double" name="pixels_over">16</CTestMeasurement>
<CTestMeasurementFile type="image/png" name="DifferenceImage">{image}</CTestMeasurementFile>
END
exit {code}
"""


class Dashboard(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())
        self.status = 200
        self.received = {}
        test = self

        class Server(http.server.BaseHTTPRequestHandler):
            def do_PUT(self):
                test.received[self.path] = self.rfile.read(int(self.headers["Content-Length"]))
                test.token = self.headers["Authorization"]
                self.send_response(test.status)
                self.end_headers()
                self.wfile.write(b"<cdash><status>OK</status></cdash>")

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Server)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        self.url = f"http://127.0.0.1:{server.server_address[1]}/submit.php?project=Triptych"

    def submit(self, code=0, label="image", **environment):
        image = pathlib.Path(self.folder, "difference.png")
        image.write_bytes(b"an image")
        pathlib.Path(self.folder, "check.sh").write_text(CHECK.format(image=image, code=code), encoding="utf-8")
        pathlib.Path(self.folder, "CTestTestfile.cmake").write_text(
            f"add_test(volume.quick.image.x sh {self.folder}/check.sh)\n"
            "set_tests_properties(volume.quick.image.x PROPERTIES LABELS image)\n", encoding="utf-8")
        return subprocess.run([ROOT / "ci/dashboard", "--build", self.folder, self.url, label], capture_output=True, text=True,
                              env={**os.environ, "TRIPTYCH_DATA": "", **environment})

    def sent(self):
        """Returns the tests that arrived, unpacked."""
        (name, body), = [each for each in self.received.items() if "Test.xml" in each[0]]
        self.assertIn("project=Triptych", name)
        return (gzip.decompress(body) if body[:2] == b"\x1f\x8b" else body).decode()

    def test_numbers_and_images_arrive(self):
        done = self.submit(CDASH_TOKEN="a-token")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        sent = self.sent()
        self.assertIn('<Test Status="passed">', sent)
        self.assertRegex(sent, r'name="pixels_over"[^>]*>\s*<Value>16</Value>')
        self.assertIn('name="DifferenceImage"', sent)
        self.assertEqual(self.token, "Bearer a-token")

    def test_a_failure_is_submitted_and_reported(self):
        done = self.submit(code=1)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn('<Test Status="failed">', self.sent())

    def test_a_rejected_submission_is_reported(self):
        self.status = 403
        done = self.submit()
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("could not be submitted to http://127.0.0.1", done.stderr)

    def test_wrong_usage_exits_with_code_3(self):
        for words, says in ((["--build"], "--build needs a value"), (["--track"], "--track needs a value"),
                            (["--build", "/no/such", "url"], "no tests in /no/such"), (["--nonsense"], "unknown option --nonsense")):
            done = subprocess.run([ROOT / "ci/dashboard", *words], capture_output=True, text=True)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(says, done.stderr)

    def test_a_run_without_tests_submits_nothing(self):
        done = self.submit(label="no-such-label")
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("no test was run", done.stderr)
        self.assertEqual(self.received, {})


if __name__ == "__main__":
    unittest.main()
