"""examples/serve/Containerfile: its own words, run without a container.

usage: container_test.py LAMINA [unittest's arguments]

Nothing here builds an image: that needs an image of Debian from a registry.
"""

import json
import os
import re
import signal
import subprocess
import time

from web_server import SERVE, service


def instructions():
    """Pairs of an instruction and its words, continued lines joined."""
    with open(os.path.join(SERVE, "Containerfile"), encoding="utf-8") as file:
        text = re.sub(r"^#.*\n", "", file.read(), flags=re.MULTILINE)
    return [tuple(line.split(maxsplit=1))
            for line in text.replace("\\\n", " ").splitlines() if line]


class ContainerTest(service.ServiceTest):
    def words_of(self, name):
        found, = (words for each, words in instructions() if each == name)
        return found

    def test_has_known_instructions_only(self):
        self.assertEqual(instructions()[0][0], "FROM")
        self.assertLessEqual({name for name, _ in instructions()}, {
            "FROM", "COPY", "RUN", "USER", "WORKDIR", "VOLUME", "EXPOSE",
            "STOPSIGNAL", "HEALTHCHECK", "ENTRYPOINT"})
        for name, words in instructions():
            if name == "RUN":
                subprocess.run(["sh", "-n", "-c", words], check=True)

    def test_is_not_run_by_root(self):
        self.assertNotIn(self.words_of("USER"), ("root", "0"))

    def test_serves_is_healthy_and_ends(self):
        port = service.free_port()
        entry = json.loads(self.words_of("ENTRYPOINT"))
        self.assertEqual(entry[0], "lamina")
        self.assertEqual(self.words_of("EXPOSE"), "8280")
        words = [{"/designs": self.root, "0.0.0.0:8280": f"0.0.0.0:{port}"}.get(
            word, word) for word in entry[1:]]
        process = subprocess.Popen([self.lamina, *words, "--host", "localhost",
                                    "--host", "127.0.0.1"], text=True,
                                   stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        try:
            health = self.words_of("HEALTHCHECK").split(" CMD ")[1].replace(
                ":8280", f":{port}").split()
            deadline = time.monotonic() + 20
            while subprocess.run(health, check=False,
                                 stderr=subprocess.DEVNULL).returncode != 0:
                self.assertIsNone(process.poll())
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.1)
            process.send_signal(getattr(signal, self.words_of("STOPSIGNAL")))
            self.assertEqual(process.wait(timeout=40), 0)
        finally:
            process.kill()
            process.wait()


if __name__ == "__main__":
    service.main()
