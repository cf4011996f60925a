"""examples/serve/nginx.conf: Debian's nginx before `lamina serve`.

usage: nginx_test.py LAMINA [unittest's arguments]
"""

import concurrent.futures
import http.client
import json
import os
import sys

import web_server
from web_server import service

sys.path.insert(0, os.path.join(service.TESTS, "browser"))
from browser import Picture  # noqa: E402


class NginxTest(service.ServiceTest):
    def setUp(self):
        super().setUp()
        os.chmod(self.folder, 0o755)
        self.socket = self.path("socket")
        self.running = self.serve("--metal", "sterling-silver", "--price", "1.10 EUR/g",
                                  listen=self.socket)
        os.chmod(self.socket, 0o666)  # the unit gives it to nginx's group
        folder = self.path("nginx")
        os.mkdir(folder)
        self.web = web_server.WebServer(folder, self.socket)
        self.addCleanup(self.web.close)

    def ask(self, method, path, body=None, port=None, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", port or self.web.port)
        connection.request(method, path, body, {
            "Host": "shop.example", "Origin": "https://shop.example",
            **{name.replace("_", "-"): text for name, text in headers.items()}})
        answer = connection.getresponse()
        body = answer.read()
        connection.close()
        return service.Answer(answer.status, answer.headers, body)

    def test_is_right_for_nginx(self):
        checked = self.web.check()
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertNotIn("[warn]", checked.stderr.replace(
            'the "user" directive', ""))

    def test_a_shop_has_its_page_quotes_and_pictures(self):
        self.web.start()
        page = self.ask("GET", "/")
        self.assertEqual(page.status, 200)
        self.assertIn(b'<script type="module" src="shop.js">', page.body)
        self.assertIn("default-src 'none'", page.headers["Content-Security-Policy"])
        self.assertEqual(self.ask("GET", "/shop.js").headers["Content-Type"].split(
            ";")[0].split("/")[1].removeprefix("x-"), "javascript")
        self.assertEqual(json.loads(self.ask("GET", "/api/designs").body), ["box"])
        schema = json.loads(self.ask("GET", "/api/designs/box/parameters").body)
        self.assertEqual(schema["properties"]["length"]["maximum"], 20)
        quote = self.ask("POST", "/api/designs/box/quote",
                         json.dumps({"values": {"length": 10}}),
                         Content_Type="application/json")
        self.assertEqual(quote.status, 200, quote)
        self.assertAlmostEqual(json.loads(quote.body)["volume"], 60)
        address = service.by_query("/api/designs/box/picture.png",
                                   {"values": {"length": 10}})
        picture = self.ask("GET", address)
        self.assertEqual(picture.status, 200, picture)
        Picture(picture.body)
        again = self.ask("GET", address, If_None_Match=picture.headers["ETag"])
        self.assertEqual((again.status, again.body), (304, b""))
        other = service.by_query("/api/designs/box/picture.png", {})
        self.assertNotEqual(self.ask("GET", other).headers["ETag"],
                            picture.headers["ETag"])

    def test_problems_come_through(self):
        self.web.start()
        answer = self.ask("POST", "/api/designs/box/quote",
                          json.dumps({"values": {"length": 99}}),
                          Content_Type="application/json")
        self.assert_problem(answer, 422)
        self.assert_problem(self.ask("GET", "/api/designs/none/parameters"), 404)

    def test_the_inner_side_is_not_public(self):
        self.web.start()
        for path in ("/metrics", "/healthz", "/readyz", "/api/metrics",
                     "/api/healthz", "/api/designs/../metrics",
                     "/api/designs/%2e%2e/metrics", "/api/designs/..%2fmetrics",
                     "/api//metrics", "/api/designs/box/../../metrics"):
            with self.subTest(path):
                answer = self.ask("GET", path)
                self.assertIn(answer.status, (400, 403, 404))
                self.assertNotIn(b"lamina_", answer.body)
        for path in ("/metrics", "/healthz", "/readyz"):
            self.assertEqual(self.ask("GET", path, port=self.web.inner_port).status,
                             200)
        self.assertEqual(self.ask("GET", "/designs",
                                  port=self.web.inner_port).status, 404)

    def test_floods_end_before_the_service(self):
        self.web.start()
        self.assertEqual(self.ask("POST", "/api/designs/box/quote", b" " * 70000,
                                  Content_Type="application/json").status, 413)
        def quote(i):
            return self.ask("POST", "/api/designs/box/quote",
                            json.dumps({"values": {"length": 1 + i % 20}}),
                            Content_Type="application/json")
        with concurrent.futures.ThreadPoolExecutor(10) as pool:
            statuses = [answer.status for answer in pool.map(quote, range(400))]
        self.assertEqual(set(statuses), {200, 429})

    def test_clients_are_told_apart_by_their_own_address(self):
        """A client's own X-Forwarded-For counts for nothing: the fence of one
        client in the service is the peer's, whatever it writes."""
        self.write("busy.scad", service.BUSY)
        self.running.close()
        os.remove(self.socket)
        self.running = self.serve("--workers", "1", "--queue", "8",
                                  listen=self.socket)
        os.chmod(self.socket, 0o666)
        self.web.start()

        def quote(i):
            return self.ask("POST", "/api/designs/busy/quote",
                            json.dumps({"values": {"n": 500 + i}, "layer": 1}),
                            Content_Type="application/json",
                            X_Forwarded_For=f"10.0.0.{i}")
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            answers = list(pool.map(quote, range(8)))
        self.assertEqual({answer.status for answer in answers}, {200, 429})


if __name__ == "__main__":
    service.main()
