"""Reads the images that a resin printer gets: .sl1, .zip, .goo, folders.

Knows the formats from docs/formats.md and from what their makers publish, and
shares no code with lamina.
"""
import json
import pathlib
import re
import struct
import subprocess
import sys
import zipfile
import zlib

FORMATS = pathlib.Path(__file__).parent.parent / "formats"
sys.path.append(str(FORMATS))
import goo_read


def unfiltered(kind, row, above):
    """A row of a grey 8-bit PNG."""
    if kind == 0:
        return row
    if kind == 2:
        return bytes((a + b) & 255 for a, b in zip(row, above))
    if not any(row) and (kind == 1 or not any(above)):
        return row
    out, left, corner = bytearray(len(row)), 0, 0
    for i, value in enumerate(row):
        up = above[i]
        if kind == 1:
            guess = left
        elif kind == 3:
            guess = (left + up) // 2
        else:
            guess = min((abs(up - corner), 0, left), (abs(left - corner), 1, up),
                        (abs(left + up - 2 * corner), 2, corner))[2]
        left = out[i] = (value + guess) & 255
        corner = up
    return bytes(out)


def png_pixels(data):
    """Width, height and pixels of an 8-bit grey PNG."""
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError("not a PNG file")
    width, height, depth, colour = struct.unpack(">IIBB", data[16:26])
    if (depth, colour) != (8, 0):
        raise ValueError("not an image of 8-bit grey")
    at, packed = 8, []
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed.append(data[at + 8:at + 8 + size])
        at += 12 + size
    raw = zlib.decompress(b"".join(packed))
    rows = [raw[start + 1:start + width + 1]
            for start in range(0, height * (width + 1), width + 1)]
    if any(raw[::width + 1]):
        above = bytes(width)
        for i, row in enumerate(rows):
            above = rows[i] = unfiltered(raw[i * (width + 1)], row, above)
    return width, height, b"".join(rows)


class PixelStack:
    """The layers of a print, from the lowest one up.

    count    of layers
    heights  (bottom, top) of each [mm]
    pixel    its side [mm]; None where the file does not say and nobody did
    """

    def __init__(self, path, pixel=None):
        self.path = pathlib.Path(path)
        self.pixel = pixel
        if self.path.is_dir():
            self._open_folder()
        elif self.path.suffix == ".goo":
            self._open_goo()
        else:
            self._open_archive()
        self.count = len(self.heights)

    def images(self, numbers=None):
        """Yields width, height and pixels, rows from the top, 0 … 255.

        numbers  of the layers, ascending from 0; all unless given
        """
        return self._images(range(self.count) if numbers is None else numbers)

    def _open_folder(self):
        index = json.loads((self.path / "index.json").read_text())
        self.pixel = self.pixel or index["pixel_mm"][0]
        self.heights = [(layer["z"] - layer["thickness"], layer["z"])
                        for layer in index["layers"]]
        files = [self.path / layer["file"] for layer in index["layers"]]
        self._images = lambda numbers: (png_pixels(files[i].read_bytes())
                                        for i in numbers)

    def _open_archive(self):
        archive = zipfile.ZipFile(self.path)
        names = archive.namelist()
        if "config.ini" in names:
            config = archive.read("config.ini").decode()
            thickness = float(re.search(r"(?m)^layerHeight = (\S+)", config)[1])
        else:
            thickness = json.loads(archive.read("slicer.json"))["SupportDepth"]
        if self.pixel is None and "prusaslicer.ini" in names:
            config = archive.read("prusaslicer.ini").decode()
            self.pixel = (
                float(re.search(r"(?m)^display_width = (\S+)", config)[1]) /
                float(re.search(r"(?m)^display_pixels_x = (\S+)", config)[1]))
        number = re.compile(r"[^/]*?(\d+)\.png")
        images = sorted((int(match[1]), match[0])
                        for match in map(number.fullmatch, names) if match)
        self.heights = [(i * thickness, (i + 1) * thickness)
                        for i in range(len(images))]
        self._images = lambda numbers: (png_pixels(archive.read(images[i][1]))
                                        for i in numbers)

    def _open_goo(self):
        report = json.loads(subprocess.run(
            [sys.executable, FORMATS / "goo_read.py", self.path],
            capture_output=True, text=True).stdout)
        header = report["header"]
        size = header["x_resolution"], header["y_resolution"]
        self.pixel = self.pixel or header["x_size_mm"] / size[0]
        thickness = header["layer_thickness_mm"]
        self.heights = [(i * thickness, (i + 1) * thickness)
                        for i in range(len(report["layers"]))]
        self._images = lambda numbers: self._goo_images(
            size, [report["layers"][i] for i in numbers])

    def _goo_images(self, size, layers):
        data = self.path.read_bytes()
        stats = dict.fromkeys(("black", "grey", "difference", "white"), 0)
        for layer in layers:
            begin = layer["offset"] + goo_read.DEF_SIZE + 4
            runs = goo_read.runs(data[begin + 1:begin + layer["data_bytes"] - 1],
                                 goo_read.Report(), "", stats)
            yield *size, b"".join(bytes([grey]) * count for count, grey in runs)
