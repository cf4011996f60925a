"""examples/serve/nginx.conf in nginx, run by anyone in a folder of its own."""

import os
import shutil
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "shop", "protocol"))
import service  # noqa: E402

SERVE = os.path.join(service.EXAMPLES, "serve")

# What Debian's own nginx.conf has around a site.
AROUND = """
daemon off;
worker_processes 1;
error_log {folder}/error.log;
pid {folder}/nginx.pid;
events {{ worker_connections 1024; }}
http {{
  include /etc/nginx/mime.types;
  access_log {folder}/access.log;
  client_body_temp_path {folder}/body;
  proxy_temp_path {folder}/proxy;
  fastcgi_temp_path {folder}/fastcgi;
  uwsgi_temp_path {folder}/uwsgi;
  scgi_temp_path {folder}/scgi;
  include {folder}/site.conf;
}}
"""


class WebServer:
    """`port` is the public's, `inner_port` this machine's."""

    def __init__(self, folder, socket):
        self.port, self.inner_port = service.free_port(), service.free_port()
        # The user of nginx may not see this checkout, such as one of root's.
        shop = os.path.join(folder, "shop")
        shutil.copytree(SERVE, shop)
        with open(os.path.join(SERVE, "nginx.conf"), encoding="utf-8") as file:
            text = file.read()
        for old, new in (("listen 80;", f"listen 127.0.0.1:{self.port};"),
                         ("127.0.0.1:9280;", f"127.0.0.1:{self.inner_port};"),
                         ("unix:/run/lamina/socket;", f"unix:{socket};"),
                         ("root /srv/shop;", f"root {shop};"),
                         ("/var/cache/nginx/lamina", f"{folder}/cache")):
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        self.configuration = os.path.join(folder, "nginx.conf")
        for name, content in (("site.conf", text),
                              ("nginx.conf", AROUND.format(folder=folder))):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(content)
        self.program = shutil.which("nginx", path="/usr/sbin:/usr/bin")
        self.words = [self.program, "-p", folder, "-e", f"{folder}/error.log",
                      "-c", self.configuration]
        if os.getuid() == 0:  # without rights even there
            subprocess.run(["chown", "-R", "www-data", folder], check=True)
            self.words = ["setpriv", "--reuid=www-data", "--regid=www-data",
                          "--clear-groups", "--no-new-privs", *self.words]
        self.process = None

    def check(self):
        """What `nginx -t` says."""
        return subprocess.run([*self.words, "-t"], text=True, check=False,
                              stderr=subprocess.PIPE)

    def start(self):
        self.process = subprocess.Popen(self.words)
        deadline = time.monotonic() + 20
        while True:
            try:
                service.socket.create_connection(("127.0.0.1", self.port)).close()
                return
            except ConnectionRefusedError:
                if self.process.poll() is not None or time.monotonic() > deadline:
                    raise
            time.sleep(0.02)

    def close(self):
        if self.process:
            self.process.terminate()
            self.process.wait()
