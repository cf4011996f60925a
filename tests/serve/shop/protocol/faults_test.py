"""`lamina serve` where clients, designs and the machine are at their worst.

usage: faults_test.py LAMINA [unittest's arguments]
"""

import collections
import concurrent.futures
import json
import os
import random
import shutil
import signal
import socket
import threading
import time

import service
from prometheus_client.parser import text_string_to_metric_families
from service import BOX, BUSY

ENDLESS = "n = 1;\ncube(1 + len([for (i = [0 : n], j = [0 : n], k = [0 : n]) if (i < 0) 0]));\n"


class FaultsTest(service.ServiceTest):
    designs = {"box.scad": BOX, "busy.scad": BUSY, "endless.scad": ENDLESS}

    def ask_at_once(self, running, lengths, source=lambda i: "127.0.0.1"):
        """The answers to orders of busy.scad, all sent at the same time."""
        with concurrent.futures.ThreadPoolExecutor(len(lengths)) as pool:
            return list(pool.map(
                lambda i: running.post("/designs/busy/quote",
                                       {"values": {"n": lengths[i]}, "layer": 1},
                                       source=source(i)), range(len(lengths))))

    def assert_right(self, answers, lengths):
        for answer, length in zip(answers, lengths, strict=True):
            if answer.status == 200:
                self.assertAlmostEqual(json.loads(answer.body)["volume"], length)
            else:
                self.assert_problem(answer, answer.status)
                self.assertGreater(int(answer.headers["Retry-After"]), 0)

    def test_refuses_what_one_client_has_too_much_of(self):
        running = self.serve("--workers", "1", "--queue", "8")
        lengths = [500 + i for i in range(8)]
        answers = self.ask_at_once(running, lengths)
        self.assert_right(answers, lengths)
        # One is run, two wait; where the first has ended, one more may.
        counts = collections.Counter(answer.status for answer in answers)
        self.assertEqual(set(counts), {200, 429})
        self.assertGreaterEqual(counts[200], 3)
        self.assertEqual(running.quote("box")["volume"], 24)

    def test_refuses_what_all_have_too_much_of(self):
        running = self.serve("--workers", "1", "--queue", "4")
        lengths = [500 + i for i in range(12)]
        answers = self.ask_at_once(running, lengths,
                                   lambda i: f"127.0.0.{2 + i}")
        self.assert_right(answers, lengths)
        counts = collections.Counter(answer.status for answer in answers)
        self.assertEqual(set(counts), {200, 503})
        self.assertGreaterEqual(counts[200], 5)
        self.assertEqual(running.get("/readyz").status, 200)

    def test_an_end_waits_for_all_that_was_taken(self):
        running = self.serve("--workers", "2", "--queue", "40")
        lengths = [200 + i for i in range(8)]
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            answers = pool.submit(self.ask_at_once, running, lengths)
            while len(running.runs()) < 2:
                time.sleep(0.01)
            time.sleep(0.1)  # until all are taken
            running.process.send_signal(signal.SIGTERM)
            self.assert_right(answers.result(), lengths)
        self.assertEqual({answer.status for answer in answers.result()}, {200})
        self.assertEqual(running.process.wait(timeout=30), 0)
        with self.assertRaises(OSError):
            running.get("/healthz")

    def test_a_second_signal_ends_it_at_once(self):
        running = self.serve()
        threading.Thread(target=self.ignore_end, args=(running, {"n": 9000})).start()
        running.wait_for_runs(1)
        running.process.send_signal(signal.SIGTERM)
        time.sleep(0.3)
        self.assertIsNone(running.process.poll())
        running.process.send_signal(signal.SIGTERM)
        self.assertNotEqual(running.process.wait(timeout=20), 0)

    def ignore_end(self, running, values):
        try:
            return running.post("/designs/endless/quote", {"values": values})
        except (OSError, EOFError, service.http.client.HTTPException):
            return None

    def test_an_order_that_takes_too_long_is_ended(self):
        running = self.serve("--max-time", "1")
        problem = self.assert_problem(
            running.post("/designs/endless/quote", {"values": {"n": 9000}}), 422)
        self.assertIn("time", json.dumps(problem))
        running.wait_for_runs(0)
        self.assertEqual(running.quote("endless")["volume"], 1)

    def test_a_client_that_goes_away_ends_its_order(self):
        running = self.serve()
        connection = running.connection()
        connection.request("POST", "/designs/endless/quote",
                           json.dumps({"values": {"n": 9000}}),
                           {"Content-Type": "application/json"})
        running.wait_for_runs(1)
        connection.close()
        running.wait_for_runs(0)

    def test_processes_that_are_killed_cost_their_orders_only(self):
        running = self.serve("--workers", "2", "--queue", "40")
        ended = threading.Event()
        killed = []
        thread = threading.Thread(target=self.kill_some, args=(
            running, ended, killed))
        thread.start()
        lengths = [5 + i for i in range(8)]
        statuses = collections.Counter()
        # As often as the machine needs to be hit often: how fast it is counts for
        # nothing.
        for count in range(3000):
            answers = self.ask_at_once(running, lengths)
            self.assert_right(answers, lengths)
            statuses.update(answer.status for answer in answers)
            if (count >= 30 and len(killed) > 20 and statuses[200] > 0
                    and statuses[503] > 0):
                break
        ended.set()
        thread.join()
        self.assertGreater(len(killed), 20)
        self.assertLessEqual(set(statuses), {200, 429, 503}, statuses)
        self.assertGreater(statuses[200], 0)
        self.assertGreater(statuses[503], 0)
        self.assertAlmostEqual(running.quote("busy", layer=1)["volume"], 1)

    def kill_some(self, running, ended, killed, seed=9):
        generator = random.Random(seed)
        while not ended.is_set():
            if found := running.processes():
                killed.append(generator.choice(found))
                try:
                    os.kill(killed[-1], signal.SIGKILL)
                except ProcessLookupError:
                    killed.pop()
            time.sleep(0.02)

    def test_clients_who_are_slow_wait_alone(self):
        running = self.serve()
        begun = []
        for text in (b"", b"GET /", b"POST /designs/box/quote HTTP/1.1\r\nHost: 127.0"
                     b".0.1\r\n", f"GET /designs/box/page HTTP/1.1\r\nHost: "
                     f"{running.address}\r\n\r\n".encode()) * 8:
            begun.append(socket.create_connection(("127.0.0.1", running.port)))
            begun[-1].sendall(text)
        for length in range(1, 21):
            self.assertAlmostEqual(running.quote("box", {"length": length})["volume"],
                                   6 * length)
        for connection in begun:
            connection.close()

    def test_a_full_disk_is_an_answer(self):
        """As root a disk of 16 kB for temporary files, otherwise files of 4 kB."""
        scratch = self.path("scratch")
        os.mkdir(scratch)
        command = (["unshare", "-m", "sh", "-c",
                    'mount -t tmpfs -o size=16k none "$TMPDIR" && exec "$@"', "sh"]
                   if os.getuid() == 0 else ["prlimit", "--fsize=4096"])
        self.assertIsNotNone(shutil.which(command[0]))
        running = self.serve(command=command, environment={"TMPDIR": scratch})
        for path in ("layers?format=slc", "layers?format=svg", "page", "picture.png",
                     "quote"):
            answer = running.post(f"/designs/busy/{path}",
                                  {"values": {"n": 100}, "layer": 0.01})
            self.assertIn(answer.status, (200, 500, 503), (path, answer.body[:500]))
            if answer.status != 200:
                self.assert_problem(answer, answer.status)
        self.assertEqual(running.quote("box")["volume"], 24)

    def test_counts_add_up(self):
        running = self.serve()
        for length in range(1, 11):
            running.quote("box", {"length": length})
        for _ in range(5):
            running.quote("box", {"length": 1})
        for _ in range(3):
            running.post("/designs/box/quote", {"values": {"length": 99}})
        running.get("/nowhere")
        families = list(text_string_to_metric_families(
            running.get("/metrics").body.decode()))
        for family in families:
            self.assertGreater(len(family.documentation), 0)
            self.assertNotEqual(family.type, "unknown", family.name)
        values = {(sample.name, *sorted(sample.labels.values())): sample.value
                       for family in families for sample in family.samples}
        for key, value in {
                ("lamina_requests_total", "200", "quote"): 15,
                ("lamina_requests_total", "422", "quote"): 3,
                ("lamina_cache_hits_total",): 5, ("lamina_orders_running",): 0,
                ("lamina_queue_length",): 0,
                ("lamina_order_seconds_count", "quote"): 10,
                ("lamina_order_seconds_bucket", "+Inf", "quote"): 10}.items():
            self.assertEqual(values.get(key), value, key)
        buckets = [value for key, value in values.items()
                   if key[0] == "lamina_order_seconds_bucket"]
        self.assertEqual(buckets, sorted(buckets))
        self.assertEqual(sum(value for key, value in values.items()
                             if key[0] == "lamina_requests_total" and "404" in key), 1)


if __name__ == "__main__":
    service.main()
