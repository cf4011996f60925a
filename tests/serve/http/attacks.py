"""What strangers may send to a server on this machine, and what it answers.

usage: attacks.py --port PORT --pid PID [--path /] [--post /change]
                  [--stream /events] [--cookie NAME=VALUE] [--memory MB]
                  [--programs]

Prints a table, and ends with 1 if an answer is not as expected, if the server
answers no more after an attack, or if its memory has passed the bound. "closed"
is the end of a connection without an answer. Where an attack reaches the
handler, which may answer as it likes, a range of statuses is expected.
"""

import argparse
import collections
import concurrent.futures
import random
import re
import socket
import struct
import sys
import time

CLOSED = "closed"
MEGABYTE = 1 << 20
FLOOD = 64 * MEGABYTE

# Where the server is; a path that can be got, one for posts, and one that
# streams, if any; a cookie to send; the most memory that it may take [MB];
# whether it serves programs, not browsers.
Server = collections.namedtuple(
    "Server", "port pid path post stream cookie memory programs",
    defaults=("/", "/", None, None, 40, False))

Row = collections.namedtuple("Row", "name expected got seconds peak is_alive")


def is_well(row, server):
    return (bool(row.expected & row.got) and row.got <= row.expected
            and row.is_alive and row.peak < server.memory)


# --- One connection ----------------------------------------------------------

def connect(server):
    return socket.create_connection(("127.0.0.1", server.port), timeout=12)


def send(connection, data):
    """Whether all could be sent."""
    try:
        connection.sendall(data)
        return True
    except OSError:
        return False


def receive(connection, most=MEGABYTE):
    """What comes until the end."""
    data = b""
    try:
        while len(data) < most:
            part = connection.recv(65536)
            if not part:
                break
            data += part
    except OSError:
        pass
    return data


def statuses_of(data):
    """The statuses of all answers in the bytes, one after the other."""
    statuses = []
    while data:
        head, _, data = data.partition(b"\r\n\r\n")
        status = re.match(rb"HTTP/1\.1 ([1-5][0-9][0-9]) ", head)
        if not status:
            return statuses + ["garbage"]
        statuses.append(int(status[1]))
        length = re.search(rb"\r\nContent-Length: (\d+)", head)
        data = data[int(length[1]):] if length else b""
    return statuses or [CLOSED]


def ask(server, data):
    """The statuses that the bytes get, all of which are sent at once."""
    with connect(server) as connection:
        send(connection, data)
        try:
            connection.shutdown(socket.SHUT_WR)
        except OSError:
            pass
        return statuses_of(receive(connection))


def head(server, line=None, host=None, lines=()):
    """A request's head that is right but for what is given."""
    host = f"127.0.0.1:{server.port}" if host is None else host
    line = line or f"GET {server.path} HTTP/1.1"
    all_lines = [line, f"Host: {host}", *lines]
    if server.cookie:
        all_lines.append(f"Cookie: {server.cookie}")
    return ("\r\n".join(all_lines) + "\r\n\r\n").encode("latin-1")


def post(server, body=b"{}", lines=(), origin=True):
    lines = list(lines)
    if origin:
        lines.append(f"Origin: http://127.0.0.1:{server.port}")
    return head(server, f"POST {server.post} HTTP/1.1", lines=lines) + body


# --- Attacks: each returns the statuses that it got ---------------------------

def flood(server, start, block, size=FLOOD):
    """Sends the start and blocks up to the size."""
    with connect(server) as connection:
        send(connection, start)
        for _ in range(size // len(block)):
            if not send(connection, block):
                break
        return statuses_of(receive(connection))


def flood_line(server):
    return flood(server, b"GET /", b"a" * 65536)


def flood_header(server):
    return flood(server, head(server)[:-2] + b"X: ", b"a" * 65536)


def flood_headers(server):
    return flood(server, head(server)[:-2], b"X: aaaaaaaaaaa\r\n" * 4096)


def flood_chunks(server):
    return flood(server, post(server, b"", ["Transfer-Encoding: chunked"]),
                 b"fffa\r\n" + b"a" * 0xfffa + b"\r\n")


def flood_body(server):
    return flood(server, post(server, b"", [f"Content-Length: {FLOOD}"]),
                 b"a" * 65536)


def many_connections(server, count=10000, held=400):
    """Connections that say nothing, as many of them at once as may be."""
    open_ones = collections.deque()
    try:
        for _ in range(count):
            if len(open_ones) == held:
                open_ones.popleft().close()
            connection = socket.socket()
            connection.setblocking(False)
            connection.connect_ex(("127.0.0.1", server.port))
            open_ones.append(connection)
    finally:
        for connection in open_ones:
            connection.close()
    return [CLOSED]


def many_half_open(server, count=10000):
    """Connections that are reset as soon as they stand."""
    for _ in range(count):
        with connect(server) as connection:
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER,
                                  struct.pack("ii", 1, 0))
    return [CLOSED]


def all_taken(server):
    """All connections that the server allows say nothing, until it ends them."""
    connections = [connect(server) for _ in range(100)]
    try:
        for connection in connections:
            receive(connection)
    finally:
        for connection in connections:
            connection.close()
    return [CLOSED]


def drip(server, data, pause=1.0, most=12):
    """Sends a byte a second."""
    with connect(server) as connection:
        connection.settimeout(pause)
        got = b""
        for i in range(most):
            if not send(connection, data[i:i + 1]):
                break
            try:
                got = connection.recv(65536)
                break
            except socket.timeout:
                continue
        return statuses_of(got)


def slow_headers(server):
    return drip(server, head(server))


def slow_body(server):
    with connect(server) as connection:
        send(connection, post(server, b"", ["Content-Length: 100"]))
        connection.settimeout(1)
        for _ in range(12):
            if not send(connection, b"a"):
                break
            try:
                return statuses_of(connection.recv(65536))
            except socket.timeout:
                continue
    return [CLOSED]


def slow_reader(server):
    """Asks for a stream, and takes none of it for some seconds."""
    with connect(server) as connection:
        send(connection, head(server, f"GET {server.stream} HTTP/1.1"))
        time.sleep(5)
        return statuses_of(receive(connection, 64 * MEGABYTE))[:1]


def malformed(server, count=10000, seed=48):
    """Valid requests with bytes changed, lost, doubled and moved."""
    generator = random.Random(seed)
    valid = [head(server), post(server, b"a=1", ["Content-Length: 3"]),
             head(server, lines=["Accept: */*", "Connection: keep-alive"]),
             post(server, b"2\r\nab\r\n0\r\n\r\n",
                  ["Transfer-Encoding: chunked"])]
    marks = [b"\r\n", b"\n", b"\r", b"\0", b" ", b"\t", b":", b"HTTP/1.1",
             b"Content-Length: 5\r\n", b"Transfer-Encoding: chunked\r\n",
             b"\xff", b"Host: evil.example\r\n", b"%00", b"/../", b","]
    seen = collections.Counter()
    for _ in range(count):
        data = bytearray(generator.choice(valid) + generator.choice(valid)
                         if generator.random() < 0.3
                         else generator.choice(valid))
        for _ in range(generator.randint(1, 6)):
            place = generator.randrange(len(data) + 1)
            kind = generator.randrange(4)
            if kind == 0:
                data[place:place + 1] = bytes([generator.randrange(256)])
            elif kind == 1:
                del data[place:place + generator.randint(1, 20)]
            elif kind == 2:
                data[place:place] = generator.choice(marks)
            else:
                end = generator.randrange(len(data) + 1)
                data[place:place] = data[min(place, end):max(place, end)]
            if not data:
                data = bytearray(b"G")
        seen.update(ask(server, bytes(data)))
    return list(seen)


# --- The table ------------------------------------------------------------------

def fast_attacks(server):
    """Lists of a name, what is expected, and the bytes."""
    host = f"127.0.0.1:{server.port}"
    own = {200, 202, 400, 401, 403, 404, 409, 415, 422}  # the handler's, any
    of_site = own if server.programs else {403}

    def get(*lines, **rest):
        return head(server, lines=lines, **rest)

    def line(text):
        return head(server, text)

    return [
        ("a request that is right", own, get()),
        ("localhost as Host", own, get(host=f"localhost:{server.port}")),
        ("path traversal", own, line("GET /../../../etc/passwd HTTP/1.1")),
        ("path traversal, escaped", own,
         line("GET /%2e%2e/%2e%2e/etc/passwd HTTP/1.1")),
        ("path traversal, backslashes", own,
         line(r"GET /..\..\etc\passwd HTTP/1.1")),
        ("an absolute path", own, line("GET //etc/passwd HTTP/1.1")),
        ("DNS rebinding", {403}, get(host=f"evil.example:{server.port}")),
        ("DNS rebinding, no port", {403}, get(host="evil.example")),
        ("another port", {403}, get(host="127.0.0.1:1")),
        ("Host with a user", {403}, get(host=f"evil@{host}")),
        ("Host with a tail", {403}, get(host=f"{host}.evil.example")),
        ("two Hosts", {400}, get(f"Host: {host}")),
        ("two Hosts, one evil", {400}, get("Host: evil.example")),
        ("no Host", {400}, b"GET / HTTP/1.1\r\n\r\n"),
        ("an empty Host", {403}, get(host="")),
        ("cross-site GET", of_site, get("Origin: http://evil.example")),
        ("cross-site GET of an image", of_site,
         get("Sec-Fetch-Site: cross-site")),
        ("GET of another port's page", of_site,
         get("Sec-Fetch-Site: same-site")),
        ("cross-site POST", of_site,
         post(server, b"{}", ["Content-Length: 2",
                              "Origin: http://evil.example"], origin=False)),
        ("POST, Origin null", of_site,
         post(server, b"{}", ["Content-Length: 2", "Origin: null"],
              origin=False)),
        ("POST, Origin of https", of_site,
         post(server, b"{}", ["Content-Length: 2", f"Origin: https://{host}"],
              origin=False)),
        ("POST, two Origins", of_site,
         post(server, b"{}", ["Content-Length: 2",
                              "Origin: http://evil.example"])),
        ("POST, no Origin", of_site,
         post(server, b"{}", ["Content-Length: 2"], origin=False)),
        ("CR LF in the target, escaped", own,
         line("GET /%0d%0aSet-Cookie:%20a=b HTTP/1.1")),
        ("CR in the target", {400}, line("GET /a\rb HTTP/1.1")),
        ("LF in the target", {400}, line("GET /a\nb HTTP/1.1")),
        ("a bare CR in a value", {400}, get("X: a\rb")),
        ("Content-Length and Transfer-Encoding", {400},
         post(server, b"0\r\n\r\n", ["Content-Length: 5",
                                     "Transfer-Encoding: chunked"])),
        ("Transfer-Encoding and Content-Length", {400},
         post(server, b"0\r\n\r\n", ["Transfer-Encoding: chunked",
                                     "Content-Length: 5"])),
        ("Transfer-Encoding: chunked", {501},
         post(server, b"0\r\n\r\n", ["Transfer-Encoding: chunked"])),
        ("Transfer-Encoding: identity", {501},
         post(server, b"", ["Transfer-Encoding: identity"])),
        ("Transfer-Encoding: xchunked", {501},
         post(server, b"", ["Transfer-Encoding: xchunked"])),
        ("Transfer-Encoding twice", {400, 501},
         post(server, b"", ["Transfer-Encoding: chunked",
                            "Transfer-Encoding: identity"])),
        ("two Content-Lengths, different", {400},
         post(server, b"{}GET", ["Content-Length: 2", "Content-Length: 5"])),
        ("two Content-Lengths, equal", {400},
         post(server, b"{}", ["Content-Length: 2", "Content-Length: 2"])),
        ("Content-Length: 2, 2", {400},
         post(server, b"{}", ["Content-Length: 2, 2"])),
        ("Content-Length: +2", {400},
         post(server, b"{}", ["Content-Length: +2"])),
        ("Content-Length: -1", {400},
         post(server, b"{}", ["Content-Length: -1"])),
        ("Content-Length: 0x2", {400},
         post(server, b"{}", ["Content-Length: 0x2"])),
        ("Content-Length: 2^64", {400},
         post(server, b"{}", ["Content-Length: 18446744073709551616"])),
        ("a folded line", {400}, get("X: a\r\n b")),
        ("a folded Content-Length", {400},
         post(server, b"{}", ["Content-Length: 2\r\n 0"])),
        ("a fold before the first header", {400},
         f"GET / HTTP/1.1\r\n Host: {host}\r\n\r\n".encode()),
        ("a blank before the colon", {400}, get("X : a")),
        ("a name without colon", {400}, get("X")),
        ("bare LF", {400}, f"GET / HTTP/1.1\nHost: {host}\n\n".encode()),
        ("GET with a body", {400}, get("Content-Length: 4") + b"GET "),
        ("Expect", {417},
         post(server, b"", ["Content-Length: 2", "Expect: 100-continue"])),
        ("HTTP/0.9", {400}, b"GET /\r\n"),
        ("HTTP/1.0", own if server.programs else {400},
         line("GET / HTTP/1.0")),
        ("HTTP/1.2", {400}, line("GET / HTTP/1.2")),
        ("HTTP/2's preface", {400}, b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"),
        ("TLS's hello", {400},
         b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + b"\x5a" * 506),
        ("NUL in the target", {400}, line("GET /a\0b HTTP/1.1")),
        ("NUL in a value", {400}, get("X: a\0b")),
        ("NUL in a name", {400}, get("X\0: a")),
        ("bytes above 127 in the target", {400}, line("GET /\xff HTTP/1.1")),
        ("a target with a host", {400}, line(f"GET http://{host}/ HTTP/1.1")),
        ("a target of a proxy", {400, 405},
         line("CONNECT evil.example:443 HTTP/1.1")),
        ("the target *", {405}, line("OPTIONS * HTTP/1.1")),
        ("TRACE", {405}, line("TRACE / HTTP/1.1")),
        ("PUT", {405}, line("PUT / HTTP/1.1")),
        ("get in small letters", {405}, line("get / HTTP/1.1")),
        ("65 headers", {431}, get(*[f"X{i}: a" for i in range(64)])),
        ("a line of 9 kB", {414}, line(f"GET /{'a' * 9000} HTTP/1.1")),
        ("headers of 17 kB", {431}, get("X: " + "a" * 17000)),
        ("a body one byte too long", {413},
         post(server, b"a" * 65537, ["Content-Length: 65537"])),
        ("an empty connection", {CLOSED}, b""),
        ("half a request", {CLOSED}, b"GET / HT"),
        ("empty lines first", {400}, b"\r\n\r\n" + get()),
    ]


def reads_password_file(server):
    """Whether a path out of the server's folder shows a file."""
    for target in ("/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd",
                   "//etc/passwd", "/etc/passwd"):
        with connect(server) as connection:
            send(connection, head(server, f"GET {target} HTTP/1.1"))
            connection.shutdown(socket.SHUT_WR)
            if b"root:" in receive(connection):
                return [200]
    return [CLOSED]


def smuggled(server):
    """A second request in the body of the first: one answer, and the end."""
    evil = head(server, "GET /smuggled HTTP/1.1")
    statuses = ask(server, post(server, evil, [
        f"Content-Length: {len(evil)}", "Transfer-Encoding: chunked"]))
    return statuses if len(statuses) == 1 else ["two answers"]


def slow_attacks(server):
    attacks = [("headers, a byte a second", {408}, slow_headers),
               ("a body, a byte a second", {408}, slow_body)]
    if server.stream:
        attacks.append(("a stream's slow reader", {200}, slow_reader))
    return attacks


def attacks(server):
    return [(name, expected, lambda s, data=data: ask(s, data))
            for name, expected, data in fast_attacks(server)] + [
        ("files of the machine", {CLOSED}, reads_password_file),
        ("a request in a body", {400}, smuggled),
        ("64 MB of a request line", {414}, flood_line),
        ("64 MB of a header", {431}, flood_header),
        ("64 MB of headers", {431}, flood_headers),
        ("64 MB in chunks", {501}, flood_chunks),
        ("64 MB of a body", {413}, flood_body),
        ("10,000 malformed requests",
         {200, 202, 204, 400, 401, 403, 404, 405, 408, 409, 413, 414, 415, 417,
          422, 431, 501, CLOSED}, malformed),
        ("10,000 connections", {CLOSED}, many_connections),
        ("10,000 connections, reset", {CLOSED}, many_half_open),
        ("100 connections that stay", {CLOSED}, all_taken),
    ]


# --- The judge --------------------------------------------------------------------

def memory(server):
    """The most and the present memory [MB]."""
    with open(f"/proc/{server.pid}/status") as file:
        text = file.read()
    return [int(re.search(rf"{name}:\s+(\d+) kB", text)[1]) / 1024
            for name in ("VmHWM", "VmRSS")]


def answers(server, seconds=8):
    """Whether it answers a request that is right, and soon."""
    end = time.time() + seconds
    while time.time() < end:
        try:
            if isinstance(ask(server, head(server))[0], int):
                return True
        except OSError:
            pass
        time.sleep(0.1)
    return False


def judge(server, name, expected, attack):
    begin = time.time()
    got = set(attack(server))
    seconds = time.time() - begin
    is_alive = answers(server)
    return Row(name, expected, got, seconds, memory(server)[0], is_alive)


def run(server):
    """The rows of all attacks; the slow ones are made at the same time."""
    rows = [judge(server, *attack) for attack in attacks(server)]
    slow = slow_attacks(server)
    with concurrent.futures.ThreadPoolExecutor(len(slow)) as pool:
        rows += pool.map(lambda attack: judge(server, *attack), slow)
    return rows


def words(statuses):
    texts = sorted(str(status) for status in statuses)
    return " ".join(texts) if len(texts) < 5 else f"{texts[0]} … {texts[-1]}"


def table(rows, server):
    lines = [f"{'attack':40} {'expected':>14} {'answer':>14} {'s':>6} "
             f"{'peak MB':>8}"]
    for row in rows:
        lines.append(
            f"{row.name:40} {words(row.expected):>14} {words(row.got):>14} "
            f"{row.seconds:6.2f} {row.peak:8.1f}"
            + ("" if row.is_alive else "  answers no more")
            + ("" if is_well(row, server) else "  <-- not as expected"))
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--port", type=int, required=True)
    parser.add_argument("--pid", type=int, required=True)
    parser.add_argument("--path", default="/")
    parser.add_argument("--post", default="/")
    parser.add_argument("--stream")
    parser.add_argument("--cookie")
    parser.add_argument("--memory", type=float, default=40)
    parser.add_argument("--programs", action="store_true")
    server = Server(**vars(parser.parse_args()))
    rows = run(server)
    print(table(rows, server))
    return 0 if all(is_well(row, server) for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
