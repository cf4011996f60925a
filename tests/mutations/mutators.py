"""Damage to files: bytes, tokens, two files in one, nesting.

Each mutator takes a random.Random, the file's bytes and another file's bytes,
and gives the damaged bytes.
"""
import io
import re
import struct
import zipfile
import zlib

LARGEST = 4_000_000  # bytes of a mutated file

TOKEN = re.compile(rb'"(?:[^"\\]|\\.)*"|[A-Za-z_$][\w$]*'
                   rb'|\d*\.?\d+(?:[eE][+-]?\d+)?|\s+|.', re.DOTALL)
NUMBER = re.compile(rb'-?\d*\.?\d+(?:[eE][+-]?\d+)?')
WORD = re.compile(rb'[A-Za-z_$][\w$]*')

HOSTILE = [b"0", b"-1", b"1", b"1e308", b"-1e308", b"1e-308", b"1e7", b"1e15",
           b"0.0000001", b"2147483647", b"-2147483648", b"4294967296",
           b"9223372036854775807", b"1e400", b"nan", b"inf", b"-0",
           b"3.0000000000000004", b"65536", b"99999999999999999999"]
HOSTILE_VALUES = HOSTILE + [
    b"0/0", b"1/0", b"-1/0", b"undef", b'"text"', b'""', b"true", b"[]",
    b"[[]]", b"[0:0:1]", b"[0:1e9]", b"[0:-1:5]", b"[1:0]", b"[undef]",
    b"[0/0, 1, 2]", b"[1, 2, 3]", b"[[0, 0], [1, 0], [1, 1]]",
    b"function(x) x", b"-(1)", b"sqrt(-1)", b"$fn", b"let(a = 1) a",
    b"[for (i = [0:9]) i]", b"rands(0, 1, 3)", b"1e7 * 1e7",
    b"[for (i = [0:3000]) [50 * sin(i * i * 1.1), 50 * cos(i * 7.3)]]",
    b"[for (i = [0:600]) [i % 20, (i * 7) % 21, (i * 13 + 5) % 19]]"]
SOLIDS = [b"cube", b"sphere", b"cylinder", b"polyhedron", b"square", b"circle",
          b"polygon", b"text", b"import", b"surface", b"children"]
OPERATORS = [b"hull", b"minkowski", b"difference", b"intersection", b"union",
             b"linear_extrude", b"rotate_extrude", b"scale", b"resize",
             b"rotate", b"translate", b"mirror", b"multmatrix", b"offset",
             b"projection", b"render", b"for", b"intersection_for", b"color",
             b"group", b"echo", b"assert", b"let"]
FUNCTIONS = [b"str", b"concat", b"lookup", b"search", b"len", b"sin", b"pow",
             b"sqrt", b"max", b"cross", b"norm", b"rands", b"chr", b"ord",
             b"floor", b"atan2", b"is_list", b"parent_module", b"version"]
WORDS = SOLIDS + OPERATORS + FUNCTIONS + [
    b"each", b"undef", b"true", b"$fn", b"$fa", b"$fs", b"$t", b"module",
    b"function", b"include", b"use", b"if", b"else"]
PREFIXES = [b"$fn = 1e5;\n", b"$fn = 3;\n", b"$fn = 1e9;\n", b"$fn = -5;\n",
            b"$fa = 0;\n$fs = 0;\n", b"$fa = 1e-9; $fs = 1e-9;\n",
            b"$fn = 0/0;\n", b"scale(1e-9) ", b"scale([0, 1, 1]) ",
            b"scale(1e9) ", b"hull() ", b"minkowski() ", b"linear_extrude(1e7)",
            b"rotate_extrude($fn = 1000) ", b"projection() ",
            b"projection(cut = true) ", b"resize([1, 0, 1e9]) ",
            b"multmatrix([[0/0]]) ", b"offset(1e6) ", b"offset(delta = -1) ",
            b"mirror([0, 0, 0]) ", b"for (i = [0:1e6]) ", b"render() ",
            b"intersection_for (i = [0:300]) ", b"translate([1e300, 0, 0]) "]
NESTS = [(b"(", b")"), (b"[", b"]"), (b"{", b"}"), (b"-", b""), (b"!", b""),
         (b"let (a = 1) ", b""), (b"union() { ", b" }"), (b"f(", b")"),
         (b"[for (i = [0:1]) ", b"]"), (b"1 ? ", b" : 0"), (b"<g>", b"</g>"),
         (b'{"a":', b"}"), (b"if (true) ", b""), (b"translate([1, 0, 0]) ", b""),
         (b"a.", b""), (b"/*", b"*/"), (b"function(x) ", b""), (b"each ", b"")]


# --- Bytes -------------------------------------------------------------------

def chunk(rng, data, largest=400):
    """A random place and the end of a chunk there."""
    begin = rng.randrange(len(data) + 1)
    return begin, min(len(data), begin + rng.randint(1, largest))


def flip_bits(rng, data, _):
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 8, 64]) if data else 0):
        data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    return bytes(data)


def overwrite(rng, data, _):
    begin, end = chunk(rng, data, 8)
    filler = rng.choice([b"\0", b"\xff", b"\x7f", b"\x80", b"9", b"\n", b" "])
    return data[:begin] + filler * (end - begin) + data[end:]


def insert_noise(rng, data, _):
    begin, _ = chunk(rng, data)
    return data[:begin] + rng.randbytes(rng.randint(1, 16)) + data[begin:]


def delete_chunk(rng, data, _):
    begin, end = chunk(rng, data)
    return data[:begin] + data[end:]


def duplicate_chunk(rng, data, _):
    begin, end = chunk(rng, data)
    return data[:begin] + data[begin:end] * rng.choice([2, 2, 3, 50]) + \
        data[end:]


def swap_chunks(rng, data, _):
    (a, b), (c, d) = sorted([chunk(rng, data), chunk(rng, data)])
    if c < b:
        return data
    return data[:a] + data[c:d] + data[b:c] + data[a:b] + data[d:]


def truncate(rng, data, _):
    return data[:rng.randrange(len(data) + 1)]


def splice(rng, data, other):
    begin, _ = chunk(rng, data)
    theirs, end = chunk(rng, other, 4000)
    return data[:begin] + other[theirs:end] + data[begin:]


def cross(rng, data, other):
    return data[:rng.randrange(len(data) + 1)] + \
        other[rng.randrange(len(other) + 1):]


# --- Tokens ------------------------------------------------------------------

def replace_match(rng, data, pattern, replacement, times=1):
    """`data` with some matches of `pattern` replaced."""
    for _ in range(times):
        found = list(pattern.finditer(data))
        if not found:
            return data
        match = rng.choice(found)
        data = data[:match.start()] + replacement() + data[match.end():]
    return data


def hostile_number(rng, data, _):
    return replace_match(rng, data, NUMBER, lambda: rng.choice(HOSTILE),
                         rng.choice([1, 1, 2, 5]))


def hostile_value(rng, data, _):
    return replace_match(rng, data, NUMBER, lambda: rng.choice(HOSTILE_VALUES),
                         rng.choice([1, 1, 2, 5]))


def other_word(rng, data, _):
    words = WORD.findall(data)
    return replace_match(rng, data, WORD,
                         lambda: rng.choice(rng.choice([words, WORDS])))


def other_name(rng, data, _):
    """Another module or function of the language, of the same sort."""
    sort = rng.choice([SOLIDS, OPERATORS, OPERATORS, FUNCTIONS])
    pattern = re.compile(rb"\b(?:" + b"|".join(sort) + rb")\b")
    return replace_match(rng, data, pattern, lambda: rng.choice(sort),
                         rng.choice([1, 1, 3]))


def swap_tokens(rng, data, _):
    tokens = TOKEN.findall(data)
    if len(tokens) > 1:
        i, j = rng.randrange(len(tokens)), rng.randrange(len(tokens))
        tokens[i], tokens[j] = tokens[j], tokens[i]
    return b"".join(tokens)


def delete_token(rng, data, _):
    return replace_match(rng, data, TOKEN, lambda: b"")


def repeat_token(rng, data, _):
    found = list(TOKEN.finditer(data))
    if not found:
        return data
    match = rng.choice(found)
    times = rng.choice([1, 1, 3, 1000])
    return data[:match.end()] + match.group() * times + data[match.end():]


def nest(rng, data, _):
    """Brackets around a token, many deep."""
    found = list(TOKEN.finditer(data))
    if not found:
        return data
    match = rng.choice(found)
    opening, closing = rng.choice(NESTS)
    depth = rng.choice([3, 100, 3000, 50000])
    return (data[:match.start()] + opening * depth + match.group() +
            closing * depth + data[match.end():])


def prefix(rng, data, _):
    return b"".join(rng.sample(PREFIXES, rng.choice([1, 1, 2, 3]))) + data


# --- Containers --------------------------------------------------------------

def within_zip(rng, data, other):
    """Damages a file in an archive, whose checksums stay right."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            names = archive.namelist()
            files = {name: archive.read(name) for name in names}
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, OSError,
            EOFError, RuntimeError, ValueError, struct.error):
        return flip_bits(rng, data, other)
    model = max(names, key=lambda name: len(files[name]))
    name = rng.choice([model, model, rng.choice(names)])
    files[name] = rng.choice(BYTES + TOKENS)(rng, files[name], other)
    result = io.BytesIO()
    with zipfile.ZipFile(result, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in names:
            archive.writestr(zipfile.ZipInfo(name), files[name])
    return result.getvalue()


def within_png(rng, data, other):
    """Damages a chunk of a picture, whose checksum is made right."""
    chunks, at = [], 8
    while at + 8 <= len(data):
        size, = struct.unpack(">I", data[at:at + 4])
        chunks.append((data[at + 4:at + 8], data[at + 8:at + 8 + size]))
        at += 12 + size
    if not chunks:
        return flip_bits(rng, data, other)
    i = rng.choice([0, rng.randrange(len(chunks))])
    name, body = chunks[i]
    if name == b"IDAT" and rng.random() < 0.7:
        pixels = zlib.decompressobj().decompress(body, 1 << 22)
        body = zlib.compress(rng.choice(BYTES)(rng, pixels, other))
    else:
        body = rng.choice([flip_bits, overwrite, truncate])(rng, body, other)
    chunks[i] = name, body
    return data[:8] + b"".join(
        struct.pack(">I", len(body)) + name + body +
        struct.pack(">I", zlib.crc32(name + body)) for name, body in chunks)


BYTES = [flip_bits, overwrite, insert_noise, delete_chunk, duplicate_chunk,
         swap_chunks, truncate, splice, cross]
TOKENS = [hostile_number, hostile_number, hostile_value, other_word,
          swap_tokens, delete_token, repeat_token, nest]
# Most of what damages a design leaves no design.
DESIGN = BYTES + TOKENS + 9 * [hostile_value, prefix, other_name]
NUMBERS = BYTES + TOKENS + 6 * [hostile_number]


def mutators_for(kind, data):
    if data.startswith(b"PK"):
        return BYTES + 20 * [within_zip]
    if kind == "png":
        return BYTES + 20 * [within_png]
    if kind in ("scad", "csg"):
        return DESIGN
    return NUMBERS


def mutate(rng, kind, data, other):
    """The damaged file, and the names of what was done."""
    done = []
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        mutator = rng.choice(mutators_for(kind, data))
        try:
            damaged = mutator(rng, data, other)
        except zlib.error:  # pixels damaged before
            continue
        if len(damaged) <= LARGEST:
            data = damaged
            done.append(mutator.__name__)
    return data, done
